"""The window stays responsive while a mesh is saved or repaired and while a run ends."""

import threading

import numpy as np
import pytest
from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QApplication, QDialog, QDialogButtonBox, QMessageBox

from hexmend import METHODS, Mesh, Stage, StoppingCriteria, gallery, io
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.tasks import mesh_change, mesh_saver
from hexmend_app.state.tasks.task import running
from hexmend_app.widgets.dialogs import questions
from tests.app.driving import key, open_and_wait, open_mesh, phase, smooth, turn
from tests.patience import PATIENCE


class Gate:
    """Wrapper of a function that blocks its callers until it is opened."""

    def __init__(self, function):
        self.function = function
        self.reached, self.opened = threading.Event(), threading.Event()

    def __call__(self, *values):
        self.reached.set()
        assert self.opened.wait(PATIENCE / 1000)
        return self.function(*values)


@pytest.fixture
def gate(monkeypatch):
    """Return a function that gates a function of a module; gates are opened at the end, so that no thread is left."""
    gates = []

    def hold(module, name):
        gates.append(Gate(getattr(module, name)))
        monkeypatch.setattr(module, name, gates[-1])
        return gates[-1]

    yield hold
    for one in gates:
        one.opened.set()


def test_a_mesh_is_saved_only_when_it_is_written(window, qtbot, tmp_path, gate):
    smooth(qtbot, window.session)
    session, writing = window.session, gate(mesh_saver, "write_as_given")
    saving = session.commands.save_in_background(tmp_path / "out.vtu")
    qtbot.waitUntil(writing.reached.is_set)
    window.refresh()
    assert window.busy.text() == "Saving out.vtu…"
    assert window.windowTitle().startswith("bridge.vtu")
    assert window.isWindowModified()
    key(window, Qt.Key.Key_N)  # the window does what it is asked to
    assert session.selection.hex is not None
    with qtbot.waitSignal(session.saver.ended):
        writing.opened.set()
    window.refresh()
    assert saving.error is None
    assert window.busy.isHidden()
    assert window.windowTitle().startswith("out.vtu")
    assert not window.isWindowModified()
    np.testing.assert_array_equal(io.read(tmp_path / "out.vtu").points, session.document.now.mesh.points)


@pytest.mark.slow
def test_changes_during_a_save_are_not_saved(window, qtbot, tmp_path, gate):
    smooth(qtbot, window.session)
    session, writing = window.session, gate(mesh_saver, "write_as_given")
    then = session.document.now
    session.commands.save_in_background(tmp_path / "out.vtu")
    qtbot.waitUntil(writing.reached.is_set)
    session.commands.reset()
    with qtbot.waitSignal(session.saver.ended):
        writing.opened.set()
    assert session.document.modified
    np.testing.assert_array_equal(io.read(tmp_path / "out.vtu").points, then.mesh.points)
    session.commands.undo()
    assert not session.document.modified


@pytest.mark.slow
def test_a_file_contains_the_last_of_several_saves(window, qtbot, tmp_path, gate):
    session, writing = window.session, gate(mesh_saver, "write_as_given")
    path = tmp_path / "out.vtu"
    first = session.commands.save_in_background(path)
    qtbot.waitUntil(writing.reached.is_set)
    smooth(qtbot, window.session)
    second = session.commands.save_in_background(path)
    writing.opened.set()
    qtbot.waitUntil(lambda: first.over and second.over)
    assert (first.error, second.error) == (None, None)
    np.testing.assert_array_equal(io.read(path).points, session.document.now.mesh.points)
    assert not session.document.modified


