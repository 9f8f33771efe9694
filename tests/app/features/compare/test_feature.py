"""Comparisons in the window, by mouse and keys: the table."""

from threading import Event

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog, QLabel, QToolButton

from hexmend import METHODS, StoppingCriteria, compare
from hexmend_app.canvas.wipe_handle import WipeHandle
from hexmend_app.features.compare.comparison_table import METHOD, VIEW, ComparisonModel, ComparisonRow, title_of
from hexmend_app.features.side_views.feature import STEP
from hexmend_app.picture.cut import Cut
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.theme.palette import MUTED
from tests.app.driving import LEFT, choose, drag, key, named, phase, pixels, press, seen_at
from tests.app.features.compare.table import (
    COLUMN,
    ENDLESS,
    SHORT,
    button,
    captions,
    choose_methods,
    model,
    row,
    table_of,
    tick,
)
from tests.patience import PATIENCE


@pytest.mark.slow
def test_the_table_has_the_values_of_the_core_and_the_mesh_does_not_change(compared):
    before = compared.session.document.start.mesh
    assert compared.session.document.now.mesh is before
    expected = compare(before, ["getme", "laplacian", "local-sd"], SHORT)
    for one in expected.rows:
        record = model(compared).rows[row(compared, one.method)].record
        assert record["q_min"] == one.after.q_min
        assert record["inverted"] == one.after.inverted
        assert record["iterations"] == 4
        help = model(compared).index(row(compared, one.method), METHOD).data(Qt.ItemDataRole.ToolTipRole)
        assert f"{one.method} max_iterations=4" in help
    assert [one.name for one in model(compared).rows[:4]] == ["initial", "getme", "laplacian", "local-sd"]
    corner = compared.statusBar()
    assert named(corner, QLabel, "Counts").isVisible()  # the table does not cover the counts
    best = min(expected.rows, key=lambda one: one.after.inverted).method
    cell = model(compared).index(row(compared, best), COLUMN["inverted"])
    assert cell.data(Qt.ItemDataRole.FontRole).bold()
    assert cell.data(Qt.ItemDataRole.AccessibleTextRole).endswith("best")


@pytest.mark.slow
def test_cancel_stops_after_the_current_iteration_and_keeps_the_results(comparing, qtbot, monkeypatch):
    reached, resume = Event(), Event()
    steps = METHODS["local-sd"].steps

    def paused(self, mesh):
        for number, step in enumerate(steps(self, mesh)):  # number 0 is the initial mesh
            if number == 3:
                reached.set()
                assert resume.wait(PATIENCE / 1000)
            yield step

    monkeypatch.setattr(METHODS["local-sd"], "steps", paused)
    comparison = comparing.session.comparison
    choose(comparing, "mend", ENDLESS)
    choose_methods(comparing, "local-sd", "mend")
    press(button(comparing, "Compare methods"))
    qtbot.waitUntil(reached.is_set)
    comparing.refresh()
    enabled = comparing.window_actions["compare"].isEnabled()
    press(button(comparing, "Cancel comparison"))
    status = named(comparing.features["compare"].panel, QLabel, "Comparison progress")
    ending = status.text()
    resume.set()
    assert not enabled
    assert ending == f"Stopping {METHODS['local-sd'].title} after this iteration…"
    qtbot.waitUntil(lambda: not comparison.busy)
    (one,) = comparison.results
    assert one.row.outcome == "stopped"
    assert one.row.iterations == 3
    assert comparison.interrupted
    comparing.refresh()
    assert "interrupted" in status.text()
    assert comparing.window_actions["compare"].isEnabled()


def test_the_table_is_saved_by_its_button(compared, tmp_path, monkeypatch):
    path = tmp_path / "table.csv"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(path), ""))
    press(compared.features["compare"].panel.save_button)
    assert {name in path.read_text() for name in ("laplacian", "getme", "local-sd")} == {True}


