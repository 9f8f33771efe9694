"""From a window that stands empty to one with a mesh and all panels, without its ever standing still for long."""

from __future__ import annotations

import threading
from pathlib import Path

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from hexmend_app.shell.window import Window

#: Milliseconds that the panels wait for a picture: a large mesh is read for long.
_WAIT = 700

_OVER = object()


class Starting(QObject):
    """Has a window open a mesh and draw it, and furnished after that.

    What draws is imported in a thread: until the event loop turns, nothing would be seen of a window that another has
    covered, or that the desktop has just given its place. The panels come once the mesh is drawn, or is none, or is
    long in coming, step by step, between which the window does what it is asked to.

    Parameters
    ----------
    window : Window
        It is shown.
    mesh : Path
    """

    _loaded = Signal()

    def __init__(self, window: Window, mesh: Path):
        super().__init__(window)
        self._window, self._mesh = window, mesh
        self._error: Exception | None = None
        self._steps = window.furnishing()
        self._step = QTimer(self, interval=0)
        self._step.timeout.connect(self._furnish)
        self._wait = QTimer(self, interval=_WAIT, singleShot=True)
        self._wait.timeout.connect(self._step.start)
        self._loaded.connect(self._open, Qt.ConnectionType.QueuedConnection)
        threading.Thread(target=self._load, name="what draws").start()

    def _load(self) -> None:
        try:
            import hexmend_app.canvas.canvas
            import hexmend_app.state.session  # noqa: F401
            from hexmend_app.shell.features import FIRST, kind_of

            for name in FIRST:
                kind_of(name)
        except Exception as error:  # the window has to say it
            self._error = error
        finally:
            self._loaded.emit()

    def _open(self) -> None:
        window = self._window
        if not window.isVisible():
            return  # it has been closed
        if self._error is not None:
            raise self._error
        window.begin()
        window.features["open"].open(self._mesh)  # in a thread
        window.build_canvas()
        self._wait.start()
        window.canvas.interactor.frameSwapped.connect(self._on_frame)
        window.session.opener.failed.connect(self._on_failed)

    def _on_frame(self) -> None:
        if self._window.canvas.colouring is not None:
            self._go_on()

    def _on_failed(self) -> None:
        self._go_on()

    def _go_on(self) -> None:
        self._window.canvas.interactor.frameSwapped.disconnect(self._on_frame)
        self._window.session.opener.failed.disconnect(self._on_failed)
        self._wait.start(0)

    def _furnish(self) -> None:
        if not self._window.isVisible() or next(self._steps, _OVER) is _OVER:
            self._step.stop()