@pytest.mark.slow
@pytest.mark.parametrize("answer", ["wait", "do not wait", "cancel"])
def test_leaving_waits_for_a_save_or_asks(window, qtbot, tmp_path, gate, monkeypatch, answer):
    monkeypatch.setattr(QMessageBox, "exec", QDialog.exec)  # other tests answer at once, and wait without a dialog
    monkeypatch.setattr(questions, "_DELAY", 1)
    session, writing = window.session, gate(mesh_saver, "write_as_given")
    session.commands.save_in_background(tmp_path / "out.vtu")
    qtbot.waitUntil(writing.reached.is_set)

    def press():
        dialog = QApplication.activeModalWidget()
        if not isinstance(dialog, QMessageBox):
            return
        asking.stop()
        roles = QDialogButtonBox.ButtonRole
        role = {"do not wait": roles.AcceptRole, "cancel": roles.RejectRole}.get(answer)
        box = dialog.findChild(QDialogButtonBox)
        if role is None:
            writing.opened.set()
        else:
            next(one for one in box.buttons() if box.buttonRole(one) == role).click()

    asking = QTimer(interval=50)
    asking.timeout.connect(press)
    asking.start()
    assert window.confirm_close() == (answer != "cancel")
    assert (tmp_path / "out.vtu").exists() == (answer == "wait")
    writing.opened.set()
    qtbot.waitUntil(lambda: not session.saver.busy)


@pytest.fixture
def doubled(window, qtbot, tmp_path):
    """A window with a mesh in which every third hex is there twice."""
    mesh = gallery.make("cube", size=64)
    twice = Mesh(mesh.points, np.concatenate([mesh.hexes, mesh.hexes[::3]]))
    open_mesh(qtbot, window, tmp_path / "twice.vtu", twice)
    return window


def test_a_mesh_is_repaired_while_the_window_is_alive(doubled, qtbot, gate):
    session, repairing = doubled.session, gate(mesh_change, "repair")
    before = session.document.now
    session.commands.repair()
    qtbot.waitUntil(repairing.reached.is_set)
    doubled.refresh()
    assert doubled.busy.text() == "Repairing mesh…"
    assert not session.editable
    session.commands.repair()
    session.commands.run(Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=2)))
    assert not session.run.busy
    key(doubled, Qt.Key.Key_N)
    assert (session.document.now, session.document.undo_title) == (before, None)
    with qtbot.waitSignal(session.repairer.ended):
        repairing.opened.set()
    doubled.refresh()
    assert session.document.now.summary.hexes == 64
    assert session.editable
    session.commands.undo()
    assert session.document.now is before


@pytest.mark.slow
@pytest.mark.parametrize("end", ["cancel", "open another"])
def test_a_repair_that_is_given_up_changes_nothing(doubled, qtbot, gate, end, mesh_file):
    session, repairing = doubled.session, gate(mesh_change, "repair")
    session.commands.repair()
    qtbot.waitUntil(repairing.reached.is_set)
    if end == "cancel":
        session.repairer.cancel()
    else:
        open_and_wait(qtbot, doubled, mesh_file)
    now = session.document.now
    repairing.opened.set()
    qtbot.waitUntil(lambda: running() == ())
    turn()
    assert session.document.now is now
    assert session.editable
    doubled.refresh()
    assert doubled.busy.isHidden()


@pytest.mark.slow
@pytest.mark.parametrize("what", ["reset", "open", "branch"])
def test_actions_that_end_a_run_wait_for_its_iteration(window, qtbot, what, mesh_file, monkeypatch):
    session = window.session
    going, goes_on = threading.Event(), threading.Event()
    method = METHODS["laplacian"]
    steps = method.steps

    def slow(self, *values):
        for step in steps(self, *values):
            going.set()
            assert goes_on.wait(PATIENCE / 1000)
            yield step

    monkeypatch.setattr(method, "steps", slow)
    stage = Stage(method(), StoppingCriteria(max_iterations=30, tolerance=0))
    session.commands.run(stage)
    qtbot.waitUntil(going.is_set)
    start, first = session.document.now, session.run.record
    commands = session.commands
    {"reset": commands.reset, "open": lambda: commands.open(mesh_file), "branch": lambda: commands.branch(stage)}[
        what
    ]()
    assert session.run.phase is Phase.STOPPING
    window.refresh()
    assert window.busy.text() == "Stopping…"
    goes_on.set()
    if what == "open":
        qtbot.waitUntil(lambda: session.document.now is not start and not session.run.busy)
        qtbot.waitUntil(lambda: not session.opener.busy)
        assert session.history.records == []
    elif what == "reset":
        qtbot.waitUntil(lambda: not session.run.busy)
        np.testing.assert_array_equal(session.document.now.mesh.points, start.mesh.points)
    else:
        qtbot.waitUntil(lambda: session.run.record is not first)
        qtbot.waitUntil(phase(window, Phase.FINISHED))
