"""Comparing methods in the window, with mouse and keys: the table, views side by side, the wipe."""

from __future__ import annotations

import json
from threading import Event

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox, QLabel, QPushButton, QTableView, QToolButton, QWidget

from hexmend import io
from hexmend.gallery import make
from hexmend.report.comparison import LINES
from hexmend.run import Stop
from hexmend.smoothers import METHODS
from hexmend.study.compare import compare
from hexmend_app.canvas.captions import CaptionRow, WipeRow
from hexmend_app.canvas.wipe_handle import WipeHandle
from hexmend_app.features.beside.feature import STEP
from hexmend_app.features.compare.comparison_table import METHOD, VIEW, title_of
from hexmend_app.state.clip import PlaneClip
from hexmend_app.state.document import State
from hexmend_app.state.look import ColourScale, RangeMode
from hexmend_app.widgets.style import WORSE
from tests.app.driving import LEFT, choose, click, drag, key, named, open_and_wait, pixels, press, seen_at
from tests.patience import PATIENCE

COLUMN = {figure.key: at for at, figure in enumerate(LINES, 2)}


SHORT, ENDLESS = Stop(max_iterations=4), Stop(max_iterations=100_000, tolerance=0.0)


def table_of(window):
    window.refresh()
    return named(window.features["compare"].panel, QTableView, "Comparison of methods")


def model(window):
    return table_of(window).model()


def row(window, name):
    return [one.name for one in model(window).entries].index(name)


def tick(window, name, column):
    """Click on the check of a row."""
    table = table_of(window)
    index = model(window).index(row(window, name), column)
    table.scrollTo(index)
    rect = table.visualRect(index)
    QTest.mouseClick(table.viewport(), LEFT, pos=QPoint(rect.left() + 10, rect.center().y()))
    window.refresh()


def button(window, name):
    window.refresh()
    return named(window.features["compare"].panel, QPushButton, name)


def choose_methods(window, *names):
    for name in sorted(model(window).ticks ^ set(names)):
        tick(window, name, METHOD)
    assert model(window).ticks == set(names)


def prepared(window, qtbot):
    """The window with the panel in front and short runs asked for."""
    window.show_panel("compare")
    choose(window, "mend", SHORT)
    qtbot.waitUntil(window.features["compare"].panel.isVisible)
    return window


@pytest.fixture
def comparing(window, qtbot):
    """The panel in front and short runs asked for."""
    return prepared(window, qtbot)


@pytest.fixture
def compared(comparing, qtbot):
    """Three methods' results in the table."""
    choose_methods(comparing, "laplacian", "getme", "local-sd")
    press(button(comparing, "Run the comparison"))
    qtbot.waitUntil(lambda: not comparing.session.comparison.busy, timeout=PATIENCE)
    return comparing


def captions(window):
    """What the views are called that have captions, row by row."""
    window.refresh()
    QApplication.processEvents()  # layouts show what was put into them a moment later
    own = Qt.FindChildOption.FindDirectChildrenOnly
    parts = [part for row in window.findChildren(CaptionRow) for part in row.findChildren(QWidget, options=own)]
    return [part.accessibleName().partition(":")[0] for part in parts if part.isVisibleTo(window)]


def test_the_table_holds_what_the_core_computes_and_the_mesh_stays(compared):
    before = compared.session.document.start.mesh
    assert compared.session.document.now.mesh is before
    expected = compare(before, ["getme", "laplacian", "local-sd"], SHORT)
    for one in expected.rows:
        record = model(compared).entries[row(compared, one.method)].record
        assert record["q_min"] == one.after.q_min
        assert record["inverted"] == one.after.inverted
        assert record["iterations"] == 4
    assert [one.name for one in model(compared).entries[:4]] == ["initial", "getme", "laplacian", "local-sd"]
    corner = compared.docks.drawer.cornerWidget(Qt.Corner.TopRightCorner)
    assert named(corner, QLabel, "Counts").isVisible()  # the table leaves the counts their place
    best = min(expected.rows, key=lambda one: one.after.inverted).method
    cell = model(compared).index(row(compared, best), COLUMN["inverted"])
    assert cell.data(Qt.ItemDataRole.FontRole).bold()
    assert cell.data(Qt.ItemDataRole.AccessibleTextRole).endswith("best")


