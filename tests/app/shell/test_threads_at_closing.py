"""Threads that still write the session of a window keep nothing else waiting."""

import os
import threading

import pytest

from hexmend_app.state.session import session_data
from hexmend_app.state.session.recovery import VARIABLE
from hexmend_app.state.tasks.task import Task, running
from tests.app.driving import open_and_wait
from tests.patience import PATIENCE
from tests.programs import run_python

pytestmark = pytest.mark.slow


@pytest.fixture
def windows(tmp_path, monkeypatch):
    """The folder of the folders in which windows are kept safe from a crash."""
    monkeypatch.setenv(VARIABLE, str(tmp_path / "state"))
    return tmp_path / "state" / "windows"


@pytest.fixture
def kept(window, qtbot, gate, windows, monkeypatch):
    """A window whose session is being written beside it, until the gate is opened."""
    reached, write = threading.Event(), session_data.write

    def slow(*values):
        reached.set()
        assert gate.wait(PATIENCE / 1000)
        write(*values)

    monkeypatch.setattr(session_data, "write", slow)
    own = window.features["session"].recovery
    own.begin()
    window.session.commands.pin(0, True)
    own.write()
    qtbot.waitUntil(reached.is_set)
    yield window
    gate.set()
    for one in running():
        one.join()


def test_another_mesh_is_opened_while_the_session_of_the_first_is_being_written(
    kept, gate, qtbot, windows, mesh_file, monkeypatch
):
    session, own = kept.session, kept.features["session"].recovery
    before = session.document.now
    with monkeypatch.context() as patch:
        patch.setattr(Task, "wait", lambda self: pytest.fail("the window waits for a thread"))
        session.document.mark_saved(mesh_file)
        open_and_wait(qtbot, kept, mesh_file)
    assert session.document.now.mesh is not before.mesh
    (folder,) = windows.iterdir()
    gate.set()
    qtbot.waitUntil(lambda: [one.name for one in folder.iterdir()] == ["lock"])
    session.commands.pin(1, True)
    with qtbot.waitSignal(own.written):
        own.write()
    kept_now = session_data.read(folder / f"{mesh_file.name}.hexmend")
    assert kept_now.document.now.mesh.pinned.tolist() == session.document.now.mesh.pinned.tolist()
    own.end()
    assert list(windows.iterdir()) == []


# Closing the window ends the program, even while threads are running.


PROGRAM = """
import sys
from PySide6.QtCore import QSettings, QTimer
for form in (QSettings.Format.NativeFormat, QSettings.Format.IniFormat):
    QSettings.setPath(form, QSettings.Scope.UserScope, sys.argv[2])
from hexmend_app.shell.start.program import application, open_window
from hexmend_app.shell.window import Window

def close():
    for window in application().topLevelWidgets():
        if isinstance(window, Window) and window.session is not None and window.session.opener.busy:
            timer.stop()
            {before}
            window.close()

application()
timer = QTimer(interval=100)
timer.timeout.connect(close)
timer.start()
sys.exit(open_window(sys.argv[1]))
"""


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes")
@pytest.mark.parametrize("before", ["pass", "window.session.opener.cancel()"], ids=["while it reads", "after Cancel"])
def test_the_process_ends_with_its_window_although_a_file_does_not_respond(qapp, tmp_path, before):
    os.mkfifo(tmp_path / "dead.vtk")
    program = PROGRAM.replace("{before}", before)
    ended = run_python("-c", program, tmp_path / "dead.vtk", tmp_path / "settings", timeout=100)
    assert ended.returncode == 0, ended.stderr
    assert "closed while threads were running: reading dead.vtk" in ended.stderr
