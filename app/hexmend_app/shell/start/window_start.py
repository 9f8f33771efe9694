"""Start of the window: first the mesh is opened, then the panels are built, without blocking for long."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, QTimer

from hexmend_app.shell.window import Window
from hexmend_app.state.tasks.task import Task

#: Maximum time in milliseconds for which building the panels is delayed until the mesh is drawn.
_WAIT = 700

_EXHAUSTED = object()


class WindowStart(QObject):
    """Opening of a mesh in a new window, followed by building all features.

    The 3D modules are imported in a thread, so that the window is repainted meanwhile. The panels are built in turns of
    the event loop, once the mesh is drawn, has failed to open, or takes too long.

    Parameters
    ----------
    window : Window
        Visible window.
    mesh : Path
    """

    def __init__(self, window: Window, mesh: Path):
        super().__init__(window)
        self._window, self._mesh = window, mesh
        self._steps = window.build_steps()
        self._step = QTimer(self, interval=0)
        self._step.timeout.connect(self._build_features)
        self._wait = QTimer(self, interval=_WAIT, singleShot=True)
        self._wait.timeout.connect(self._step.start)
        self._loading = Task("3D modules", _load)
        self._loading.ended.connect(self._open)
        self._loading.start()

    def _open(self) -> None:
        window = self._window
        if not window.isVisible():
            return  # closed meanwhile
        if self._loading.error is not None:
            raise self._loading.error
        window.begin()
        window.session.commands.open(self._mesh)  # in a thread
        window.build_canvas()
        self._wait.start()
        window.canvas.interactor.frameSwapped.connect(self._on_frame)
        window.session.opener.failed.connect(self._on_failed)

    def _on_frame(self) -> None:
        if self._window.canvas.colouring is not None:
            self._continue()

    def _on_failed(self) -> None:
        self._continue()

    def _continue(self) -> None:
        self._window.canvas.interactor.frameSwapped.disconnect(self._on_frame)
        self._window.session.opener.failed.disconnect(self._on_failed)
        self._wait.start(0)

    def _build_features(self) -> None:
        if not self._window.isVisible() or next(self._steps, _EXHAUSTED) is _EXHAUSTED:
            self._step.stop()


def _load(task: Task) -> None:
    """Import the 3D modules and the features that draw a mesh."""
    import hexmend_app.canvas.canvas
    import hexmend_app.state.session.session  # noqa: F401
    from hexmend_app.shell.features import FIRST, feature_class

    for name in FIRST:
        feature_class(name)