def test_what_is_worse_than_the_initial_mesh_stands_out(comparing, qtbot, tmp_path):
    io.write(tmp_path / "sound.vtu", make("bridge-sharp", size=864))
    open_and_wait(qtbot, comparing, tmp_path / "sound.vtu")
    choose(comparing, "laplacian", Stop(keep_last=True))
    choose_methods(comparing, "laplacian", "smart-laplacian")
    press(button(comparing, "Run the comparison"))
    qtbot.waitUntil(lambda: not comparing.session.comparison.busy, timeout=PATIENCE)

    def cell(name, figure):
        return model(comparing).index(row(comparing, name), COLUMN[figure])

    for figure in ("inverted", "q_min", "scaled_jacobian_min"):
        assert cell("laplacian", figure).data(Qt.ItemDataRole.AccessibleTextRole).endswith("worse than initial")
        assert cell("laplacian", figure).data(Qt.ItemDataRole.ForegroundRole).color() == QColor(str(WORSE))
    assert "worse" not in (cell("laplacian", "q_mean").data(Qt.ItemDataRole.AccessibleTextRole) or "")
    assert "worse" not in (cell("smart-laplacian", "inverted").data(Qt.ItemDataRole.AccessibleTextRole) or "")


def test_the_key_brings_the_table_to_the_front(comparing, qtbot):
    choose_methods(comparing, "laplacian")
    comparing.show_panel("outcome")
    key(comparing, Qt.Key.Key_F6)
    assert comparing.in_front("compare")
    qtbot.waitUntil(lambda: not comparing.session.comparison.busy, timeout=PATIENCE)
    assert model(comparing).entries[row(comparing, "laplacian")].record["iterations"] == 4


