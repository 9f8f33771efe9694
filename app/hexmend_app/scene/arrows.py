"""Arrows from where nodes were to where they are."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

from hexmend_app.scene.surface import set_points
from hexmend_app.state.movement import NOTHING, Movement

#: Arrows that are drawn at most, the longest first: so many take 10 ms a frame without a graphics card.
MOST = 5_000

_INK, _RIM = "#11151c", "#ffffff"

#: Length of a head as a share of its arrow and in mean edge lengths at most, and its half width as a share of that.
_HEAD, _LONGEST, _WIDTH = 0.4, 0.35, 0.36

#: How strongly arrows are drawn where something hides them.
_HIDDEN = 0.3

# Of one arrow: start, neck, four corners of its head around the neck, tip.
_POINTS = 7
_SHAFT = np.array([[2, 0, 1]])
_FACES = np.array([[3, 6, 2, 3], [3, 6, 3, 4], [3, 6, 4, 5], [3, 6, 5, 2]])


class ArrowLayer:
    """Draws arrows in a plotter, dark with a light rim, so that they are seen on every colour.

    Attributes
    ----------
    drawn, moved : int
        Arrows, and nodes that could have one.

    Parameters
    ----------
    plotter : pyvista.BasePlotter
    """

    def __init__(self, plotter: pv.BasePlotter):
        # A layer of its own, in which nothing hides what is inside the mesh.
        self._inside = vtkRenderer()
        self._inside.SetLayer(1)
        self._inside.InteractiveOff()
        self._inside.SetActiveCamera(plotter.camera)
        window = plotter.render_window
        window.SetNumberOfLayers(max(2, window.GetNumberOfLayers()))
        window.AddRenderer(self._inside)
        self._poly = pv.PolyData()
        self._front_actors = _actors(plotter.renderer)
        self._inside_actors = _actors(self._inside)
        self.drawn = self.moved = 0
        self.hide()

    def hide(self) -> None:
        """Draw none."""
        self.drawn = self.moved = 0
        self._inside.DrawOff()
        for actor in self._front_actors:
            actor.VisibilityOff()

    def show(self, movement: Movement, nodes: np.ndarray, factor: float, through: bool) -> None:
        """Draw the longest of the arrows of some nodes.

        Parameters
        ----------
        movement : Movement
        nodes : (n,) bool
            Those that may have one.
        factor : float
            How many times as long as the way they are drawn.
        through : bool
            As strongly where something hides them.
        """
        distances = movement.distances
        chosen = np.flatnonzero(nodes & (distances > NOTHING * movement.unit))
        moved = chosen.size
        if not moved:
            self.hide()
            return
        if moved > MOST:
            chosen = np.sort(chosen[np.argpartition(distances[chosen], moved - MOST)[moved - MOST :]])
        start = movement.before.points[chosen]
        places = arrows(start, factor * (movement.points[chosen] - start), _LONGEST * movement.unit)
        if chosen.size == self.drawn:
            set_points(self._poly, places)
        else:
            self._poly = _poly(places)
            for actor in (*self._front_actors, *self._inside_actors):
                actor.GetMapper().SetInputData(self._poly)
        self.drawn, self.moved = chosen.size, moved
        self._inside.DrawOn()
        for actor in self._inside_actors:
            actor.GetProperty().SetOpacity(1.0 if through else _HIDDEN)
        self._inside_actors[0].SetVisibility(through)  # a rim around what is pale would hide it
        for actor in self._front_actors:
            actor.SetVisibility(not through)


def arrows(start: np.ndarray, way: np.ndarray, longest: float) -> np.ndarray:
    """Points of arrows, (7 k, 3): start, neck, four corners of the head, tip of each.

    Parameters
    ----------
    start, way : (k, 3) float64
        No way is 0.
    longest : float
        Heads are no longer than this.
    """
    length = np.sqrt(np.square(way).sum(axis=1))[:, None]
    ahead = way / length
    aside = np.cross(ahead, np.eye(3)[np.abs(ahead).argmin(axis=1)])
    aside /= np.sqrt(np.square(aside).sum(axis=1))[:, None]
    upwards = np.cross(ahead, aside)
    head = np.minimum(_HEAD * length, longest)
    tip = start + way
    neck = tip - head * ahead
    wide = _WIDTH * head
    corners = [neck + wide * aside, neck + wide * upwards, neck - wide * aside, neck - wide * upwards]
    return np.stack([start, neck, *corners, tip], axis=1).reshape(-1, 3)


def _poly(places: np.ndarray) -> pv.PolyData:
    first = np.arange(0, len(places), _POINTS)[:, None, None]
    lines, faces = ((part[None] + first * (np.arange(part.shape[1]) > 0)).ravel() for part in (_SHAFT, _FACES))
    return pv.PolyData(places, lines=lines, faces=faces)


def _actors(renderer: vtkRenderer) -> list[vtkActor]:
    """The rim and what it is around."""
    made = []
    for colour, width, before in ((_RIM, 4.0, -40.0), (_INK, 2.0, -80.0)):
        mapper = vtkPolyDataMapper()
        mapper.SetScalarVisibility(False)
        mapper.SetResolveCoincidentTopologyToPolygonOffset()
        mapper.SetRelativeCoincidentTopologyLineOffsetParameters(-1.0, before)
        mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(-1.0, before)
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.PickableOff()
        how = actor.GetProperty()
        how.SetColor(*pv.Color(colour).float_rgb)
        how.SetLineWidth(width)
        how.LightingOff()
        if colour == _RIM:
            how.EdgeVisibilityOn()
            how.SetEdgeColor(*pv.Color(_RIM).float_rgb)
        renderer.AddActor(actor)
        made.append(actor)
    return made
