"""A window with a mesh open in it, for all tests of the app."""

from __future__ import annotations

import threading

import pytest
import shiboken6
from PySide6.QtCore import QEvent, QSettings
from PySide6.QtWidgets import QApplication, QMessageBox

from hexmend import gallery, io
from hexmend_app.program import application
from hexmend_app.window import Window
from tests.app.driving import open_and_wait


@pytest.fixture
def mesh_file(tmp_path):
    path = tmp_path / "bridge.vtu"
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
    window.build_canvas()
    open_and_wait(qtbot, window, mesh_file)
    window.windowHandle().requestActivate()
    qtbot.waitUntil(window.isActiveWindow, timeout=5000)  # or shortcuts go nowhere
    qtbot.wait(200)
    yield window
    window.close()
    # PySide would take what is made later at the same place in memory for the window's QWindow.
    shiboken6.invalidate(window.windowHandle())
    window.deleteLater()  # or every theme and style would be put on all windows of the tests before
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    assert [t.name for t in threading.enumerate() if t.name.startswith(("smoother", "reading"))] == []
