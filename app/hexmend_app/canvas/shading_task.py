"""Shading of fine frames, computed in the background after the frame has been drawn."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QObject, Signal

from hexmend_app.scene.geometry import occlusion
from hexmend_app.scene.geometry.polygons import Polygons
from hexmend_app.scene.layers.mesh import MeshLayer
from hexmend_app.scene.views.panes import Panes
from hexmend_app.state.tasks.one_task import OneTask
from hexmend_app.state.tasks.task import Task


class ShadingTask(OneTask):
    """Computes the shading of the visible views in the background, one view at a time.

    Signals
    -------
    finished
        The shading of a view has been computed; the view must be drawn again.
    """

    finished = Signal()

    def __init__(self, panes: Panes, parent: QObject | None = None):
        super().__init__(parent)
        self._panes = panes

    def start(self) -> None:
        """Compute the missing shading of fine frames."""
        if self._task is not None:
            return
        for view in self._panes.visible:
            polygons = view.mesh_layer.needs_shading
            if polygons is not None:
                self._begin(view.mesh_layer, polygons)
                return

    def _begin(self, mesh_layer: MeshLayer, polygons: Polygons) -> None:
        def work(task: Task) -> np.ndarray | None:
            return occlusion.ambient_light(polygons, lambda: mesh_layer.draws(polygons) and not task.cancelled.is_set())

        self._target = mesh_layer, polygons
        self._start("shading of the mesh", work, yields=True)

    def _finish(self, task: Task) -> None:
        mesh_layer, polygons = self._target
        if task.error is not None:
            raise task.error
        if task.result is not None and mesh_layer.apply_shading(polygons, task.result):
            self.finished.emit()
        self.start()