def test_a_result_replaces_the_mesh_and_can_be_undone(compared):
    before = compared.session.document.now.mesh
    assert not button(compared, "Use result").isEnabled()
    index = model(compared).index(row(compared, "laplacian"), COLUMN["inverted"])
    table = table_of(compared)
    QTest.mouseClick(table.viewport(), LEFT, pos=table.visualRect(index).center())
    press(button(compared, "Use result"))
    taken = compared.session.comparison.of("laplacian").state
    np.testing.assert_array_equal(compared.session.document.now.mesh.points, taken.mesh.points)
    assert compared.session.document.undo_title == METHODS["laplacian"].title
    key(compared, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert compared.session.document.now.mesh is before


def test_equal_texts_are_marked_alike():
    rows = [
        ComparisonRow(name, "", {"seconds": seconds, "q_min": q, "scaled_jacobian_min": -0.5, "iterations": 9})
        for name, seconds, q in (("laplacian", 0.0123, 0.30001), ("getme", 19.522, 0.3), ("local-sd", 1.0, 0.1))
    ]
    table = ComparisonModel([])
    table.fill(rows, full=False, busy=False)
    texts = {
        one.name: [table.index(at, COLUMN[key]).data() for key in ("seconds", "q_min", "scaled_jacobian_min")]
        for at, one in enumerate(table.rows)
    }
    assert texts["laplacian"] == ["0.0123", "0.3000", "−0.5000"]
    assert texts["getme"] == ["19.52", "0.3000", "−0.5000"]
    bold = {
        one.name
        for at, one in enumerate(table.rows)
        if table.index(at, COLUMN["q_min"]).data(Qt.ItemDataRole.FontRole) is not None
    }
    assert bold == {"laplacian", "getme"}


# Results of all runs.


def run(window, qtbot, name, stop, **values):
    """Run a method from the mesh at the start."""
    window.session.commands.reset()
    window.session.run.start(METHODS[name](**values), stop)
    qtbot.waitUntil(phase(window, Phase.FINISHED))
    return window.session.timeline.record


@pytest.mark.slow
def test_runs_are_rows_and_a_dominated_one_is_grey(comparing, qtbot):
    better = run(comparing, qtbot, "local-sd", StoppingCriteria(max_iterations=8))
    worse = run(comparing, qtbot, "local-sd", StoppingCriteria(max_iterations=1), p=4)
    table = model(comparing)
    at = [row(comparing, f"Run: {record.name}") for record in (better, worse)]
    for number, record in zip(at, (better, worse), strict=True):
        assert table.rows[number].record["q_min"] == record.end.summary.q_min
        assert not table.flags(table.index(number, METHOD)) & Qt.ItemFlag.ItemIsUserCheckable
    grey = table.index(at[1], METHOD)
    assert grey.data(Qt.ItemDataRole.ForegroundRole).color().name() == str(MUTED)
    assert f"Dominated by Run: {better.name}" in grey.data(Qt.ItemDataRole.ToolTipRole)
    assert "p=4, max_iterations=1" in grey.data(Qt.ItemDataRole.ToolTipRole)
    assert table.index(at[0], METHOD).data(Qt.ItemDataRole.ForegroundRole) is None
    tick(comparing, f"Run: {worse.name}", VIEW)
    assert comparing.session.side_views.all[0].state is worse.end


def test_the_result_of_a_run_and_the_mesh_at_the_start_are_shown(comparing, qtbot):
    first = run(comparing, qtbot, "local-sd", StoppingCriteria(max_iterations=2))
    run(comparing, qtbot, "laplacian", StoppingCriteria(max_iterations=1, keep_last=True))
    timeline, document = comparing.session.timeline, comparing.session.document
    table = table_of(comparing)
    table.selectRow(row(comparing, f"Run: {first.name}"))
    press(button(comparing, "Use result"))
    assert (timeline.shown_iteration.record, timeline.shown_iteration.number) == (first, first.result)
    table.selectRow(row(comparing, "initial"))
    press(button(comparing, "Use result"))
    np.testing.assert_array_equal(document.now.mesh.points, document.start.mesh.points)


# Results of a comparison in views side by side, by mouse and keys.


def test_results_are_shown_next_to_the_mesh_and_named_in_the_histogram(compared):
    for count, name in enumerate(("getme", "laplacian", "local-sd"), 2):
        tick(compared, name, VIEW)
        assert len(compared.canvas.panes.all) == count
    assert captions(compared) == ["now", title_of("getme"), title_of("laplacian"), title_of("local-sd")]
    assert [one.name for one in compared.session.snapshots.all] == [
        title_of("getme"),
        title_of("laplacian"),
        title_of("local-sd"),
    ]
    series = compared.features["histogram"].panel.shown.shown
    assert [one.name for one in series][2:] == [title_of("getme"), title_of("laplacian"), title_of("local-sd")]
    initial = model(compared).index(0, VIEW)
    assert not model(compared).flags(initial) & Qt.ItemFlag.ItemIsEnabled  # four views are open
    tick(compared, "initial", VIEW)
    assert len(compared.canvas.panes.all) == 4
    for view, name in zip(compared.canvas.panes.all[1:], ("getme", "laplacian", "local-sd"), strict=True):
        state = compared.session.comparison.of(name).state
        np.testing.assert_array_equal(view.frame.mesh.points, state.mesh.points)


@pytest.mark.slow
def test_one_view_is_closed_by_its_button_and_all_by_a_key(compared):
    for name in ("getme", "laplacian", "local-sd"):
        tick(compared, name, VIEW)
    press(named(compared, QToolButton, f"Close the view of {title_of('laplacian')}"))
    assert captions(compared) == ["now", title_of("getme"), title_of("local-sd")]
    assert not model(compared).rows[row(compared, "laplacian")].shown
    assert [one.name for one in compared.session.snapshots.all] == [title_of("getme"), title_of("local-sd")]
    key(compared, Qt.Key.Key_W, Qt.KeyboardModifier.ControlModifier)
    assert captions(compared) == []
    assert compared.session.snapshots.all == ()


@pytest.mark.slow
@pytest.mark.parametrize("wiping", [False, True], ids=["side by side", "wipe, the mesh at the right"])
def test_a_plane_dragged_in_the_first_view_cuts_all_views(compared, qtbot, wiping):
    tick(compared, "getme", VIEW)
    if wiping:
        compared.session.side_views.set_wiping(True)
        compared.session.side_views.move_wipe(0.1)
        compared.session.side_views.choose_wiped(1, 0)
    centre = compared.session.document.now.mesh.points.mean(axis=0)
    compared.session.view.set_cut(Cut.at((0, 0, 1), tuple(centre)))
    compared.refresh()
    QApplication.processEvents()  # the row of the wipe makes the view smaller
    pixels(compared)
    x, y, z = compared.session.view.look.cut.planes[0].point
    place = seen_at(compared, (x + 4, y - 4, z))  # on the plane, next to its arrow
    before = compared.canvas.panes.all[1].shown
    drag(compared.canvas.interactor, place, place + QPoint(0, -30))
    assert compared.session.view.look.cut.planes[0].point[2] > z
    compared.refresh()
    first, second = compared.canvas.panes.all
    assert second.shown == first.shown != before


# The wipe: two results in one view with an edge to drag.


@pytest.mark.slow
def test_the_wipe_is_switched_and_moved_by_mouse_and_keys(compared, qtbot):
    tick(compared, "getme", VIEW)
    tick(compared, "laplacian", VIEW)
    key(compared, Qt.Key.Key_W)
    wipe, handle = compared.session.side_views.wipe, compared.findChild(WipeHandle)
    assert (wipe.left, wipe.right, wipe.at) == (0, 2, 0.5)
    assert handle.isVisible()
    assert captions(compared) == []
    width = compared.canvas.interactor.width()
    knob = handle.rect().center()
    drag(handle, knob, knob + QPoint(-width // 5, 0), steps=1)
    assert compared.session.side_views.wipe.at == pytest.approx(0.3, abs=0.01)
    assert handle.geometry().center().x() == pytest.approx(0.3 * width, abs=3)
    at = compared.session.side_views.wipe.at
    handle.setFocus()
    QTest.keyClick(handle, Qt.Key.Key_Right)
    assert compared.session.side_views.wipe.at == pytest.approx(at + STEP)
    QTest.keyClick(handle, Qt.Key.Key_Left)
    compared.refresh()
    assert compared.session.side_views.wipe.at == pytest.approx(at)
    key(compared, Qt.Key.Key_W)
    assert captions(compared) == ["now", title_of("getme"), title_of("laplacian")]
    assert not handle.isVisible()
