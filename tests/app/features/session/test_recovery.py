"""Recovery of the session of a window that ended unexpectedly."""

import hashlib
import json
import os
import shutil
import signal
import subprocess
import sys

import pytest

from hexmend import METHODS, HexmendError, StoppingCriteria
from hexmend_app.state.session import recovery as recovery_module
from hexmend_app.state.session import session_data
from hexmend_app.state.session.recovery import VARIABLE
from tests.app.driving import button, open_and_wait, press, smooth
from tests.programs import run_python

#: A window that smooths a mesh, tells what it has come to once that is kept, and never ends by itself.
_PROGRAM = """
import hashlib, json, sys
from pathlib import Path
from hexmend.run.recipe import Stage
from hexmend.errors import HexmendError
from hexmend.run import StoppingCriteria
from hexmend.smoothers import METHODS
from hexmend_app.shell.start.program import application
from hexmend_app.shell.window import Window

app = application()
window = Window()
window.show()
window.build_features()
window.build_canvas()
session, feature = window.session, window.features["session"]

def smooth(_):
    session.view.change(show={"peel": 1})
    session.commands.run(Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=5)))

def tell():
    now = session.document.now
    digest = hashlib.sha256(now.mesh.points.tobytes()).hexdigest()
    print(json.dumps({"points": digest, "rows": session.history.records[0].rows}), flush=True)

session.opener.ended.connect(smooth)
feature.recovery.written.connect(tell)
feature.program_started()
window.features["open"].open(Path(sys.argv[1]))
app.exec()
"""


@pytest.fixture(autouse=True)
def own_state(tmp_path, monkeypatch):
    """Use a temporary folder for autosaved sessions; return it."""
    monkeypatch.setenv(VARIABLE, str(tmp_path / "state"))
    return tmp_path / "state" / "windows"


@pytest.fixture(scope="module")
def left(tmp_path_factory, mesh_file, qapp):
    """Kill the process of a window during its work; return its state, and the points and rows that it had printed."""
    folder = tmp_path_factory.mktemp("killed")
    state = {"PYTHONPATH": os.pathsep.join(sys.path), "XDG_CONFIG_HOME": str(folder / "config"), VARIABLE: str(folder)}
    command = [sys.executable, "-c", _PROGRAM, str(mesh_file)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=os.environ | state) as process:
        told = process.stdout.readline()
        process.send_signal(signal.SIGKILL)
    return folder / "windows", json.loads(told)


@pytest.fixture
def killed(left, own_state):
    """What a killed window had printed; what it left is in the state of this test."""
    windows, told = left
    shutil.copytree(windows, own_state)
    return told


def offered(window):
    window.refresh()
    return [text for _, text, _ in window.messages.messages() if "can be recovered" in text]


@pytest.mark.slow
def test_a_killed_window_is_recovered(killed, fresh_window, qtbot, mesh_file, own_state):
    window, session = fresh_window, fresh_window.session
    window.features["session"].program_started()
    assert offered(window) == [f"{mesh_file.name} can be recovered"]
    with qtbot.waitSignal(window.features["session"].recovery.written):
        press(button(window.messages, "Recover"))
    window.refresh()
    assert hashlib.sha256(session.document.now.mesh.points.tobytes()).hexdigest() == killed["points"]
    assert session.history.records[0].rows == killed["rows"]
    assert session.view.look.show.peel == 1
    assert session.document.path == mesh_file
    assert session.document.modified
    assert session.document.undo_title == METHODS["laplacian"].title
    (own,) = own_state.iterdir()  # what was left is this window's now
    assert (own / f"{mesh_file.name}.hexmend").exists()
    assert not window.features["session"].recovery.recoverable


@pytest.mark.slow
def test_recovery_is_offered_until_discarded(killed, fresh_window, own_state):
    feature = fresh_window.features["session"]
    feature.program_started()
    assert offered(fresh_window)
    fresh_window.messages.dismiss()
    assert not offered(fresh_window)  # not today
    feature.close()
    assert len(list(own_state.iterdir())) == 1
    feature.program_started()
    fresh_window.action("recover").trigger()
    assert offered(fresh_window)
    press(button(fresh_window.messages, "Discard"))
    feature.close()
    assert list(own_state.iterdir()) == []


