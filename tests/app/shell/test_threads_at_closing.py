"""Closing waits for all threads together, and removes the recovery folder of the window."""

from __future__ import annotations

import threading
from types import SimpleNamespace

import pytest

from hexmend_app.state.session import session_data
from hexmend_app.state.settings.paths import VARIABLE
from hexmend_app.state.tasks import task
from hexmend_app.state.tasks.task import GRACE, Task, running
from tests.app.driving import open_and_wait
from tests.patience import PATIENCE

pytestmark = pytest.mark.slow


@pytest.fixture
def gate():
    """Event that threads wait for; set at the end, so that a failing test leaves no thread."""
    gate = threading.Event()
    yield gate
    gate.set()


@pytest.fixture
def windows(tmp_path, monkeypatch):
    """The folder of the folders in which windows are kept safe from a crash."""
    monkeypatch.setenv(VARIABLE, str(tmp_path / "state"))
    return tmp_path / "state" / "windows"


@pytest.fixture
def kept(fresh_window, qtbot, gate, windows, monkeypatch):
    """A window whose session is being written beside it, until the gate is opened."""
    reached, write_new = threading.Event(), session_data.write_new

    def slow(*values):
        reached.set()
        assert gate.wait(PATIENCE / 1000)
        write_new(*values)

    monkeypatch.setattr(session_data, "write_new", slow)
    own = fresh_window.features["session"].recovery
    own.begin()
    fresh_window.session.commands.pin(0, True)
    own.write()
    qtbot.waitUntil(reached.is_set, timeout=PATIENCE)
    yield fresh_window
    gate.set()
    for one in running():
        one.join()


@pytest.fixture
def waits(kept):
    """Seconds for which the GUI's thread waits for threads; a clock of the test's own counts them, and nobody waits."""
    waits, ended = [], task.Task.join

    def join(self, seconds=None):
        if seconds is None:
            ended(self)  # its thread has told its end
        else:
            waits.append(seconds)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(task.Task, "join", join)
        patch.setattr(task, "time", SimpleNamespace(monotonic=lambda: sum(waits)))
        yield waits


def test_closing_waits_for_all_threads_together(kept, gate, waits, windows):
    session, tasks = kept.session, []
    parts = (session.saver, session.repairer, session.padder, session.structure_finder, session.boundary_classifier, session.node_step_task, session.mesh_checker,
             session.opener, kept.canvas.shading_task)  # fmt: skip
    for part in parts:
        tasks.append(Task(type(part).__name__, lambda _: gate.wait(PATIENCE / 1000)))
        part._task = tasks[-1]  # noqa: SLF001
        tasks[-1].start()
    kept.may_leave = lambda: True
    kept.close()
    assert not kept.isVisible()
    assert {one.name for one in tasks} < {one.name for one in running()}
    assert all(one.dropped for one in running())
    assert len(waits) > len(parts)
    assert sum(waits) <= GRACE
    assert list(windows.iterdir()) == []  # although the session is still being written


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
    qtbot.waitUntil(lambda: [one.name for one in folder.iterdir()] == ["lock"], timeout=PATIENCE)
    session.commands.pin(1, True)
    with qtbot.waitSignal(own.written, timeout=PATIENCE):
        own.write()
    kept_now = session_data.read(folder / "session.hexmend")
    assert kept_now.document.now.mesh.pinned.tolist() == session.document.now.mesh.pinned.tolist()
    own.end()
    assert list(windows.iterdir()) == []
