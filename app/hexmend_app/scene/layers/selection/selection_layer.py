"""Marks of the selection: a hex, one of its nodes and where it is invalid, or the step of a node."""

from __future__ import annotations

import numpy as np
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend.mesh.second_order.curved_geometry import hex_nodes
from hexmend.mesh.solid_cells import edges_of, has_node, kinds_of
from hexmend.quality.validity import Validity, certify
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.curved_elements import edge_mid_nodes, edge_middles
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.layers.selection.highlight import Highlight
from hexmend_app.scene.layers.selection.negative_jacobian import NegativeJacobian
from hexmend_app.scene.layers.selection.node_step import NodeStepMarks
from hexmend_app.state.mesh.inspection import NodeDetails, all_mid_nodes, node_qualities
from hexmend_app.state.node_step import NodeStep

_NONE = np.empty(0, dtype=np.int64)


class SelectionLayer:
    """Marks hexes and a node of a hex, or the step of a node; the marks move with the nodes.

    Where det J of a single hex is not positive is drawn in it.

    Attributes
    ----------
    hexes : (k,) int
        The marked hexes.
    highlight : Highlight
    negative : NegativeJacobian
        Region of a single marked hex, if it is invalid.

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self.negative = NegativeJacobian(pane, pixel_ratio)  # behind the node and the values of the highlight
        self.highlight = Highlight(pane, pixel_ratio)
        self._node_step = NodeStepMarks(pane, pixel_ratio)
        self.hexes = _NONE
        self._with_corners = False
        self._frame: Frame | None = None

    @property
    def hex(self) -> int | None:
        """The marked hex; None if there is none, or several."""
        return int(self.hexes[0]) if len(self.hexes) == 1 else None

    @property
    def layers(self) -> tuple[vtkRenderer, ...]:
        """Renderers in front of the mesh."""
        return *self.negative.layers, self.highlight.renderer, *self._node_step.layers

    @property
    def node_step(self) -> NodeStep | None:
        """The drawn step of a node; None if there is none."""
        return self._node_step.step

    def set_dark(self, dark: bool) -> None:
        """Use the colours of the dark or of the light theme."""
        self._node_step.set_dark(dark)
        self.negative.set_dark(dark)

    def draw(self, frame: Frame) -> None:
        """Draw the marks of the look of a frame; marks of another mesh are cleared, others move with the nodes."""
        last = self._frame
        if not frame.is_of(last):
            self.hide()
            last = None
        self._frame = frame
        marked = frame.look.show.marked
        if marked != (frozenset() if last is None else last.look.show.marked):
            self.hexes, self._with_corners = np.array(sorted(marked), dtype=np.int64), False
            self.highlight.show_node(None)
        self._show_hexes()
        self._node_step.move(frame.mesh.points)

    def hide(self) -> None:
        """Clear all marks; none are drawn until `draw` is called."""
        self._frame, self.hexes = None, _NONE
        self._node_step.hide()
        self.highlight.hide()
        self.highlight.show_node(None)
        self.negative.hide()

    def select(self, h: int | None, corners: bool, node: NodeDetails | None) -> None:
        """Mark a hex, optionally with the quality of its corners, and one of its nodes; None clears the marks."""
        if self._frame is None:
            return
        self.hexes, self._with_corners = _NONE if h is None else np.array([h]), corners
        self._show_hexes()
        if h is not None:
            self._mark_node(node)

    def show_node_step(self, step: NodeStep | None) -> None:
        """Draw the step of a node instead of the marks of the selected hex; None removes it."""
        if step is None or self._frame is None:
            self._node_step.hide()
        else:
            mesh = self._frame.mesh
            self._node_step.show(step, mesh.elements[step.hexes], mesh.points)
        self._show_hexes()

    def _mark_node(self, node: NodeDetails | None) -> None:
        """Mark a node and, if it is free, the direction of steepest descent of the energy of its patch."""
        if node is None:
            self.highlight.show_node(None)
            return
        steepness = float(np.linalg.norm(node.downhill))
        corners = self._frame.mesh.points[np.unique(self._frame.mesh.elements[self.hex])]
        length = np.sqrt(np.square(corners - corners.mean(axis=0)).sum(axis=1).max())
        moves = node.kind == "free" and steepness > 0
        self.highlight.show_node(node.point, node.downhill * (length / steepness) if moves else None)

    def _show_hexes(self) -> None:
        if not len(self.hexes) or self.node_step is not None:
            self.highlight.hide()
            self.negative.hide()
            return
        mesh = self._frame.mesh
        nodes, points = mesh.elements[self.hexes], mesh.points
        values = node_qualities(points, nodes[0]) if self._with_corners else np.empty(0)
        edges, middles = edges_of(nodes), None
        if self._frame.curved:
            middles = edge_middles(points, edges, edge_mid_nodes(nodes, all_mid_nodes(mesh)[self.hexes], edges))
        self.highlight.show(points[edges], points[nodes[0]][has_node(nodes)[0]], values, middles)
        self._show_negative()

    def _show_negative(self) -> None:
        """Draw where a single hex is invalid, by its own map: that of its mid-nodes, if it has some."""
        mesh, hexes = self._frame.mesh, self._frame.mesh.elements[self.hexes]
        mid_nodes = None if mesh.mid_nodes is None else all_mid_nodes(mesh)[self.hexes]
        if self.hex is None or kinds_of(hexes)[0] or certify(mesh.points, hexes, mid_nodes)[0] == Validity.VALID:
            self.negative.hide()
        elif mid_nodes is None or (mid_nodes < 0).all():
            self.negative.show(mesh.points[hexes[0]])
        else:
            self.negative.show(hex_nodes(mesh.points, hexes, mid_nodes)[0])
