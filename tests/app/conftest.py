"""A window with a mesh open in it, for all tests of the app."""

from __future__ import annotations

import gc
from contextlib import contextmanager

import pyqtgraph as pg
import pytest
import shiboken6
from PySide6.QtCore import QEvent, QSettings
from PySide6.QtWidgets import QApplication, QMessageBox

from hexmend import gallery, io
from hexmend_app.scene.render.graphics import prepare_off_screen
from hexmend_app.shell.start.program import application
from hexmend_app.shell.window import Window
from hexmend_app.state.tasks.task import running
from hexmend_app.theme.style import apply_style
from tests.app.driving import open_and_wait
from tests.app.resetting import SIZE, Resetting, lay_out, settle, unseen
from tests.guards import windows_close

#: The window that tests share, once there is one.
SHARED: list[Window] = []


@pytest.hookimpl(tryfirst=True)  # before pytest-qt has events handled, of which the last fine frame is one
def pytest_runtest_teardown():
    """Draw nothing of the shared window any more that nobody will look at."""
    for window in SHARED:
        window.setUpdatesEnabled(False)


@pytest.fixture(scope="session")
def qapp(qapp):
    """The application in the program's own look, with garbage collected as there."""
    apply_style(qapp, dark=False)
    pg.setConfigOption("mouseRateLimit", 0)  # no move is left out, however fast one follows another
    return application()


@pytest.fixture(autouse=True)
def windows_are_closed(nothing_is_left_behind, request):
    """A test that leaves a window on the screen fails."""
    if "qapp" not in request.fixturenames:
        yield
        return
    request.getfixturevalue("qapp")
    with windows_close(SHARED):
        yield


@pytest.fixture(autouse=True)
def drawn_as_before(monkeypatch):
    """What a command does to draw without a screen ends with its test: windows and their contexts are of another kind."""
    monkeypatch.setenv("VTK_DEFAULT_OPENGL_WINDOW", "")
    monkeypatch.delenv("VTK_DEFAULT_OPENGL_WINDOW")
    yield
    prepare_off_screen.cache_clear()


@pytest.fixture
def shown(qtbot):
    """Shows a widget in a window of its own that has the keyboard focus."""

    def show(widget, width=360, height=0):
        qtbot.addWidget(widget)
        widget.resize(width, height or widget.sizeHint().height())
        with qtbot.waitActive(widget):
            widget.show()
            widget.activateWindow()
        return widget

    return show


@pytest.fixture(scope="session")
def mesh_file(tmp_path_factory):
    """A tangled mesh, in a file that no test changes."""
    path = tmp_path_factory.mktemp("mesh") / "bridge.vtu"
    io.write(path, gallery.make("bridge-sharp", size=4000, scramble=0.4, seed=1))
    return path


@pytest.fixture
def bare_window(qtbot, tmp_path):
    """A window on the screen in which nothing is yet; the test gives it a canvas."""
    with kept_apart(tmp_path / "settings"):
        window = first_seen(qtbot)
        yield window
        close(window)


@pytest.fixture
def fresh_window(qtbot, tmp_path, mesh_file, monkeypatch):
    """A window of the test's own, with a mesh open in it."""
    with kept_apart(tmp_path / "settings"):
        window = made(qtbot, mesh_file)
        yield window
        close(window)


@pytest.fixture(scope="session")
def shared(qapp, tmp_path_factory, mesh_file):
    """The window that tests share, and what brings it back to how it was."""
    resetting = None

    def share(qtbot):
        nonlocal resetting
        if resetting is None:
            QSettings().clear()  # one before it may have kept how it was laid out
            SHARED.append(made(qtbot, mesh_file))
            resetting = Resetting(SHARED[0], mesh_file)
        return resetting

    def forget():
        nonlocal resetting
        resetting = None
        while SHARED:
            close(SHARED.pop())

    share.forget = forget

    with kept_apart(tmp_path_factory.mktemp("settings")):
        yield share
        for window in SHARED:
            close(window)


@pytest.fixture
def window(qtbot, shared):
    """The window that tests share, with a mesh open in it, as if it were new."""
    resetting = shared(qtbot)
    resetting.reset(qtbot)
    yield resetting.window
    if not resetting.window.isVisible():
        shared.forget()
        pytest.fail("a test that closes its window asks for fresh_window", pytrace=False)
    resetting.end()


@contextmanager
def kept_apart(settings):
    """Settings in a folder of their own, and no question that waits for an answer."""
    for form in (QSettings.Format.NativeFormat, QSettings.Format.IniFormat):
        QSettings.setPath(form, QSettings.Scope.UserScope, str(settings))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(QMessageBox, "exec", lambda self: QMessageBox.StandardButton.Discard)
        yield


def first_seen(qtbot):
    """A window as it is first seen."""
    application()
    window = Window()
    window.resize(*SIZE)
    window.show()
    qtbot.waitExposed(window)
    return window


def made(qtbot, path):
    """A window in which a mesh is open."""
    window = first_seen(qtbot)
    window.build_features()
    window.build_canvas()
    open_and_wait(qtbot, window, path)
    with unseen(window):
        lay_out(window, window.docks.state())
        settle(qtbot, window)
    QApplication.processEvents()
    return window


def close(window):
    """Close a window for good."""
    window.close()
    # PySide would take what is made later at the same place in memory for the window's QWindow.
    shiboken6.invalidate(window.windowHandle())
    window.deleteLater()  # with 50 MB that Qt and Mesa have kept for it
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    window.canvas.interactor.forget_context()  # nor for the surface that was drawn on, which is gone too
    del window
    gc.collect()  # the one before it, with what VTK drew with: here and now, where nothing is drawn
    assert [task.name for task in running()] == []
