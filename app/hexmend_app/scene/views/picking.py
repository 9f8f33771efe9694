"""Picking: the hex under the pointer in a view."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkCellPicker

from hexmend.mesh.mesh import Mesh
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.coloured_polygons import hex_of
from hexmend_app.scene.layers.surface import Surface


@dataclass(frozen=True, eq=False)
class Hit:
    """Result of picking.

    Parameters
    ----------
    hex : int
    node : int
        Node of the hex that is nearest to the picked point.
    place : (3,) float64
        Picked point.
    node_place : (3,) float64
        Position of the node in the view that was picked in.
    """

    hex: int
    node: int
    place: np.ndarray
    node_place: np.ndarray


class Picker:
    """Finds the visible hex at a position.

    Parameters
    ----------
    pane : Pane
    surfaces : sequence of Surface
        Surfaces whose polygons can be picked.
    """

    def __init__(self, pane: Pane, surfaces: Sequence[Surface]):
        self._pane, self._surfaces = pane, surfaces
        self._picker = vtkCellPicker()
        self._picker.PickFromListOn()
        for surface in surfaces:
            self._picker.AddPickList(surface.actor)

    def pick(self, x: float, y: float, mesh: Mesh) -> Hit | None:
        """Pick at a position in pixels from the lower left corner; None outside the mesh."""
        for surface in self._surfaces:
            surface.actor.SetPickable(True)
        self._picker.Pick(x, y, 0, self._pane.renderer)
        for surface in self._surfaces:
            surface.actor.SetPickable(False)
        cell = self._picker.GetCellId()
        if cell < 0:
            return None
        h, place = hex_of(pv.wrap(self._picker.GetDataSet()), cell), np.array(self._picker.GetPickPosition())
        nodes = mesh.elements[h]
        squared_distances = np.square(mesh.points[nodes] - place).sum(axis=1)
        node = int(nodes[squared_distances.argmin()])
        return Hit(h, node, place, mesh.points[node])