@pytest.mark.slow
def test_a_run_is_recovered_at_its_newest_iteration(window, qtbot, own_state, tmp_path, monkeypatch):
    monkeypatch.setattr(recovery_module, "RUN_PERIOD", 10)
    session, recovery = window.session, window.features["session"].recovery
    recovery.begin()
    session.run.start(METHODS["laplacian"](), StoppingCriteria(max_iterations=10), iterations=3)
    wait_for_run(own_state, qtbot, lambda record: record.result == 3)
    (written,) = own_state.glob("*/*.hexmend")
    left = shutil.copy(written, tmp_path / "left.hexmend")
    points = session.run.newest.iteration.points
    with qtbot.waitSignal(session.run.ended):
        session.run.resume()
    wait_for_run(
        own_state, qtbot, lambda record: len(record.rows) == 11 and record.message == session.run.record.message
    )
    recovery.end()
    with qtbot.waitSignal(session.opener.ended):
        session.opener.open(left, recovers=True)
    assert (session.document.now.mesh.points == points).all()
    assert session.document.modified
    assert session.document.undo_title == METHODS["laplacian"].title
    assert session.history.records[0].message == "cut short"


def wait_for_run(own_state, qtbot, is_written):
    """Wait until the session on the disk has a run of which a function is true."""

    def found():
        try:
            (path,) = own_state.glob("*/*.hexmend")
            return is_written(session_data.read(path).history.records[0])
        except (ValueError, HexmendError):  # not written yet, or being written
            return False

    qtbot.waitUntil(found)


@pytest.mark.slow
def test_a_closed_window_leaves_no_files(window, qtbot, own_state, mesh_file):
    recovery = window.features["session"].recovery
    recovery.begin()
    recovery.write()
    (own,) = own_state.iterdir()
    assert not list(own.glob("*.hexmend"))  # there is nothing to lose yet
    with qtbot.waitSignal(recovery.written):
        smooth(qtbot, window.session)
    assert sorted(one.name for one in own.iterdir()) == [f"{mesh_file.name}.hexmend", "lock"]
    open_and_wait(qtbot, window, mesh_file)
    assert not list(own.glob("*.hexmend"))  # it was of work that was given up
    recovery.end()
    assert list(own_state.iterdir()) == []


@pytest.mark.slow
def test_a_change_is_saved_again(window, qtbot, own_state):
    session, recovery = window.session, window.features["session"].recovery
    recovery.begin()
    with qtbot.waitSignal(recovery.written):
        smooth(qtbot, window.session)
    session.view.change(show={"peel": 1})
    with qtbot.waitSignal(recovery.written):
        recovery.write()
    (path,) = own_state.glob("*/*.hexmend")
    kept = session_data.read(path)
    assert kept.view.look.show.peel == 1
    assert len(kept.history.records) == 1
    recovery.end()


@pytest.mark.slow
def test_an_open_window_is_not_recovered(window, qtbot, own_state):
    recovery = window.features["session"].recovery
    recovery.begin()
    with qtbot.waitSignal(recovery.written):
        smooth(qtbot, window.session)
    program = (
        "from PySide6.QtCore import QCoreApplication\n"
        "from hexmend_app.state.session.recovery import Recovery\n"
        "from hexmend_app.state.session.session import Session\n"
        "app = QCoreApplication([])\n"
        "recovery = Recovery(Session())\n"
        "recovery.begin()\n"
        "print(len(recovery.recoverable))\n"
        "recovery.end()\n"
    )
    done = run_python("-c", program, paths=sys.path, check=True)
    assert done.stdout == "0\n"
    assert len(list(own_state.iterdir())) == 1
    recovery.end()


@pytest.mark.slow
def test_a_failed_write_is_repeated(window, qtbot, own_state, monkeypatch):
    write, failures = session_data.write, []

    def fail_once(*arguments):
        if not failures:
            failures.append(OSError("the disk is full"))
            raise failures[0]
        write(*arguments)

    monkeypatch.setattr(session_data, "write", fail_once)
    smooth(qtbot, window.session)
    recovery = window.features["session"].recovery
    recovery.begin()
    with qtbot.waitSignal(recovery.failed):
        recovery.write()

    def is_written():
        recovery.write()  # as the timer does; nothing has changed since the failure
        return any(own_state.glob("*/*.hexmend"))

    qtbot.waitUntil(is_written)
    recovery.end()
