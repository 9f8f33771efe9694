"""Arrows from previous to current positions of nodes."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from hexmend_app.picture.appearance import Arrows
from hexmend_app.picture.displacement import ROUNDING, Displacement
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.cutting.cut import remaining_points
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.layers.flat_actor import flat_actor, offset_depth
from hexmend_app.scene.layers.mesh import MeshLayer
from hexmend_app.theme.palette import rgb

#: Maximum number of arrows; the longest are drawn. They take 20 ms of a fast frame in software rendering.
MAX_ARROWS = 5_000

#: Maximum number of arrows with a rim; the rims of more arrows would cover everything else.
_MAX_RIMMED = 1_000

_INK, _RIM = "#11151c", "#ffffff"

#: Length of an arrowhead as a fraction of its arrow, its maximum length in mean edge lengths, and its half width as a
#: fraction of its length.
_HEAD, _MAX_HEAD, _HALF_WIDTH = 0.4, 0.35, 0.36

#: Line widths of the rim around a shaft and of the shaft, in pixels.
_RIM_WIDTH, _SHAFT_WIDTH = 3.0, 1.75

#: Opacity of arrows that are hidden by the mesh.
_HIDDEN_OPACITY = 0.3


class ArrowLayer:
    """Draws dark arrows with a light rim, which are visible on every colour.

    Attributes
    ----------
    drawn, moved : int
        Number of drawn arrows, and of nodes that have moved.
    shafts, heads : pv.PolyData

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self.renderer = pane.overlay()  # of the arrows inside the mesh
        self.shafts, self.heads = pv.PolyData(), pv.PolyData()
        self._front_actors = _actors(pane.renderer, pixel_ratio)
        self._inside_actors = _actors(self.renderer, pixel_ratio)
        self.drawn = self.moved = 0
        self.hide()

    def hide(self) -> None:
        """Hide all arrows."""
        self.drawn = self.moved = 0
        for actor in (*self._front_actors, *self._inside_actors):
            actor.VisibilityOff()

    def draw(self, frame: Frame, keep: np.ndarray | None, mesh_layer: MeshLayer) -> None:
        """Draw the arrows selected by the look of a frame.

        Parameters
        ----------
        frame : Frame
        keep : (m,) bool, optional
            True for hexes shown whole or in part; None for all.
        mesh_layer : MeshLayer
            Layer of the drawn hexes, which determines the visible nodes.
        """
        mesh, traces = frame.mesh, frame.look.movement
        if traces.arrows is Arrows.NONE or frame.movement is None:
            self.hide()
            return
        through = traces.arrows is Arrows.ALL
        if through:
            nodes = np.zeros(mesh.n_nodes, bool)
            nodes[mesh.elements if keep is None else mesh.elements[keep]] = True
        else:
            nodes = mesh_layer.visible_nodes(mesh)
        self._show(frame.movement, nodes & remaining_points(mesh.points, frame.look.cut), traces.factor, through)

    def _show(self, movement: Displacement, nodes: np.ndarray, factor: float, through: bool) -> None:
        """Draw arrows of nodes, (n,) bool, the longest if there are too many; `through` draws hidden ones opaque."""
        distances = movement.distances
        chosen = np.flatnonzero(nodes & (distances > ROUNDING * movement.unit))
        moved = chosen.size
        if not moved:
            self.hide()
            return
        if moved > MAX_ARROWS:
            chosen = np.sort(chosen[np.argpartition(distances[chosen], moved - MAX_ARROWS)[moved - MAX_ARROWS :]])
        start = movement.before.points[chosen]
        self.shafts, self.heads = arrows(start, factor * (movement.points[chosen] - start), _MAX_HEAD * movement.unit)
        self.drawn, self.moved = chosen.size, moved
        rimmed = self.drawn <= _MAX_RIMMED
        for actors, shown, opaque in (
            (self._front_actors, not through, True),
            (self._inside_actors, True, through),  # rims would cover pale arrows
        ):
            rim, shaft, head = actors
            for actor, data in ((rim, self.shafts), (shaft, self.shafts), (head, self.heads)):
                actor.GetMapper().SetInputData(data)
                actor.SetVisibility(shown)
                actor.GetProperty().SetOpacity(1.0 if opaque else _HIDDEN_OPACITY)
            rim.SetVisibility(shown and opaque and rimmed)
            head.GetProperty().SetEdgeVisibility(rimmed)


def arrows(start: np.ndarray, path: np.ndarray, longest: float) -> tuple[pv.PolyData, pv.PolyData]:
    """Build the shafts and the heads of arrows.

    Parameters
    ----------
    start : (k, 3) float64
    path : (k, 3) float64
        Nonzero vectors from start to tip.
    longest : float
        Maximum length of a head.
    """
    length = np.sqrt(np.square(path).sum(axis=1))
    heads = pv.PolyData(start + path)
    heads["length"], heads["path"] = np.minimum(_HEAD * length, longest), path
    necks = start + path * (1 - heads["length"] / length)[:, None]
    cone = pv.Cone(center=(-0.5, 0, 0), height=1.0, radius=_HALF_WIDTH, resolution=4, capping=False)
    shafts = pv.line_segments_from_points(np.stack([start, necks], axis=1).reshape(-1, 3))
    return shafts, heads.glyph(orient="path", scale="length", geom=cone)


def _actors(renderer: vtkRenderer, pixel_ratio: float) -> tuple[vtkActor, vtkActor, vtkActor]:
    """Make the actors of rims, shafts, and heads."""
    styles = (_RIM, _RIM_WIDTH, -40.0), (_INK, _SHAFT_WIDTH, -80.0), (_INK, 1.0, -80.0)
    rim, shaft, head = (flat_actor(renderer, pixel_ratio * width, colour=colour) for colour, width, _ in styles)
    for actor, (_, _, depth) in zip((rim, shaft, head), styles, strict=True):
        offset_depth(actor.GetMapper(), lines=depth, polygons=depth, slope=-1.0)
    head.GetProperty().SetEdgeColor(rgb(_RIM))
    head.GetProperty().SetEdgeOpacity(0.6)
    return rim, shaft, head
