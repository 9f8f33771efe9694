"""Sessions saved from the window and restored: picture, tables and iteration."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog, QMessageBox

from benchmarks.window.windows import end_run
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.formats.session.archive import read_archive, write_archive
from hexmend_app.formats.session.session_file import VERSION
from hexmend_app.picture import Camera
from hexmend_app.picture.appearance import Arrows, Structure, Traces
from hexmend_app.picture.cut import Cut
from hexmend_app.state.run.breakpoints import Breakpoints
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import key, open_and_wait, phase, pixels
from tests.patience import PATIENCE


def run(window, qtbot, method, iterations=4):
    with qtbot.waitSignal(window.session.run.ended, timeout=PATIENCE):
        window.session.commands.run(Stage(METHODS[method](), StoppingCriteria(max_iterations=iterations, tolerance=0)))
    window.refresh()


def work(window, qtbot):
    """Change all parts of a session."""
    session = window.session
    run(window, qtbot, "laplacian")
    session.commands.tag("bad corner", [3, 5, 8])
    session.commands.pin(17, True)
    run(window, qtbot, "local-sd", 3)
    session.snapshots.add("a kept moment", session.document.now)
    with qtbot.waitSignal(session.comparison.changed, timeout=PATIENCE):
        session.comparison.start([METHODS["laplacian"](), METHODS["getme"]()], StoppingCriteria(max_iterations=2))
    qtbot.waitUntil(lambda: not session.comparison.busy, timeout=PATIENCE)
    session.timeline.go(session.history.records[0], 2)
    session.run_setup.choose(Stage(METHODS["getme"](relaxation=0.6), StoppingCriteria(max_iterations=77)), "a reason")
    session.recipe_draft.add(Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=5)))
    session.recipe_draft.rename("two of them")
    window.features["smooth"].panel.breakpoint_form.set_breakpoints(Breakpoints(inverts=True, node=12, move=0.25))
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


def seen(window, qtbot):
    """Return the pixels of the view when all tasks and animations have ended."""
    session = window.session
    window.refresh()
    qtbot.waitUntil(
        lambda: session.structure_finder.structure is not None and not session.boundary_classifier.busy,
        timeout=PATIENCE,
    )
    window.refresh()
    window.canvas.draw_still()
    pixels(window)
    mesh_layer, shading_task = window.canvas.viewport.mesh_layer, window.canvas.shading_task
    qtbot.waitUntil(lambda: mesh_layer.light is not None and not shading_task.active, timeout=PATIENCE)
    return pixels(window)


def tables(window):
    """Return the data of tables and charts."""
    session = window.session
    history = session.history
    moment = session.timeline.shown_iteration
    return {
        "summary": session.document.now.summary,
        "start": session.document.start.summary,
        "undo": session.document.undo_title,
        "redo": session.document.redo_title,
        "runs": [(r.name, r.title, r.rows, r.result, r.message, r.pauses) for r in history.records],
        "advice": [
            (r.advice.reason, [(one.title, one.smoother, one.stop) for one in r.advice.suggestions])
            for r in history.records
        ],
        "parents": [(r.parent.record.name, r.parent.number) if r.parent else None for r in history.records],
        "kept iterations": [history.recorded_numbers(r).tolist() for r in history.records],
        "gone through": session.timeline.record.name,
        "moment": (moment.record.name, moment.number),
        "compared": [(one.row.method, one.row.message, one.row.after) for one in session.comparison.results],
        "look": session.view.look,
        "counted": window.features["histogram"].metric,
        "kept": [(one.slot, one.name) for one in session.snapshots.all],
        "cameras": list(session.saved_cameras.all.items()),
        "chosen": (session.selection.hex, session.selection.node),
        "order": (session.run_setup.stage, session.run_setup.reason),
        "chain": session.recipe_draft.to_data(),
        "breakpoints": session.run.breakpoints,
        "form": window.features["smooth"].panel.breakpoint_form.breakpoints(),
        "tags": {name: members.tolist() for name, members in session.document.now.mesh.hex_sets.items()},
        "pins": np.flatnonzero(session.document.now.mesh.pinned).tolist(),
    }


@pytest.mark.slow
def test_a_session_is_restored(window, qtbot, tmp_path, mesh_file):
    work(window, qtbot)
    path = tmp_path / "work.hexmend"
    session = window.session
    picture, before = seen(window, qtbot), tables(window)
    points = session.document.now.mesh.points
    positions = [[r.points(n) for n in session.history.recorded_numbers(r)] for r in session.history.records]
    assert window.features["session"].save_and_wait(path)
    open_and_wait(qtbot, window, mesh_file)
    window.refresh()
    assert not session.history.records
    open_and_wait(qtbot, window, path)
    np.testing.assert_array_equal(seen(window, qtbot), picture)
    assert tables(window) == before
    np.testing.assert_array_equal(session.document.now.mesh.points, points)
    for record, places in zip(session.history.records, positions, strict=True):
        for number, place in zip(session.history.recorded_numbers(record), places, strict=True):
            np.testing.assert_array_equal(record.points(number), place)


@pytest.mark.slow
def test_a_restored_session_can_be_continued(window, qtbot, tmp_path):
    """Undo, timeline, branches, breakpoints and runs work after restoring."""
    work(window, qtbot)
    session = window.session
    window.features["session"].save_and_wait(tmp_path / "work.hexmend")
    undone = []
    for _ in range(4):
        session.commands.undo()
        undone.append((session.document.now.mesh.points, session.document.redo_title))
    open_and_wait(qtbot, window, tmp_path / "work.hexmend")
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
    session.run.break_at(Breakpoints())
    run(window, qtbot, "laplacian", 2)
    assert [record.name for record in session.history.records][-1] == "Laplacian (2)"
    assert session.history.records[-1].parent.record is first


def test_the_title_shows_the_session_and_unsaved_changes(window, qtbot, tmp_path):
    run(window, qtbot, "laplacian")
    assert window.isWindowModified()
    window.features["session"].save_and_wait(tmp_path / "work.hexmend")
    window.refresh()
    assert window.windowTitle().startswith("work.hexmend")
    assert not window.isWindowModified()
    open_and_wait(qtbot, window, tmp_path / "work.hexmend")
    window.refresh()
    assert window.windowTitle().startswith("work.hexmend")
    assert not window.isWindowModified()
    window.session.commands.undo()
    window.refresh()
    assert window.isWindowModified()


@pytest.mark.slow
def test_a_displayed_iteration_is_not_a_change(window, qtbot, tmp_path):
    run(window, qtbot, "laplacian")
    session = window.session
    session.timeline.go(session.history.records[0], 1)
    window.features["session"].save_and_wait(tmp_path / "work.hexmend")
    assert session.document.previews
    assert not session.document.modified
    open_and_wait(qtbot, window, tmp_path / "work.hexmend")
    assert session.document.previews
    assert session.timeline.shown_iteration.number == 1
    session.timeline.go_to_newest()
    assert session.document.now.summary == session.history.records[0].end.summary


@pytest.mark.slow
def test_unsaved_work_is_saved_to_the_opened_session(window, qtbot, tmp_path, monkeypatch):
    window.features["session"].save_and_wait(tmp_path / "work.hexmend")
    run(window, qtbot, "laplacian")
    asked = []
    monkeypatch.setattr(QMessageBox, "exec", lambda self: QMessageBox.StandardButton.Save)
    monkeypatch.setattr(
        QFileDialog, "getSaveFileName", lambda *given: asked.append(given[2:4]) or (str(tmp_path / "new"), given[3])
    )
    assert window.may_leave()
    ((proposed, kind),) = asked
    assert proposed.endswith("work.hexmend")
    assert kind == "Hexmend session (*.hexmend)"
    open_and_wait(qtbot, window, tmp_path / "new.hexmend")
    assert [record.name for record in window.session.history.records] == ["Laplacian"]


@pytest.mark.slow
def test_a_paused_run_is_saved(window, qtbot, tmp_path):
    key(window, Qt.Key.Key_F10)
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    window.refresh()
    assert window.action("save_session").isEnabled()
    points = window.session.document.now.mesh.points
    window.features["session"].save_and_wait(tmp_path / "work.hexmend")
    end_run(window.session)
    open_and_wait(qtbot, window, tmp_path / "work.hexmend")
    np.testing.assert_array_equal(window.session.document.now.mesh.points, points)
    assert window.session.timeline.shown_iteration.number == 1
    window.refresh()


@pytest.mark.slow
def test_a_damaged_session_is_rejected_and_the_open_mesh_stays(window, qtbot, tmp_path):
    path = tmp_path / "work.hexmend"
    window.features["session"].save_and_wait(path)
    description = read_archive(path, "Hexmend session", VERSION)
    description["window"]["view"]["look"]["colour"] = "red"
    write_archive(path, "Hexmend session", VERSION, description)
    now = window.session.document.now
    with qtbot.waitSignal(window.session.opener.failed, timeout=PATIENCE):
        window.features["open"].open(path)
    assert window.session.document.now is now
    (text,) = (text for kind, _, text in window.messages.messages() if kind == "error")
    assert "the window.view.look: [look] has an unknown key 'colour'" in text
