"""What is pointed at in a view: the hex under the pointer, and the marks of what is chosen."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkCellPicker, vtkRenderer

from hexmend.node_step import NodeStep
from hexmend.quality import Node, corner_qualities
from hexmend_app.scene.layers.highlight import Highlight
from hexmend_app.scene.layers.node_step import NodeStepMarks
from hexmend_app.scene.layers.surface import Surface, hex_of
from hexmend_app.scene.pane import Pane


class Pointing:
    """Finds the hex that is seen at a place, and marks one hex and a node of it, or a node's step.

    Parameters
    ----------
    plotter : pyvista.BasePlotter or Pane
    surfaces : sequence of Surface
        On which hexes are found.
    """

    def __init__(self, plotter: pv.BasePlotter | Pane, surfaces: Sequence[Surface]):
        self._plotter, self._surfaces = plotter, surfaces
        self._highlight = Highlight(plotter)
        self._node_step = NodeStepMarks(plotter)
        self._selected: int | None = None
        self._with_corners = False
        self._picker = vtkCellPicker()
        self._picker.PickFromListOn()
        for surface in surfaces:
            self._picker.AddPickList(surface.actor)

    @property
    def layers(self) -> tuple[vtkRenderer, ...]:
        """What draws over the mesh."""
        return self._highlight.layer, *self._node_step.layers

    @property
    def node_step(self) -> NodeStep | None:
        """The node's step that is drawn."""
        return self._node_step.step

    def set_dark(self, dark: bool) -> None:
        """Take the colours of the dark theme, or of the light one."""
        self._node_step.set_dark(dark)

    def set_places(self, points: np.ndarray, hexes: np.ndarray) -> None:
        """Take where the nodes are, (n, 3) float64, and the hexes, (m, 8) int32; marks follow."""
        self._points, self._hexes = points, hexes
        self._show_selected()
        self._node_step.move(points)

    def pick(self, x: float, y: float) -> tuple[int, int] | None:
        """The hex seen at a place in pixels from the lower left corner, and its nearest node; None beside the mesh."""
        for surface in self._surfaces:
            surface.actor.SetPickable(True)
        self._picker.Pick(x, y, 0, self._plotter.renderer)
        for surface in self._surfaces:
            surface.actor.SetPickable(False)
        cell = self._picker.GetCellId()
        if cell < 0:
            return None
        h = hex_of(pv.wrap(self._picker.GetDataSet()), cell)
        nodes = self._hexes[h]
        away = np.square(self._points[nodes] - self._picker.GetPickPosition()).sum(axis=1)
        return h, int(nodes[away.argmin()])

    def select(self, h: int | None, corners: bool, node: Node | None) -> None:
        """Mark one hex, with the quality at each of its corners or without, and one of its nodes; None marks none."""
        self._selected, self._with_corners = h, corners
        self._show_selected()
        if h is not None:
            self._mark_node(node)

    def show_node_step(self, step: NodeStep | None) -> None:
        """Draw a node's step, in the place of the marks of the hex that is selected; None draws none."""
        if step is None:
            self._node_step.hide()
        else:
            self._node_step.show(step, self._hexes[step.hexes], self._points)
        self._show_selected()

    def _mark_node(self, node: Node | None) -> None:
        """Mark a node where it is now, and which way the energy around it falls, if it may go there."""
        if node is None:
            self._highlight.show_node(None)
            return
        steepness = float(np.linalg.norm(node.downhill))
        corners = self._points[self._hexes[self._selected]]
        length = np.sqrt(np.square(corners - corners.mean(axis=0)).sum(axis=1).max())
        goes = node.kind == "free" and steepness > 0
        self._highlight.show_node(node.point, node.downhill * (length / steepness) if goes else None)

    def _show_selected(self) -> None:
        if self._selected is None or self.node_step is not None:
            self._highlight.hide()
            return
        nodes = self._hexes[self._selected]
        values = corner_qualities(self._points, nodes[None])[0] if self._with_corners else None
        self._highlight.show(self._points[nodes], values)
