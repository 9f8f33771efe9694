"""From a window that stands empty to one with a mesh and all panels, without its ever standing still for long."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, QTimer

from hexmend_app.shell.window import Window
from hexmend_app.state.task import Task

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

    def __init__(self, window: Window, mesh: Path):
        super().__init__(window)
        self._window, self._mesh = window, mesh
        self._steps = window.furnishing()
        self._step = QTimer(self, interval=0)
        self._step.timeout.connect(self._furnish)
        self._wait = QTimer(self, interval=_WAIT, singleShot=True)
        self._wait.timeout.connect(self._step.start)
        self._loading = Task("what draws", _load)
        self._loading.ended.connect(self._open)
        self._loading.start()

    def _open(self) -> None:
        window = self._window
        if not window.isVisible():
            return  # it has been closed
        if self._loading.error is not None:
            raise self._loading.error
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


def _load(task: Task) -> None:
    import hexmend_app.canvas.canvas
    import hexmend_app.state.session  # noqa: F401
    from hexmend_app.shell.features import FIRST, kind_of

    for name in FIRST:
        kind_of(name)
