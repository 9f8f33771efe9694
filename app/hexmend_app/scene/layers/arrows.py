"""Arrows from former to present positions of nodes."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

from hexmend.boundary.displacement import ROUNDING, Displacement
from hexmend_app.picture.appearance import Arrows
from hexmend_app.scene.layers.mesh import MeshLayer
from hexmend_app.scene.layers.optional.structure import uncut
from hexmend_app.scene.layers.surface import set_points
from hexmend_app.scene.views.frame import Frame
from hexmend_app.scene.views.pane import Pane
from hexmend_app.theme.palette import rgb

#: Largest number of arrows, the longest first: they cost 20 ms of a fast frame without a graphics card.
MOST = 5_000

#: Arrows up to which they have a rim: of more, that would be all that is seen.
_MANY = 1_000

_INK, _RIM = "#11151c", "#ffffff"

#: Length of a head as a share of its arrow and in mean edge lengths at most, and its half width as a share of that.
_HEAD, _LONGEST, _WIDTH = 0.4, 0.35, 0.36

#: Widths of the rim around a shaft, and of the shaft, in pixels.
_RIM_WIDTH, _SHAFT_WIDTH = 3.0, 1.75

#: How strongly arrows are drawn where something hides them.
_HIDDEN = 0.3

# Of one arrow: start, neck, four corners of its head around the neck, tip.
_POINTS = 7
_SHAFT = np.array([[2, 0, 1]])
_FACES = np.array([[3, 6, 2, 3], [3, 6, 3, 4], [3, 6, 4, 5], [3, 6, 5, 2]])


class ArrowLayer:
    """Draws arrows, dark with a light rim, so that they are visible on every colour.

    Attributes
    ----------
    drawn, moved : int
        Arrows, and nodes that could have one.
    lines : pv.PolyData
        Seven points of each arrow, where it begins first.

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
        """The renderer of arrows inside the mesh."""
        return self._inside

    def draw(self, frame: Frame, keep: np.ndarray | None, body: MeshLayer) -> None:
        """Draw the arrows that the look of a frame selects.

        Parameters
        ----------
        frame : Frame
        keep : (m,) bool, optional
            Hexes that are shown, in whole or in part; None for all.
        body : MeshLayer
            Knows which nodes are in sight.
        """
        mesh, traces = frame.mesh, frame.look.traces
        if traces.arrows is Arrows.NONE or frame.movement is None:
            self.hide()
            return
        through = traces.arrows is Arrows.ALL
        if through:
            nodes = np.zeros(mesh.n_nodes, bool)
            nodes[mesh.hexes if keep is None else mesh.hexes[keep]] = True
        else:
            nodes = body.nodes_in_sight(mesh)
        self.show(frame.movement, nodes & uncut(frame.look, mesh.points), traces.factor, through)

    def hide(self) -> None:
        """Draw nothing."""
        self.drawn = self.moved = 0
        self._inside.DrawOff()
        for actor in self._front_actors:
            actor.VisibilityOff()

    def show(self, movement: Displacement, nodes: np.ndarray, factor: float, through: bool) -> None:
        """Draw the longest of the arrows of some nodes.

        Parameters
        ----------
        movement : Displacement
        nodes : (n,) bool
            Nodes that may have an arrow.
        factor : float
            Factor of the length of arrows.
        through : bool
            As strongly where something hides them.
        """
        distances = movement.distances
        chosen = np.flatnonzero(nodes & (distances > ROUNDING * movement.unit))
        moved = chosen.size
        if not moved:
            self.hide()
            return
        if moved > MOST:
            chosen = np.sort(chosen[np.argpartition(distances[chosen], moved - MOST)[moved - MOST :]])
        start = movement.before.points[chosen]
        places = arrows(start, factor * (movement.points[chosen] - start), _LONGEST * movement.unit)
        if chosen.size == self.drawn:
            set_points(self.lines, places)
        else:
            self.lines, heads = _polys(places)
            for rim, shaft, head in (self._front_actors, self._inside_actors):
                rim.GetMapper().SetInputData(self.lines)
                shaft.GetMapper().SetInputData(self.lines)
                head.GetMapper().SetInputData(heads)
        self.drawn, self.moved = chosen.size, moved
        self._through = through
        self._fit()

    def set_fast(self, fast: bool) -> None:
        """Omit rims and pale arrows, which cost twice the rest, or draw everything again."""
        self._fast = fast
        if self.drawn:
            self._fit()

    def _fit(self) -> None:
        through, fine = self._through, not self._fast
        rimmed = fine and self.drawn <= _MANY
        rim, shaft, head = self._front_actors
        for actor in (shaft, head):
            actor.SetVisibility(not through)
        rim.SetVisibility(not through and rimmed)
        self._inside.SetDraw(through or fine)
        for actor in self._inside_actors:
            actor.GetProperty().SetOpacity(1.0 if through else _HIDDEN)
        self._inside_actors[0].SetVisibility(through and rimmed)  # around what is pale it would be all that is seen
        for _, shaft, head in (self._front_actors, self._inside_actors):
            shaft.GetProperty().SetLineWidth(self._pixel_ratio * (_SHAFT_WIDTH if fine else 1.0))
            head.GetProperty().SetEdgeVisibility(rimmed)


