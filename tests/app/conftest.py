"""Fixtures of all tests of the app: the application, mesh files, and windows with an open mesh."""

import gc
import threading
from contextlib import ExitStack, contextmanager
from functools import partialmethod
from pathlib import Path

import pyqtgraph as pg
import pytest
import shiboken6
from PySide6.QtCore import QEvent, QSettings
from PySide6.QtWidgets import QApplication, QMessageBox
from pytestqt.qtbot import QtBot

from hexmend import gallery, io
from hexmend_app.scene.render.graphics import prepare_off_screen
from hexmend_app.shell.start.program import application
from hexmend_app.shell.window import Window
from hexmend_app.state.tasks import task
from hexmend_app.state.tasks.task import running
from hexmend_app.theme.style import apply_style
from hexmend_app.widgets.dialogs import questions
from tests.app.driving import open_and_wait
from tests.app.hosting import PlainHost
from tests.app.resetting import SIZE, Resetting, lay_out, settle, unseen
from tests.guards import windows_close
from tests.patience import PATIENCE

#: On a busy machine threads end later than a window waits for when it closes.
task.GRACE = PATIENCE / 1000

#: The window that tests share; empty until it is created.
SHARED: list[Window] = []


@pytest.hookimpl(tryfirst=True)  # before pytest-qt processes events, which include drawing the last fine frame
def pytest_runtest_teardown():
    """Stop drawing the shared window after a test."""
    for window in SHARED:
        window.setUpdatesEnabled(False)


class PatientBot(QtBot):
    """Robot that waits for an event as long as a busy machine needs."""

    waitActive = partialmethod(QtBot.waitActive, timeout=PATIENCE)
    waitExposed = partialmethod(QtBot.waitExposed, timeout=PATIENCE)
    waitSignal = partialmethod(QtBot.waitSignal, timeout=PATIENCE)
    waitUntil = partialmethod(QtBot.waitUntil, timeout=PATIENCE)


@pytest.fixture
def gate():
    """Event that threads wait for; set at the end, so that a failing test leaves no thread."""
    gate = threading.Event()
    yield gate
    gate.set()


@pytest.fixture
def qtbot(qapp, request):
    """Return the robot of pytest-qt, which waits longer."""
    return PatientBot(request)


@pytest.fixture(scope="session")
def qapp(qapp):
    """Return the application with its style and garbage collection."""
    apply_style(qapp, dark=False)
    pg.setConfigOption("mouseRateLimit", 0)  # no mouse move is skipped
    return application()


@pytest.fixture(autouse=True)
def windows_are_closed(nothing_is_left_behind, request):
    """Fail a test that leaves a window on the screen."""
    if "qapp" not in request.fixturenames:
        yield
        return
    request.getfixturevalue("qapp")
    with windows_close(SHARED):
        yield


@pytest.fixture(autouse=True)
def off_screen_is_reset(monkeypatch):
    """Undo the preparation of off-screen drawing after a test, as windows need other OpenGL contexts."""
    monkeypatch.setenv("VTK_DEFAULT_OPENGL_WINDOW", "")
    monkeypatch.delenv("VTK_DEFAULT_OPENGL_WINDOW")
    yield
    prepare_off_screen.cache_clear()


@pytest.fixture
def shown(qtbot):
    """Return a function that shows a widget as a window with the keyboard focus."""

    def show(widget, width=360, height=0):
        qtbot.addWidget(widget)
        widget.resize(width, height or widget.sizeHint().height())
        with qtbot.waitActive(widget):
            widget.show()
            widget.activateWindow()
        return widget

    return show


@pytest.fixture
def hosted(qtbot):
    """Return a function that makes a host of features, and of a session, without a window."""
    with ExitStack() as sessions:

        def make(mesh, path=Path("a.vtu")):
            host = PlainHost(mesh, path)
            sessions.callback(lambda: host.session.close())
            return host

        yield make


@pytest.fixture(scope="session")
def mesh_file(tmp_path_factory):
    """File of a mesh with inverted hexes, which no test changes."""
    path = tmp_path_factory.mktemp("mesh") / "bridge.vtu"
    io.write(path, gallery.make("bridge-sharp", size=4000, scramble=0.4, seed=1))
    return path


@pytest.fixture
def bare_window(qtbot, tmp_path):
    """An empty window on the screen; the test builds its canvas."""
    with separate_settings(tmp_path / "settings"):
        window = empty_window(qtbot)
        yield window
        close(window)


@pytest.fixture
def fresh_window(qtbot, tmp_path, mesh_file, monkeypatch):
    """A new window with an open mesh."""
    with separate_settings(tmp_path / "settings"):
        window = window_with_mesh(qtbot, mesh_file)
        yield window
        close(window)


@pytest.fixture(scope="session")
def shared(qapp, tmp_path_factory, mesh_file):
    """Return a function that returns the shared window with its reset."""
    resetting = None

    def share(qtbot):
        nonlocal resetting
        if resetting is None:
            QSettings().clear()  # a previous window may have stored its layout
            SHARED.append(window_with_mesh(qtbot, mesh_file))
            resetting = Resetting(SHARED[0], tmp_path_factory.mktemp("session") / "initial.hexmend")
        return resetting

    def forget():
        nonlocal resetting
        resetting = None
        while SHARED:
            close(SHARED.pop())

    share.forget = forget

    with separate_settings(tmp_path_factory.mktemp("settings")):
        yield share
        for window in SHARED:
            close(window)


@pytest.fixture
def window(qtbot, shared):
    """The window that tests share, with an open mesh, in its initial state."""
    resetting = shared(qtbot)
    resetting.reset(qtbot)
    yield resetting.window
    if not resetting.window.isVisible():
        shared.forget()
        pytest.fail("a test that closes its window asks for fresh_window", pytrace=False)
    resetting.end()


@contextmanager
def separate_settings(settings):
    """Store settings in a separate folder, and answer questions without waiting."""
    for form in (QSettings.Format.NativeFormat, QSettings.Format.IniFormat):
        QSettings.setPath(form, QSettings.Scope.UserScope, str(settings))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(QMessageBox, "exec", lambda self: QMessageBox.StandardButton.Discard)
        patch.setattr(questions, "_DELAY", PATIENCE)  # no dialog while something is waited for
        yield


def empty_window(qtbot):
    """Show a new window without features."""
    application()
    window = Window()
    window.resize(*SIZE)
    with qtbot.waitExposed(window):
        window.show()
    return window


def window_with_mesh(qtbot, path):
    """Show a new window with an open mesh."""
    window = empty_window(qtbot)
    window.build_features()
    window.build_canvas()
    open_and_wait(qtbot, window, path)
    window.messages.clear()  # of what was opened
    with unseen(window):
        lay_out(window, window.docks.state())
        settle(qtbot, window)
    QApplication.processEvents()
    return window


def close(window):
    """Close and delete a window."""
    window.close()
    # PySide would mistake a later object at the same address for the QWindow.
    shiboken6.invalidate(window.windowHandle())
    window.deleteLater()  # frees 50 MB of Qt and Mesa
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    window.canvas.interactor.forget_context()  # likewise for the deleted surface
    del window
    gc.collect()  # collect the objects of VTK now, while nothing is drawn
    assert [one.name for one in running()] == []
