"""Panels come after the picture."""

from __future__ import annotations

from PySide6.QtCore import QObject, QTimer

from hexmend_app.shell.window import Window

#: Milliseconds that the panels wait for a picture: a large mesh is read for long.
_WAIT = 700

_OVER = object()


class Furnisher(QObject):
    """Has a window furnished once its first mesh is drawn, or is none, or is long in coming.

    It goes step by step, between which the window does what it is asked to.

    Parameters
    ----------
    window : Window
        With its canvas.
    """

    def __init__(self, window: Window):
        super().__init__(window)
        self._window, self._steps = window, window.furnishing()
        self._step = QTimer(self, interval=0)
        self._step.timeout.connect(self._go_on)
        self._wait = QTimer(self, interval=_WAIT, singleShot=True)
        self._wait.timeout.connect(self._step.start)
        self._wait.start()
        window.canvas.interactor.frameSwapped.connect(self._on_frame)
        window.session.opener.failed.connect(self._on_failed)

    def _on_frame(self) -> None:
        if self._window.canvas.colouring is not None:
            self._begin()

    def _on_failed(self) -> None:
        self._begin()

    def _begin(self) -> None:
        self._window.canvas.interactor.frameSwapped.disconnect(self._on_frame)
        self._window.session.opener.failed.disconnect(self._on_failed)
        self._wait.start(0)

    def _go_on(self) -> None:
        if not self._window.isVisible() or next(self._steps, _OVER) is _OVER:
            self._step.stop()