def arrows(start: np.ndarray, path: np.ndarray, longest: float) -> np.ndarray:
    """Return the points of arrows, (7 k, 3): start, neck, four corners of the head, tip of each.

    Parameters
    ----------
    start, way : (k, 3) float64
        No way is 0.
    longest : float
        Heads are no longer than this.
    """
    length = np.sqrt(np.square(path).sum(axis=1))[:, None]
    ahead = path / length
    aside = np.cross(ahead, np.eye(3)[np.abs(ahead).argmin(axis=1)])
    aside /= np.sqrt(np.square(aside).sum(axis=1))[:, None]
    upwards = np.cross(ahead, aside)
    head = np.minimum(_HEAD * length, longest)
    tip = start + path
    neck = tip - head * ahead
    wide = _WIDTH * head
    corners = [neck + wide * aside, neck + wide * upwards, neck - wide * aside, neck - wide * upwards]
    return np.stack([start, neck, *corners, tip], axis=1).reshape(-1, 3)


def _polys(places: np.ndarray) -> tuple[pv.PolyData, pv.PolyData]:
    """Build shafts and heads, which share their points."""
    first = np.arange(0, len(places), _POINTS)[:, None, None]
    lines, faces = ((part[None] + first * (np.arange(part.shape[1]) > 0)).ravel() for part in (_SHAFT, _FACES))
    shafts, heads = pv.PolyData(places, lines=lines), pv.PolyData(places, faces=faces)
    heads.SetPoints(shafts.GetPoints())
    return shafts, heads


def _actors(renderer: vtkRenderer, pixel_ratio: float) -> tuple[vtkActor, vtkActor, vtkActor]:
    """Make the actors of rims, shafts, and heads."""
    lines = (_RIM, _RIM_WIDTH, -40.0), (_INK, _SHAFT_WIDTH, -80.0), (_INK, 1.0, -80.0)
    rim, shaft, head = (_actor(renderer, colour, pixel_ratio * width, before) for colour, width, before in lines)
    head.GetProperty().SetEdgeColor(rgb(_RIM))
    head.GetProperty().SetEdgeOpacity(0.6)
    return rim, shaft, head


def _actor(renderer: vtkRenderer, colour: str, width: float, before: float) -> vtkActor:
    mapper = vtkPolyDataMapper()
    mapper.SetScalarVisibility(False)
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    mapper.SetRelativeCoincidentTopologyLineOffsetParameters(-1.0, before)
    mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(-1.0, before)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.PickableOff()
    prop = actor.GetProperty()
    prop.SetColor(rgb(colour))
    prop.SetLineWidth(width)
    prop.LightingOff()
    renderer.AddActor(actor)
    return actor
