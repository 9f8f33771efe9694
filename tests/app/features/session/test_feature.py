"""Sessions saved from the window and restored: picture, tables and iteration."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMessageBox

from benchmarks.window.windows import end_run
from hexmend import METHODS, Stage, StoppingCriteria
from hexmend_app.picture import Camera, Cut
from hexmend_app.picture.appearance import Arrows, Structure, Traces
from hexmend_app.state.run.breakpoints import Breakpoints
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import key, open_and_wait, phase, smooth


@pytest.fixture
def path(tmp_path):
    return tmp_path / "work.hexmend"


def work(window, qtbot):
    """Change all parts of a session."""
    session = window.session
    smooth(qtbot, session)
    session.commands.tag("bad corner", [3, 5, 8])
    session.commands.pin(17, True)
    smooth(qtbot, session, "local-sd")
    session.snapshots.add("a kept moment", session.document.now)
    with qtbot.waitSignal(session.comparison.changed):
        session.comparison.start([METHODS["laplacian"](), METHODS["getme"]()], StoppingCriteria(max_iterations=2))
    qtbot.waitUntil(lambda: not session.comparison.busy)
    session.timeline.go(session.history.records[0], 2)
    session.run_setup.choose(Stage(METHODS["getme"](relaxation=0.6), StoppingCriteria(max_iterations=77)), "a reason")
    session.recipe_draft.add(Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=5)))
    session.recipe_draft.rename("two of them")
    session.run.set_breakpoints(Breakpoints(inverts=True, node=12, move=0.25))
    session.view.change(
        cut=Cut.at((1, 0, 0.2), session.document.now.mesh.points.mean(axis=0)),
        structure=Structure.of("sharp", "fixed"),
        movement=Traces(arrows=Arrows.SIGHT, factor=2.0),
        colours={"metric": "scaled-jacobian", "map": "plasma"},
        show={"quality": (-1.0, 0.9), "metric": "scaled-jacobian", "inverted": True, "hidden": frozenset({40, 41})},
    )
    session.view.counted = "volume"
    session.saved_cameras.add("from below", Camera("-z"))
    session.saved_cameras.add("as it is", Camera.at(window.canvas.pose))
    session.selection.choose(9, int(session.document.now.mesh.hexes[9, 3]))
    window.refresh()
    window.canvas.look_along("-x")
    window.canvas.roll(20)


@pytest.mark.slow
def test_a_restored_session_can_be_continued(window, qtbot, path):
    """Undo, timeline, branches, breakpoints and runs work after restoring."""
    work(window, qtbot)
    session = window.session
    window.features["save"].save_and_wait(path)
    undone = []
    for _ in range(4):
        session.commands.undo()
        undone.append((session.document.now.mesh.points, session.document.redo_title))
    open_and_wait(qtbot, window, path)
    for points, title in undone:
        session.commands.undo()
        np.testing.assert_array_equal(session.document.now.mesh.points, points)
        assert session.document.redo_title == title
    assert session.document.now is session.document.start
    while session.document.redo_title is not None:
        session.commands.redo()
    first = session.history.records[0]
    session.timeline.choose(first)
    assert (session.timeline.shown_iteration.record, session.timeline.shown_iteration.number) == (first, first.result)
    session.view.change(show={"peel": 0})
    session.run.set_breakpoints(Breakpoints())
    smooth(qtbot, session)
    assert [record.name for record in session.history.records][-1] == "Laplacian (2)"
    assert session.history.records[-1].parent.record is first


def test_the_title_shows_the_session_and_unsaved_changes(window, qtbot, path):
    smooth(qtbot, window.session)
    window.refresh()
    assert window.isWindowModified()
    for act in (window.features["save"].save_and_wait, lambda path: open_and_wait(qtbot, window, path)):
        act(path)
        window.refresh()
        assert window.windowTitle().startswith("work.hexmend")
        assert not window.isWindowModified()
    window.session.commands.undo()
    window.refresh()
    assert window.isWindowModified()


@pytest.mark.slow
def test_a_displayed_iteration_is_not_a_change(window, qtbot, path):
    smooth(qtbot, window.session)
    session = window.session
    session.timeline.go(session.history.records[0], 1)
    window.features["save"].save_and_wait(path)
    assert session.document.previews
    assert not session.document.modified
    open_and_wait(qtbot, window, path)
    assert session.document.previews
    assert session.timeline.shown_iteration.number == 1
    session.timeline.go_to_newest()
    assert session.document.now.summary == session.history.records[0].end.summary


@pytest.mark.slow
def test_unsaved_work_is_saved_to_the_opened_session(window, qtbot, path, monkeypatch):
    window.features["save"].save_and_wait(path)
    smooth(qtbot, window.session)
    monkeypatch.setattr(QMessageBox, "exec", lambda self: QMessageBox.StandardButton.Save)
    assert window.confirm_close()
    open_and_wait(qtbot, window, path)
    assert [record.name for record in window.session.history.records] == ["Laplacian"]


@pytest.mark.slow
def test_a_paused_run_is_saved(window, qtbot, path):
    key(window, Qt.Key.Key_F10)
    qtbot.waitUntil(phase(window, Phase.PAUSED))
    window.refresh()
    assert window.action("save_session").isEnabled()
    points = window.session.document.now.mesh.points
    window.features["save"].save_and_wait(path)
    end_run(window.session)
    open_and_wait(qtbot, window, path)
    np.testing.assert_array_equal(window.session.document.now.mesh.points, points)
    assert window.session.timeline.shown_iteration.number == 1
    window.refresh()
