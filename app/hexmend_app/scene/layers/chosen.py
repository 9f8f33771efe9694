"""The marks of what is chosen in a view: a hex and a node of it, or a node's step."""

from __future__ import annotations

import numpy as np
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend.mesh.mesh import Mesh
from hexmend.node_step import NodeStep
from hexmend.quality import NodeDetails, corner_qualities
from hexmend_app.scene.layers.highlight import Highlight
from hexmend_app.scene.layers.node_step import NodeStepMarks
from hexmend_app.scene.pane import Pane


class Chosen:
    """Marks one hex and a node of it, or a node's step, wherever the nodes go.

    Attributes
    ----------
    hex : int or None
        The hex that is marked.
    highlight : Highlight

    Parameters
    ----------
    pane : Pane
    pen : float
        How many pixels wide a thin line is.
    """

    def __init__(self, pane: Pane, pen: float = 1.0):
        self.highlight = Highlight(pane, pen)
        self._node_step = NodeStepMarks(pane, pen)
        self.hex: int | None = None
        self._with_corners = False
        self._mesh: Mesh | None = None

    @property
    def layers(self) -> tuple[vtkRenderer, ...]:
        """What draws over the mesh."""
        return self.highlight.layer, *self._node_step.layers

    @property
    def node_step(self) -> NodeStep | None:
        """The node's step that is drawn."""
        return self._node_step.step

    def set_dark(self, dark: bool) -> None:
        """Take the colours of the dark theme, or of the light one."""
        self._node_step.set_dark(dark)

    def set_mesh(self, mesh: Mesh) -> None:
        """Mark nothing: another mesh is drawn."""
        self.hide()
        self._mesh = mesh

    def hide(self) -> None:
        """Mark nothing: no mesh is drawn until `set_mesh`."""
        self._mesh, self.hex = None, None
        self._node_step.hide()
        self.highlight.hide()
        self.highlight.show_node(None)

    def move(self, mesh: Mesh) -> None:
        """Follow the nodes of the same mesh to where they are now."""
        self._mesh = mesh
        self._show_hex()
        self._node_step.move(mesh.points)

    def select(self, h: int | None, corners: bool, node: NodeDetails | None) -> None:
        """Mark one hex, with the quality at each of its corners or without, and one of its nodes; None marks none."""
        if self._mesh is None:
            return
        self.hex, self._with_corners = h, corners
        self._show_hex()
        if h is not None:
            self._mark_node(node)

    def show_node_step(self, step: NodeStep | None) -> None:
        """Draw a node's step, in the place of the marks of the hex that is selected; None draws none."""
        if step is None or self._mesh is None:
            self._node_step.hide()
        else:
            self._node_step.show(step, self._mesh.hexes[step.hexes], self._mesh.points)
        self._show_hex()

    def _mark_node(self, node: NodeDetails | None) -> None:
        """Mark a node where it is now, and which way the energy around it falls, if it may go there."""
        if node is None:
            self.highlight.show_node(None)
            return
        steepness = float(np.linalg.norm(node.downhill))
        corners = self._mesh.points[self._mesh.hexes[self.hex]]
        length = np.sqrt(np.square(corners - corners.mean(axis=0)).sum(axis=1).max())
        goes = node.kind == "free" and steepness > 0
        self.highlight.show_node(node.point, node.downhill * (length / steepness) if goes else None)

    def _show_hex(self) -> None:
        if self.hex is None or self.node_step is not None:
            self.highlight.hide()
            return
        nodes, points = self._mesh.hexes[self.hex], self._mesh.points
        values = corner_qualities(points, nodes[None])[0] if self._with_corners else None
        self.highlight.show(points[nodes], values)
