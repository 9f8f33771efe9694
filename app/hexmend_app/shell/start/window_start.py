"""The start of the window: first the mesh, then the panels, without blocking for long."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, QTimer

from hexmend_app.shell.window import Window
from hexmend_app.state.tasks.task import Task

#: Milliseconds that the panels wait for the first picture: reading a large mesh takes longer.
_WAIT = 700

_OVER = object()


class Starting(QObject):
    """Opens a mesh in a window, and builds all features once it is drawn.

    The 3D modules are imported in a thread, so that the window is repainted meanwhile. The panels are built in steps of
    the event loop, once the mesh is drawn, has failed to open, or takes long.

    Parameters
    ----------
    window : Window
        It is shown.
    mesh : Path
    """

    def __init__(self, window: Window, mesh: Path):
        super().__init__(window)
        self._window, self._mesh = window, mesh
        self._steps = window.building_features()
        self._step = QTimer(self, interval=0)
        self._step.timeout.connect(self._build_features)
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
        if not self._window.isVisible() or next(self._steps, _OVER) is _OVER:
            self._step.stop()


def _load(task: Task) -> None:
    import hexmend_app.canvas.canvas
    import hexmend_app.state.session.session  # noqa: F401
    from hexmend_app.shell.features import first_names, kind_of

    for name in first_names():
        kind_of(name)
