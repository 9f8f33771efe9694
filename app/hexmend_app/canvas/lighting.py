"""Light in fine frames, worked out beside the window: a frame is there first, its shades when they are known."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QObject, Signal

from hexmend_app.scene import occlusion
from hexmend_app.scene.cutting.polygons import Polygons
from hexmend_app.scene.layers.body import Body
from hexmend_app.scene.panes import Panes
from hexmend_app.state.task import Task, drop


class Lighting(QObject):
    """Works out what light reaches the views that are seen, one after another.

    Signals
    -------
    lit
        A view has its shades, and is to be drawn again.
    """

    lit = Signal()

    def __init__(self, panes: Panes, parent: QObject | None = None):
        super().__init__(parent)
        self._panes = panes
        self._task: Task | None = None

    @property
    def under_way(self) -> bool:
        """Whether something is being worked out."""
        return self._task is not None

    def start(self) -> None:
        """Work out what is not known of the fine frames that are drawn."""
        if self._task is not None:
            return
        for view in self._panes.seen:
            scene = view.body.unlit
            if scene is not None:
                self._begin(view.body, scene)
                return

    def _begin(self, body: Body, scene: Polygons) -> None:
        def work(task: Task) -> np.ndarray | None:
            return occlusion.light(scene, lambda: body.draws(scene) and not task.cancelled.is_set())

        self._lit = body, scene
        self._task = Task("light on the mesh", work, yields=True)
        self._task.ended.connect(self._finish)
        self._task.start()

    def _finish(self) -> None:
        task, self._task = self._task, None
        body, scene = self._lit
        if task.error is not None:
            raise task.error
        if task.result is not None and body.shine(scene, task.result):
            self.lit.emit()
        self.start()

    def shut_down(self) -> None:
        """Ask the thread to end; nothing more is shown."""
        drop(self._task)
        self._task = None
