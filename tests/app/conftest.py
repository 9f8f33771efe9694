"""A window with a mesh open in it, for all tests of the app."""

from __future__ import annotations

import pytest
import shiboken6
from PySide6.QtCore import QEvent, QSettings
from PySide6.QtWidgets import QApplication, QMessageBox

from hexmend import gallery, io
from hexmend_app.shell.program import application
from hexmend_app.shell.window import Window
from hexmend_app.state.task import running
from hexmend_app.widgets.style import apply_style
from tests.app.driving import open_and_wait
from tests.guards import windows_close


def pytest_collection_modifyitems(items):
    """Themes first: another theme is put on all windows that there have been."""
    items.sort(key=lambda item: item.path.name != "test_theme.py")


#: Windows of tests that are over. Garbage, they would take along what VTK draws with at whatever moment Python collects
#: it, and crash there.
CLOSED: list[Window] = []


@pytest.fixture(scope="session")
def qapp(qapp):
    """The application in the program's own look."""
    apply_style(qapp, dark=False)
    return qapp


@pytest.fixture(autouse=True)
def windows_are_closed(nothing_is_left_behind, request):
    """A test that leaves a window on the screen fails."""
    if "qapp" not in request.fixturenames:
        yield
        return
    request.getfixturevalue("qapp")
    with windows_close():
        yield


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
def window(qtbot, tmp_path, mesh_file, monkeypatch):
    """A window with a mesh open in it."""
    QSettings.setPath(QSettings.Format.NativeFormat, QSettings.Scope.UserScope, str(tmp_path / "settings"))
    QSettings.setPath(QSettings.Format.IniFormat, QSettings.Scope.UserScope, str(tmp_path / "settings"))
    monkeypatch.setattr(QMessageBox, "exec", lambda self: QMessageBox.StandardButton.Discard)
    application()
    window = Window()
    window.resize(1400, 900)
    window.show()
    qtbot.waitExposed(window)
    window.furnish()
    window.build_canvas()
    open_and_wait(qtbot, window, mesh_file)
    window.windowHandle().requestActivate()
    qtbot.waitUntil(window.isActiveWindow, timeout=5000)  # or shortcuts go nowhere
    qtbot.wait(30)
    yield window
    window.close()
    CLOSED.append(window)
    # PySide would take what is made later at the same place in memory for the window's QWindow.
    shiboken6.invalidate(window.windowHandle())
    window.deleteLater()  # with 50 MB that Qt and Mesa have kept for it
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    window.canvas.interactor._forget_context()  # nor for the surface that was drawn on, which is gone too
    assert [task.name for task in running()] == []