def test_a_click_on_a_head_sorts_and_the_initial_mesh_stays_first(compared):
    header = table_of(compared).horizontalHeader()
    column = COLUMN["q_mean"]
    table_of(compared).scrollTo(model(compared).index(0, column))
    place = QPoint(header.sectionViewportPosition(column) + 12, header.height() // 2)
    orders = []
    for _ in range(2):
        QTest.mouseClick(header.viewport(), LEFT, pos=place)
        entries = model(compared).entries
        assert entries[0].name == "initial"
        assert not any(one.record for one in entries[4:])
        orders.append([one.record["q_mean"] for one in entries[1:4]])
    assert orders[0] == sorted(orders[0], reverse=orders[0][0] > orders[0][-1])
    assert orders[1] == orders[0][::-1]


def test_cancel_ends_with_the_iteration_at_hand_and_keeps_what_was_reached(comparing, qtbot, monkeypatch):
    at_hand, go_on = Event(), Event()
    steps = METHODS["local-sd"].steps

    def held(self, mesh):
        for number, step in enumerate(steps(self, mesh)):  # the first is the mesh as it is
            if number == 3:
                at_hand.set()
                assert go_on.wait(PATIENCE / 1000)
            yield step

    monkeypatch.setattr(METHODS["local-sd"], "steps", held)
    comparison = comparing.session.comparison
    choose(comparing, "mend", ENDLESS)
    choose_methods(comparing, "local-sd", "mend")
    press(button(comparing, "Run the comparison"))
    qtbot.waitUntil(at_hand.is_set, timeout=PATIENCE)
    comparing.refresh()
    offered = comparing.actions["compare"].isEnabled()
    press(button(comparing, "Cancel the comparison"))
    status = named(comparing.features["compare"].panel, QLabel, "Progress of the comparison")
    ending = status.text()
    go_on.set()
    assert not offered
    assert ending == f"Ending {METHODS['local-sd'].title} after this iteration…"
    qtbot.waitUntil(lambda: not comparison.busy, timeout=PATIENCE)
    (one,) = comparison.results
    assert one.row.outcome == "stopped"
    assert one.row.iterations == 3
    assert comparison.interrupted
    comparing.refresh()
    assert "interrupted" in status.text()
    assert comparing.actions["compare"].isEnabled()


def test_a_method_that_fails_has_its_row_and_the_others_go_on(comparing, qtbot, monkeypatch):
    def broken(self, mesh):
        raise RuntimeError("no memory")
        yield

    monkeypatch.setattr(METHODS["getme"], "steps", broken)
    choose_methods(comparing, "getme", "laplacian")
    press(button(comparing, "Run the comparison"))
    qtbot.waitUntil(lambda: not comparing.session.comparison.busy, timeout=PATIENCE)
    failed, well = (model(comparing).entries[row(comparing, name)] for name in ("getme", "laplacian"))
    assert failed.record["outcome"] == "failed"
    assert "no memory" in failed.help
    assert not failed.has_mesh
    assert not model(comparing).flags(model(comparing).index(row(comparing, "getme"), VIEW)) & Qt.ItemFlag.ItemIsEnabled
    assert well.record["iterations"] == 4


def test_another_mesh_ends_the_work_and_empties_everything(compared, qtbot, mesh_file):
    tick(compared, "getme", VIEW)
    choose(compared, "mend", ENDLESS)
    choose_methods(compared, "local-sd")
    press(button(compared, "Run the comparison"))
    open_and_wait(qtbot, compared, mesh_file)
    assert not compared.session.comparison.busy
    assert not any(one.record for one in model(compared).entries)
    assert compared.session.views.all == ()
    assert captions(compared) == []
    assert len(compared.canvas.panes.all) == 1


def test_the_window_closes_while_methods_run(fresh_window, qtbot):
    comparing = prepared(fresh_window, qtbot)
    choose(comparing, "mend", ENDLESS)
    choose_methods(comparing, "local-sd")
    press(button(comparing, "Run the comparison"))
    qtbot.waitUntil(lambda: comparing.session.comparison.progress.iteration > 0, timeout=PATIENCE)
    comparing.close()
    assert not comparing.session.comparison.busy


def test_results_are_shown_beside_the_mesh_with_their_names_in_the_histogram(compared):
    for count, name in enumerate(("getme", "laplacian", "local-sd"), 2):
        tick(compared, name, VIEW)
        assert len(compared.canvas.panes.all) == count
    assert captions(compared) == ["now", title_of("getme"), title_of("laplacian"), title_of("local-sd")]
    assert [one.name for one in compared.session.kept.all] == [
        title_of("getme"),
        title_of("laplacian"),
        title_of("local-sd"),
    ]
    series = compared.features["histogram"].panel.series()
    assert [one.name for one in series][2:] == [title_of("getme"), title_of("laplacian"), title_of("local-sd")]
    initial = model(compared).index(0, VIEW)
    assert not model(compared).flags(initial) & Qt.ItemFlag.ItemIsEnabled  # there is no room
    tick(compared, "initial", VIEW)
    assert len(compared.canvas.panes.all) == 4
    for view, name in zip(compared.canvas.panes.all[1:], ("getme", "laplacian", "local-sd"), strict=True):
        state = compared.session.comparison.of(name).state
        np.testing.assert_array_equal(view.frame.mesh.points, state.mesh.points)


def test_a_view_is_closed_by_its_button_and_the_rest_by_a_key(compared):
    for name in ("getme", "laplacian", "local-sd"):
        tick(compared, name, VIEW)
    crosses = [
        b
        for b in compared.findChildren(QToolButton)
        if b.accessibleName() == f"Close the view of {title_of('laplacian')}"
    ]
    press(next(cross for cross in crosses if cross.isVisible()))
    assert captions(compared) == ["now", title_of("getme"), title_of("local-sd")]
    assert not model(compared).entries[row(compared, "laplacian")].shown
    assert [one.name for one in compared.session.kept.all] == [title_of("getme"), title_of("local-sd")]
    key(compared, Qt.Key.Key_W, Qt.KeyboardModifier.ControlModifier)
    assert captions(compared) == []
    assert compared.session.kept.all == ()


def test_one_state_is_shown_by_one_call_and_replaced_under_its_name(compared):
    first, second = (compared.session.comparison.of(name).state for name in ("getme", "laplacian"))
    compared.session.views.show("iteration 7", first)
    compared.refresh()
    assert captions(compared) == ["now", "iteration 7"]
    compared.session.views.show("iteration 7", second)
    compared.refresh()
    assert captions(compared) == ["now", "iteration 7"]
    assert compared.canvas.panes.all[1].frame.mesh.points is second.mesh.points
    assert [one.points for one in compared.session.kept.all] == [second.mesh.points]


def test_another_comparison_closes_the_views_of_the_one_before_and_no_others(compared, qtbot):
    mesh = compared.session.document.now.mesh
    compared.session.views.show("mine", State.of(mesh.with_points(mesh.points)))
    tick(compared, "getme", VIEW)
    tick(compared, "initial", VIEW)
    assert captions(compared) == ["now", "mine", title_of("getme"), "initial"]
    press(button(compared, "Run the comparison"))
    assert captions(compared) == ["now", "mine"]
    qtbot.waitUntil(lambda: not compared.session.comparison.busy, timeout=PATIENCE)
    assert not any(one.shown for one in model(compared).entries)


def test_a_drag_in_any_view_turns_all_and_a_click_chooses_one_element_in_all(compared, qtbot):
    tick(compared, "getme", VIEW)
    canvas, view = compared.canvas, compared.canvas.interactor
    canvas.draw_still()
    before = pixels(compared)
    half = before.shape[1] // 2
    right = QPoint(view.width() * 3 // 4, view.height() // 2)
    drag(view, right, right + QPoint(60, 20))
    canvas.draw_still()
    after = pixels(compared)
    for part in (after[:, :half] - before[:, :half], after[:, half:] - before[:, half:]):
        assert (np.abs(part).max(axis=2) > 40).mean() > 0.02
    assert compared.session.selection.hex is None
    QTest.mouseClick(view, LEFT, pos=right)
    compared.refresh()
    chosen = compared.session.selection.hex
    assert chosen is not None
    for one in canvas.panes.all:
        assert one.chosen.hex == chosen
        np.testing.assert_allclose(
            one.chosen.highlight.box.points, one.frame.mesh.points[one.frame.mesh.hexes[chosen]], rtol=1e-6
        )
    tick(compared, "laplacian", VIEW)
    assert canvas.panes.all[2].chosen.hex == chosen


def test_cut_and_colours_are_those_of_all_views(compared):
    tick(compared, "getme", VIEW)
    tick(compared, "laplacian", VIEW)
    key(compared, Qt.Key.Key_C)
    compared.session.view.change(scale=ColourScale(mode=RangeMode.FITTED))
    compared.refresh()
    first, *others = compared.canvas.panes.all
    assert 0 < first.shown < first.frame.mesh.n_hexes
    for view in others:
        np.testing.assert_array_equal(view.kept(), first.kept())
        assert (view.colouring.low, view.colouring.high) == (first.colouring.low, first.colouring.high)
    states = [compared.session.document.now, *(one.state for one in compared.session.views.all)]
    q = [one.figures.q[~one.figures.inverted] for one in states]
    assert (first.colouring.low, first.colouring.high) == (min(map(np.min, q)), max(map(np.max, q)))
    bar = compared.canvas.colour_bar
    assert bar.range == (first.colouring.low, first.colouring.high)


def test_the_plane_comes_back_in_the_view_of_the_mesh_wherever_the_mouse_was(compared, qtbot):
    tick(compared, "getme", VIEW)
    view = compared.canvas.interactor
    for _ in range(2):
        key(compared, Qt.Key.Key_C)
    compared.session.view.set_handles(False)
    QTest.mouseMove(view, QPoint(view.width() * 3 // 4, view.height() // 2))
    QApplication.processEvents()
    key(compared, Qt.Key.Key_C)
    without = pixels(compared)
    compared.session.view.set_handles(True)
    changed = np.abs(pixels(compared) - without).max(axis=2) > 5
    half = changed.shape[1] // 2
    left, right = changed[:, :half].mean(), changed[:, half:].mean()
    assert left > 0.01  # the plane is a faint one
    assert right < left / 4  # edges may be drawn a little otherwise, for there is something else in depth


@pytest.mark.parametrize("arranged", ["side by side", "wipe", "wipe, the mesh at the right"])
def test_the_plane_is_dragged_in_the_view_of_the_mesh_and_moves_in_all(compared, qtbot, arranged):
    tick(compared, "getme", VIEW)
    if arranged != "side by side":
        compared.session.views.set_wiping(True)
        compared.session.views.move_wipe(0.9 if arranged == "wipe" else 0.1)
    if arranged == "wipe, the mesh at the right":
        compared.session.views.choose_wiped(1, 0)
    centre = compared.session.document.now.mesh.points.mean(axis=0)
    compared.session.view.set_clip(PlaneClip.at((0, 0, 1), tuple(centre)))
    compared.refresh()
    QApplication.processEvents()  # the wipe's choices take room from the view
    pixels(compared)
    x, y, z = compared.session.view.look.clip.planes[0].origin
    place = seen_at(compared, (x + 4, y - 4, z))  # on the plane, beside its arrow
    before = compared.canvas.panes.all[1].shown
    drag(compared.canvas.interactor, place, place + QPoint(0, -30))
    assert compared.session.view.look.clip.planes[0].origin[2] > z
    compared.refresh()
    first, second = compared.canvas.panes.all
    assert second.shown == first.shown != before


def test_the_mesh_may_be_smoothed_while_others_are_shown(compared, qtbot):
    tick(compared, "getme", VIEW)
    with qtbot.waitSignal(compared.session.smoothing.ended, timeout=PATIENCE):
        click(compared, "Run")
    compared.refresh()
    first, second = compared.canvas.panes.all
    np.testing.assert_array_equal(first.frame.mesh.points, compared.session.document.now.mesh.points)
    np.testing.assert_array_equal(second.frame.mesh.points, compared.session.comparison.of("getme").state.mesh.points)
    caption = compared.canvas.frame.captions[0]
    assert (caption.q_min, caption.inverted) == (
        compared.session.document.now.summary.q_min, compared.session.document.now.summary.inverted
    )  # fmt: skip


def test_a_result_is_taken_and_undo_takes_it_back(compared):
    before = compared.session.document.now.mesh
    assert not button(compared, "Take result").isEnabled()
    index = model(compared).index(row(compared, "laplacian"), COLUMN["inverted"])
    table = table_of(compared)
    QTest.mouseClick(table.viewport(), LEFT, pos=table.visualRect(index).center())
    press(button(compared, "Take result"))
    taken = compared.session.comparison.of("laplacian").state
    np.testing.assert_array_equal(compared.session.document.now.mesh.points, taken.mesh.points)
    assert compared.session.document.undo_title == METHODS["laplacian"].title
    key(compared, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert compared.session.document.now.mesh is before


def test_methods_run_with_the_values_that_were_set_for_them(comparing, qtbot):
    choose(comparing, "getme", SHORT, relaxation=0.25)
    choose(comparing, "laplacian", SHORT)
    choose_methods(comparing, "getme")
    press(button(comparing, "Run the comparison"))
    qtbot.waitUntil(lambda: not comparing.session.comparison.busy, timeout=PATIENCE)
    assert comparing.session.comparison.of("getme").row.parameters["relaxation"] == 0.25


def test_the_wipe_is_switched_dragged_and_led_by_keys(compared, qtbot):
    tick(compared, "getme", VIEW)
    tick(compared, "laplacian", VIEW)
    key(compared, Qt.Key.Key_W)
    wipe, handle = compared.session.views.wipe, compared.findChild(WipeHandle)
    assert (wipe.left, wipe.right, wipe.at) == (0, 2, 0.5)
    assert handle.isVisible()
    assert captions(compared) == []
    width = compared.canvas.interactor.width()
    knob = handle.rect().center()
    drag(handle, knob, knob + QPoint(-width // 5, 0), steps=1)
    assert compared.session.views.wipe.at == pytest.approx(0.3, abs=0.01)
    assert handle.geometry().center().x() == pytest.approx(0.3 * width, abs=3)
    at = compared.session.views.wipe.at
    key(compared, Qt.Key.Key_BracketRight)
    key(compared, Qt.Key.Key_BracketRight)
    key(compared, Qt.Key.Key_BracketLeft)
    assert compared.session.views.wipe.at == pytest.approx(at + STEP)
    handle.setFocus()
    QTest.keyClick(handle, Qt.Key.Key_Left)
    compared.refresh()
    assert compared.session.views.wipe.at == pytest.approx(at)
    for _ in range(60):
        QTest.keyClick(handle, Qt.Key.Key_Left)
    compared.refresh()
    assert 0 < compared.session.views.wipe.at < 0.05
    key(compared, Qt.Key.Key_W)
    assert captions(compared) == ["now", title_of("getme"), title_of("laplacian")]
    assert not handle.isVisible()


def test_either_side_of_the_wipe_is_chosen_by_name(compared):
    tick(compared, "getme", VIEW)
    tick(compared, "laplacian", VIEW)
    press(button(compared, "Wipe"))
    left, right = compared.findChild(WipeRow).findChildren(QComboBox)
    assert [right.itemText(k) for k in range(right.count())] == ["now", title_of("getme"), title_of("laplacian")]
    for _ in range(2):
        QTest.keyClick(left, Qt.Key.Key_Down)  # to what is at the right: they change places
        compared.refresh()
    assert (left.currentText(), right.currentText()) == (title_of("laplacian"), title_of("getme"))
    seen = compared.canvas.panes.seen
    np.testing.assert_array_equal(
        seen[0].frame.mesh.points, compared.session.comparison.of("laplacian").state.mesh.points
    )


def test_the_table_is_saved_as_any_of_four_files_or_the_reason_given(compared, tmp_path):
    for suffix in (".csv", ".md", ".tex", ".json"):
        path = tmp_path / f"table{suffix}"
        assert compared.features["compare"].save(path)
        assert all(name in path.read_text() for name in ("initial", "getme", "laplacian", "local-sd"))
    record = json.loads((tmp_path / "table.json").read_text())
    assert [one["method"] for one in record["rows"]] == ["getme", "laplacian", "local-sd"]
    assert not compared.features["compare"].save(tmp_path / "table.doc")
    kind, words = compared.messages.messages()[-1][:2]
    assert kind == "error"
    assert not (tmp_path / "table.doc").exists()
    assert words


def test_a_picture_holds_all_views_with_their_captions(compared, tmp_path):
    for name in ("getme", "laplacian"):
        tick(compared, name, VIEW)
    assert compared.features["save"].picture(tmp_path / "three.png", (900, 420))
    three = np.asarray(Image.open(tmp_path / "three.png").convert("RGB")).astype(int)
    assert three.shape == (420, 900, 3)
    for k in range(3):
        part = three[:, 300 * k : 300 * (k + 1)]
        assert ((part.max(axis=2) - part.min(axis=2)) > 60).mean() > 0.1
        assert (part[:24].max(axis=2) < 90).sum() > 50  # letters
    key(compared, Qt.Key.Key_W)
    assert compared.features["save"].picture(tmp_path / "wiped.png", (900, 420))
    wiped = np.asarray(Image.open(tmp_path / "wiped.png").convert("RGB")).astype(int)
    assert (wiped[40:360, 449:452].max(axis=2) < 60).all(axis=0).any()  # the edge
