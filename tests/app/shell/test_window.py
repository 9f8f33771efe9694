"""The window, driven as a user drives it: mouse, keys, dropped files."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMessageBox, QPushButton, QToolButton

from hexmend import gallery, io
from hexmend.quality import METRICS
from hexmend_app.shell.program import report_unexpected_errors
from hexmend_app.state.document import State
from hexmend_app.state.look import ColourScale, RangeMode, ValueRange
from hexmend_app.state.run import Phase
from hexmend_app.state.task import running
from tests.app.driving import LEFT, click, drag, open_and_wait, phase, pixels
from tests.patience import PATIENCE


def test_an_opened_mesh_is_shown_with_its_figures(window):
    assert window.windowTitle().startswith("bridge.vtu")
    assert "4,000 hexes" in window.counts.text()
    summary = window.session.document.now.summary
    assert f"{summary.inverted:,}" in window.features["quality"].panel.text()
    assert not window.features["open"].welcome.isVisible()
    image = pixels(window)
    assert (image.max(axis=2) - image.min(axis=2) > 60).mean() > 0.05


def endless(window):
    """Choose a method that does not end before it is stopped."""
    window.features["smooth"].panel.set_method("local-sd")
    window.features["smooth"].panel.stop_form.set_values({"tolerance": 0.0})


def test_run_pause_step_stop_reset_by_mouse(window, qtbot):
    endless(window)
    start = window.session.document.now
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.RUNNING), timeout=PATIENCE)
    qtbot.waitUntil(lambda: window.session.document.now is not start, timeout=20000)
    click(window, "Pause")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=20000)
    qtbot.wait(100)
    held = window.session.document.now
    click(window, "Step")
    qtbot.waitUntil(lambda: window.session.document.now is not held, timeout=20000)
    assert window.session.document.now.summary.objective != held.summary.objective or held.summary.objective is None
    click(window, "Stop")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=20000)
    assert window.isWindowModified()
    assert window.session.document.undo_title == "Local steepest descent"
    click(window, "Reset")
    np.testing.assert_array_equal(window.session.document.now.mesh.points, start.mesh.points)
    assert window.session.document.undo_title == "reset"


def test_a_run_to_the_end_untangles_and_says_so(window, qtbot):
    window.features["smooth"].panel.stop_form.set_values({"tolerance": 1e-2})
    with qtbot.waitSignal(window.session.smoothing.ended, timeout=PATIENCE):
        QTest.keyClick(window.windowHandle(), Qt.Key.Key_F5)
    assert window.session.document.start.summary.inverted > 0
    assert window.session.document.now.summary.inverted == 0
    assert "none inverted" in window.counts.text()


def test_keys_step_undo_and_redo(window, qtbot):
    start = window.session.document.now
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_F10)
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_F5, Qt.KeyboardModifier.ShiftModifier)
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=20000)
    after = window.session.document.now
    assert after is not start
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    np.testing.assert_array_equal(window.session.document.now.mesh.points, start.mesh.points)
    QTest.keyClick(
        window.windowHandle(), Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    )  # fmt: skip
    assert window.session.document.now is after


def test_the_picture_follows_the_iterations(window, qtbot):
    before = pixels(window)
    click(window, "Step")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    qtbot.waitUntil(lambda: (np.abs(pixels(window) - before).sum(axis=2) > 60).mean() > 0.002, timeout=5000)


def test_the_colours_by_metric_map_and_range(window, qtbot):
    whole, panel, bar = pixels(window), window.features["look"].panel, window.canvas.colour_bar
    panel._metric.setFocus()
    other = panel._metric.findData("scaled-jacobian")
    while panel._metric.currentIndex() != other:
        key = Qt.Key.Key_Down if panel._metric.currentIndex() < other else Qt.Key.Key_Up
        QTest.keyClick(panel._metric, key)
    assert window.session.view.look.scale.metric == "scaled-jacobian"
    assert "Scaled Jacobian from -1 to 1" in bar.accessibleDescription()
    recoloured = pixels(window)
    assert (np.abs(recoloured - whole).sum(axis=2) > 60).mean() > 0.05
    panel._map.setFocus()
    QTest.keyClick(panel._map, Qt.Key.Key_Down)
    assert (np.abs(pixels(window) - recoloured).sum(axis=2) > 60).mean() > 0.05
    QTest.mouseClick(panel._mode.button("fitted"), LEFT)
    assert f"from {panel._low.value():g} to {panel._high.value():g}" in bar.accessibleDescription()
    assert not panel._low.isEnabled()
    start = window.session.document.now
    click(window, "Step")
    qtbot.waitUntil(lambda: window.session.document.now is not start, timeout=PATIENCE)
    now = window.session.document.now.figures
    values = now.scaled_jacobian[~now.inverted]
    assert (panel._low.value(), panel._high.value()) == pytest.approx((values.min(), values.max()), abs=0.01)
    QTest.mouseClick(panel._mode.button("pinned"), LEFT)
    assert window.session.view.look.scale.pinned == (panel._low.value(), panel._high.value())


@pytest.mark.parametrize("size", [(1440, 900), (1100, 700)])
def test_nothing_is_cut_off(window, qtbot, size):
    window.resize(*size)
    qtbot.wait(100)
    assert (window.width(), window.height()) == size
    panel = window.features["look"].panel
    for part in panel.findChildren(QPushButton):
        assert part.width() >= part.minimumWidth()
    for part in (panel, window.features["histogram"].panel, window.features["quality"].panel):
        assert part.mapTo(window, part.rect().bottomRight()).x() < size[0]
    for metric in METRICS:  # no metric's numbers make the window wider
        window.session.view.change(scale=ColourScale(metric, mode=RangeMode.FITTED))
        qtbot.wait(5)
        assert (window.width(), window.height()) == size
        assert panel.mapTo(window, panel.rect().bottomRight()).x() < size[0]


def test_brushing_the_histogram_keeps_a_range_in_view(window, qtbot):
    whole = pixels(window)
    view = window.features["histogram"].panel.plot.view
    plot = window.features["histogram"].panel.plot.plot

    def at(q):
        scene = view.mapViewToScene(QPointF(q, 10))
        return plot.mapFromScene(scene)

    drag(plot.viewport(), at(0.2), at(0.6))
    qtbot.waitUntil(lambda: window.session.view.look.quality_range is not None, timeout=3000)
    assert window.session.view.look.quality_range.metric == "q"
    low, high = window.session.view.look.quality_range.low, window.session.view.look.quality_range.high
    assert low == pytest.approx(0.2, abs=0.03)
    assert high == pytest.approx(0.6, abs=0.03)
    assert (np.abs(pixels(window) - whole).sum(axis=2) > 60).mean() > 0.01
    QTest.mouseClick(
        next(
            b for b in window.features["histogram"].panel.findChildren(QPushButton) if b.accessibleName() == "Show all"
        ),
        LEFT,
    )
    qtbot.waitUntil(lambda: window.session.view.look.quality_range is None, timeout=3000)


def choose(combo, name):
    """Walk to an entry by keys, as a hand does."""
    combo.setFocus()
    other = combo.findData(name)
    while combo.currentIndex() != other:
        QTest.keyClick(combo, Qt.Key.Key_Down if combo.currentIndex() < other else Qt.Key.Key_Up)


def brush(window, low, high):
    """Drag over the histogram from one place to another."""
    plot, view = window.features["histogram"].panel.plot.plot, window.features["histogram"].panel.plot.view
    middle = view.viewRect().center().y()
    ends = [plot.mapFromScene(view.mapViewToScene(QPointF(x, middle))) for x in (low, high)]
    drag(plot.viewport(), *ends)


def test_brushing_another_metric_filters_the_view_and_follows_a_run(window, qtbot):
    choose(window.features["histogram"].panel.head.metric, "max-angle")
    assert window.session.view.look.scale.metric == "q"  # colours are left alone
    brush(window, 0.75, 1.0)
    qtbot.waitUntil(lambda: window.session.view.look.quality_range is not None, timeout=3000)
    qtbot.wait(100)
    chosen, viewport = window.session.view.look.quality_range, window.canvas.viewport
    assert (chosen.metric, chosen.high) == ("max-angle", 180)
    assert chosen.low == pytest.approx(135, abs=4)

    def inside():
        mesh, figures = window.session.document.now.mesh, window.session.document.now.figures
        angles = METRICS["max-angle"].of(mesh.points, mesh.hexes, figures)
        return np.count_nonzero((angles >= chosen.low) & ~figures.inverted)

    start, shown = window.session.document.now, viewport.shown
    assert 0 < shown == inside() < 4000
    assert window.features["histogram"].panel.words.text().startswith(f"{shown:,} of 4,000 hexes from ")
    click(window, "Step")
    qtbot.waitUntil(lambda: window.session.document.now is not start, timeout=PATIENCE)
    assert viewport.shown == inside() != shown
    choose(
        window.features["histogram"].panel.head.metric, "volume"
    )  # what it hides could no longer be told from the plot
    assert window.session.view.look.quality_range is None


def test_the_histogram_counts_what_the_colours_show_until_a_range_or_the_user_holds_it(window, qtbot):
    histogram, colours = window.features["histogram"].panel, window.features["look"].panel._metric
    choose(colours, "scaled-jacobian")
    assert histogram.axis.metric == "scaled-jacobian"
    assert histogram.head.metric.currentText() == "Scaled Jacobian (as colours)"
    brush(window, 0.2, 0.5)
    qtbot.waitUntil(lambda: window.session.view.look.quality_range is not None, timeout=3000)
    choose(colours, "skew")  # colours laid over what the range leaves
    assert window.session.view.look.quality_range == histogram.range()
    assert histogram.axis.metric == histogram.range().metric == "scaled-jacobian"
    assert histogram.head.metric.currentText() == "Scaled Jacobian"
    choose(histogram.head.metric, "")
    assert histogram.axis.metric == "skew"
    assert histogram.range() is None
    choose(histogram.head.metric, "volume")
    choose(colours, "q")
    assert histogram.axis.metric == "volume"


def test_distributions_are_kept_under_the_name_of_the_moment_for_any_metric(window, qtbot, mesh_file):
    histogram, kept = window.features["histogram"].panel, window.features["histogram"].kept
    window.features["smooth"].panel.set_method("local-sd")
    start = window.session.document.now
    click(window, "Step")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    qtbot.waitUntil(lambda: window.session.document.now is not start, timeout=20000)
    (keep,) = (b for b in histogram.findChildren(QToolButton) if b.text() == "Keep")
    QTest.mouseClick(keep, LEFT)
    then = window.session.document.now
    click(window, "Step")
    qtbot.waitUntil(lambda: window.session.document.now is not then, timeout=20000)
    for _ in range(6):
        QTest.mouseClick(keep, LEFT)
    names = ["local-sd 1", *(f"local-sd 2{k}" for k in ("", " (2)", " (3)", " (4)", " (5)"))]
    assert [one.name for one in kept.all] == names
    assert not keep.isEnabled()
    choose(histogram.head.metric, "condition")
    drawn = {one.name: one.part for one in histogram.series()}
    of = METRICS["condition"].of
    np.testing.assert_array_equal(drawn["local-sd 1"].values, of(then.mesh.points, then.mesh.hexes, then.figures))
    assert drawn["local-sd 1"].inverted == then.summary.inverted
    np.testing.assert_array_equal(drawn["local-sd 2"].counts, drawn["now"].counts)
    qtbot.wait(50)
    QTest.mouseClick(histogram.legend.entries[1].cross, LEFT)
    assert "local-sd 2" not in [one.name for one in kept.all]
    assert keep.isEnabled()
    window.session.smoothing.stop()
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=20000)
    click(window, "Reset")
    QTest.mouseClick(keep, LEFT)
    assert kept.all[-1].name == "kept"
    assert len({one.slot for one in kept.all}) == 6
    open_and_wait(qtbot, window, mesh_file)
    assert not kept.all
    assert [one.name for one in histogram.series()] == ["at the start", "now"]


def test_what_a_range_leaves_is_drawn_anew_only_where_it_changes(window, qtbot, monkeypatch):
    viewport, now = window.canvas.viewport, window.session.document.now
    rebuilt = []
    rebuild = viewport.body.rebuild
    monkeypatch.setattr(viewport.body, "rebuild", lambda *what: (rebuilt.append(1), rebuild(*what)))
    window.session.view.change(quality_range=ValueRange("q", 0.4, 1))
    moved = State.of(now.mesh.with_points(now.mesh.points * 1.01))  # of the same shape
    window.session.document.preview(moved)
    assert len(rebuilt) == 1
    np.testing.assert_allclose(viewport.body.whole.points, viewport.body.faces.places(moved.mesh.points), rtol=1e-6)
    shaken = now.mesh.points + 0.3 * now.mesh.mean_edge_length * np.random.default_rng(0).random(now.mesh.points.shape)
    window.session.document.preview(State.of(now.mesh.with_points(shaken)))
    assert len(rebuilt) == 2
    figures = window.session.document.now.figures
    assert viewport.shown == np.count_nonzero((figures.q >= 0.4) & ~figures.inverted)


def test_a_bad_file_is_said_in_the_window_and_the_open_mesh_stays(window, qtbot, tmp_path):
    bad = tmp_path / "cut.vtk"
    bad.write_text("# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 float\n0 0 0\n")
    now = window.session.document.now
    with qtbot.waitSignal(window.session.opener.failed, timeout=20000):
        window.features["open"].open(bad)
    assert window.session.document.now is now
    ((kind, title, text),) = window.messages.messages()
    assert kind == "error"
    assert "cut.vtk" in title
    assert "POINTS ends after 1 of 8 rows" in text
    assert "bridge.vtu stays open" in text
    assert window.messages.isVisible()
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_Escape)
    assert not window.messages.isVisible()


def test_a_dropped_file_is_opened(window, qtbot, tmp_path):
    io.write(tmp_path / "five.mesh", gallery.make("five-side", size=500))
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(tmp_path / "five.mesh"))])
    event = QDropEvent(
        QPointF(50, 50), Qt.DropAction.CopyAction, data, LEFT, Qt.KeyboardModifier.NoModifier
    )  # fmt: skip
    with qtbot.waitSignal(window.session.opener.ended, timeout=20000):
        window.dropEvent(event)
    assert window.windowTitle().startswith("five.mesh")


def test_saving_writes_the_mesh_as_it_is_now(window, qtbot, tmp_path):
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_F10)
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    window.session.smoothing.stop()
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=20000)
    assert window.features["save"].mesh(tmp_path / "out.vtk")
    np.testing.assert_array_equal(io.read(tmp_path / "out.vtk").points, window.session.document.now.mesh.points)
    assert not window.isWindowModified()
    assert not window.features["save"].mesh(tmp_path / "missing" / "out.vtk")
    assert window.messages.messages()[-1][0] == "error"


@pytest.mark.parametrize("size", [(640, 480), (1500, 500)])
def test_a_picture_has_the_size_asked_for_whatever_the_window(window, tmp_path, size):
    window.session.view.set_clip(window.features["cut"].panel.proposal())
    assert window.features["save"].picture(tmp_path / "view.png", size)
    image = Image.open(tmp_path / "view.png")
    assert image.size == size
    colourful = np.ptp(np.asarray(image.convert("RGB")).astype(int), axis=2) > 60
    assert colourful.mean() > 0.05


def test_opening_another_mesh_while_a_method_runs(window, qtbot, mesh_file):
    endless(window)
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.RUNNING), timeout=PATIENCE)
    open_and_wait(qtbot, window, mesh_file)
    assert not window.session.smoothing.busy
    assert window.session.document.undo_title is None


def test_closing_while_running_leaves_no_thread(fresh_window, qtbot):
    window = fresh_window
    endless(window)
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.RUNNING), timeout=PATIENCE)
    assert [task.name for task in running()] == ["smoother local-sd"]
    window.close()
    assert running() == ()
    assert not window.isVisible()


def test_cancelling_keeps_the_window_and_its_run(fresh_window, qtbot, monkeypatch):
    window = fresh_window
    click(window, "Step")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    with monkeypatch.context() as patched:
        patched.setattr(QMessageBox, "exec", lambda self: QMessageBox.StandardButton.Cancel)
        window.close()
        assert window.isVisible()
        assert window.session.smoothing.phase is Phase.PAUSED


def test_unexpected_errors_are_shown(window, monkeypatch):
    import sys

    monkeypatch.setattr(sys, "excepthook", sys.excepthook)
    report_unexpected_errors(window)
    try:
        raise ZeroDivisionError("one over nothing")
    except ZeroDivisionError as error:
        sys.excepthook(type(error), error, error.__traceback__)
    assert "ZeroDivisionError: one over nothing" in window.messages.messages()[-1][2]


def test_a_method_with_a_wrong_value_is_not_started(window):
    editor = window.features["smooth"].panel.form.editor("p")
    window.features["smooth"].panel._sections[0].expand()
    target = editor.widget if hasattr(editor, "widget") else editor
    target.setFocus()
    line = target.lineEdit() if hasattr(target, "lineEdit") else target
    line.selectAll()
    QTest.keyClicks(line, "0.1")
    click(window, "Run")
    assert not window.session.smoothing.busy


def test_a_click_on_the_bar_of_the_inverted_shows_only_them(window, qtbot):
    plot, view = window.features["histogram"].panel.plot.plot, window.features["histogram"].panel.plot.view
    bar = window.features["histogram"].panel.axis.inverted
    place = plot.mapFromScene(view.mapViewToScene(QPointF(sum(bar) / 2, view.viewRect().center().y())))
    QTest.mouseClick(plot.viewport(), LEFT, pos=place)
    n_inverted = window.session.document.now.figures.n_inverted
    assert window.canvas.viewport.shown == n_inverted > 0
    QTest.keyClick(window, Qt.Key.Key_Escape)
    assert window.canvas.viewport.shown == 4000


def test_messages_and_the_colour_bar_lie_over_the_view_and_move_nothing(window, qtbot):
    canvas, bar = window.canvas, window.canvas.colour_bar
    before = canvas.interactor.geometry(), bar.geometry()
    assert canvas.interactor.rect().contains(bar.geometry())
    window.messages.show_error("The mesh was not saved", "There is no room. " * 20)
    qtbot.waitUntil(window.messages.isVisible)
    assert (canvas.interactor.geometry(), bar.geometry()) == before
    assert window.messages.width() <= 560
    window.resize(1000, 640)
    qtbot.wait(50)
    assert canvas.interactor.rect().contains(bar.geometry())
    QTest.keyClick(window, Qt.Key.Key_Escape)
    assert not window.messages.isVisible()


def test_the_mesh_is_not_turned_by_dragging_the_colour_bar(window):
    bar, camera = window.canvas.colour_bar, window.canvas.viewport.camera
    before, place = camera.position, bar.pos()
    drag(bar, QPoint(20, 15), QPoint(-80, 60))
    assert bar.pos() != place
    assert camera.position == before


def test_keys_reach_the_view_as_soon_as_a_mesh_is_shown(fresh_window):
    view = fresh_window.canvas.interactor
    fresh_window.canvas.hide()
    fresh_window.refresh()
    assert fresh_window.focusWidget() is view
    QTest.keyClick(view, Qt.Key.Key_Tab)
    assert fresh_window.docks.hidden
    QTest.keyClick(view, Qt.Key.Key_Tab)
    assert not fresh_window.docks.hidden


def test_the_folded_drawer_is_dragged_open(window):
    drawer, handle = window.docks.drawer, window.docks.drawer.parentWidget().handle(1)
    drawer.set_folded(True)
    at = handle.rect().center()
    QTest.mousePress(handle, LEFT, pos=at)
    QTest.mouseMove(handle, at - QPoint(0, 200))
    QTest.mouseRelease(handle, LEFT, pos=at)
    assert not drawer.folded
    assert drawer.height() > 150
