"""Arrows from previous to current positions of nodes."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from hexmend_app.picture.appearance import Arrows
from hexmend_app.picture.displacement import ROUNDING, Displacement
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.coloured_polygons import set_points
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.layers.flat_actor import flat_actor, offset_depth
from hexmend_app.scene.layers.mesh import MeshLayer
from hexmend_app.scene.layers.optional.structure import points_kept_by_cut
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

# Points of an arrow: start, neck, four corners of the head around the neck, tip.
_POINTS = 7
_SHAFT = np.array([[2, 0, 1]])
_FACES = np.array([[3, 6, 2, 3], [3, 6, 3, 4], [3, 6, 4, 5], [3, 6, 5, 2]])


class ArrowLayer:
    """Draws dark arrows with a light rim, which are visible on every colour.

    Attributes
    ----------
    drawn, moved : int
        Number of drawn arrows, and of nodes that have moved.
    lines : pv.PolyData
        Shafts; its points are those of `arrows`, seven per arrow.

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self._inside = pane.overlay()
        self.lines = pv.PolyData()
        self._front_actors = _actors(pane.renderer, pixel_ratio)
        self._inside_actors = _actors(self._inside, pixel_ratio)
        self._pixel_ratio = pixel_ratio
        self.drawn = self.moved = 0
        self._through = self._fast = False
        self.hide()

    @property
    def layer(self) -> vtkRenderer:
        """Renderer of the arrows inside the mesh."""
        return self._inside

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
            nodes[mesh.hexes if keep is None else mesh.hexes[keep]] = True
        else:
            nodes = mesh_layer.visible_nodes(mesh)
        self.show(frame.movement, nodes & points_kept_by_cut(frame.look, mesh.points), traces.factor, through)

    def hide(self) -> None:
        """Hide all arrows."""
        self.drawn = self.moved = 0
        self._inside.DrawOff()
        for actor in self._front_actors:
            actor.VisibilityOff()

    def show(self, movement: Displacement, nodes: np.ndarray, factor: float, through: bool) -> None:
        """Draw arrows of nodes, the longest if there are too many.

        Parameters
        ----------
        movement : Displacement
        nodes : (n,) bool
            Nodes that may have an arrow.
        factor : float
            Scale of the arrow lengths.
        through : bool
            Draw hidden arrows as opaque as visible ones.
        """
        distances = movement.distances
        chosen = np.flatnonzero(nodes & (distances > ROUNDING * movement.unit))
        moved = chosen.size
        if not moved:
            self.hide()
            return
        if moved > MAX_ARROWS:
            chosen = np.sort(chosen[np.argpartition(distances[chosen], moved - MAX_ARROWS)[moved - MAX_ARROWS :]])
        start = movement.before.points[chosen]
        vertices = arrows(start, factor * (movement.points[chosen] - start), _MAX_HEAD * movement.unit)
        if chosen.size == self.drawn:
            set_points(self.lines, vertices)
        else:
            self.lines, heads = _polys(vertices)
            for rim, shaft, head in (self._front_actors, self._inside_actors):
                rim.GetMapper().SetInputData(self.lines)
                shaft.GetMapper().SetInputData(self.lines)
                head.GetMapper().SetInputData(heads)
        self.drawn, self.moved = chosen.size, moved
        self._through = through
        self._update_style()

    def set_fast(self, fast: bool) -> None:
        """Omit rims and hidden arrows, which take two thirds of the time, or draw everything again."""
        self._fast = fast
        if self.drawn:
            self._update_style()

    def _update_style(self) -> None:
        through, fine = self._through, not self._fast
        rimmed = fine and self.drawn <= _MAX_RIMMED
        rim, shaft, head = self._front_actors
        for actor in (shaft, head):
            actor.SetVisibility(not through)
        rim.SetVisibility(not through and rimmed)
        self._inside.SetDraw(through or fine)
        for actor in self._inside_actors:
            actor.GetProperty().SetOpacity(1.0 if through else _HIDDEN_OPACITY)
        self._inside_actors[0].SetVisibility(through and rimmed)  # rims would cover pale arrows
        for _, shaft, head in (self._front_actors, self._inside_actors):
            shaft.GetProperty().SetLineWidth(self._pixel_ratio * (_SHAFT_WIDTH if fine else 1.0))
            head.GetProperty().SetEdgeVisibility(rimmed)


def arrows(start: np.ndarray, path: np.ndarray, longest: float) -> np.ndarray:
    """Return the points of arrows, (7 k, 3): start, neck, four corners of the head, tip of each.

    Parameters
    ----------
    start : (k, 3) float64
    path : (k, 3) float64
        Nonzero vectors from start to tip.
    longest : float
        Maximum length of a head.
    """
    length = np.sqrt(np.square(path).sum(axis=1))[:, None]
    forward = path / length
    sideways = np.cross(forward, np.eye(3)[np.abs(forward).argmin(axis=1)])
    sideways /= np.sqrt(np.square(sideways).sum(axis=1))[:, None]
    upwards = np.cross(forward, sideways)
    head = np.minimum(_HEAD * length, longest)
    tip = start + path
    neck = tip - head * forward
    half_width = _HALF_WIDTH * head
    corners = [
        neck + half_width * sideways,
        neck + half_width * upwards,
        neck - half_width * sideways,
        neck - half_width * upwards,
    ]
    return np.stack([start, neck, *corners, tip], axis=1).reshape(-1, 3)


def _polys(vertices: np.ndarray) -> tuple[pv.PolyData, pv.PolyData]:
    """Build shafts and heads, which share their points (7 k, 3)."""
    first = np.arange(0, len(vertices), _POINTS)[:, None, None]
    lines, faces = ((part[None] + first * (np.arange(part.shape[1]) > 0)).ravel() for part in (_SHAFT, _FACES))
    shafts, heads = pv.PolyData(vertices, lines=lines), pv.PolyData(vertices, faces=faces)
    heads.SetPoints(shafts.GetPoints())
    return shafts, heads


def _actors(renderer: vtkRenderer, pixel_ratio: float) -> tuple[vtkActor, vtkActor, vtkActor]:
    """Make the actors of rims, shafts, and heads."""
    styles = (_RIM, _RIM_WIDTH, -40.0), (_INK, _SHAFT_WIDTH, -80.0), (_INK, 1.0, -80.0)
    rim, shaft, head = (_actor(renderer, colour, pixel_ratio * width, depth) for colour, width, depth in styles)
    head.GetProperty().SetEdgeColor(rgb(_RIM))
    head.GetProperty().SetEdgeOpacity(0.6)
    return rim, shaft, head


def _actor(renderer: vtkRenderer, colour: str, width: float, depth: float) -> vtkActor:
    actor = flat_actor(renderer, width, colour=colour)
    offset_depth(actor.GetMapper(), lines=depth, polygons=depth, slope=-1.0)
    actor.VisibilityOn()
    return actor
