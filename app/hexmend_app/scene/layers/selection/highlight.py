"""Highlight of hexes: their edges, a value at each corner of a hex, and a node with an arrow."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from hexmend.mesh.hexahedron import EDGES
from hexmend_app.scene.camera.fitting import pixels
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.curved_edges import DIVISIONS, divided, segments
from hexmend_app.scene.layers.flat_actor import flat_actor, label_actor, offset_depth

_NODE, _ARROW = "#ffffff", "#ff8c00"

#: Minimum radius of a hex in pixels at which values are shown at its corners.
_MIN_RADIUS = 45


_LINE, _RIM = "#ffffff", "#11151c"

# Line widths in pixels, and depth offsets in VTK's units. The dashes are in front of everything, so that they are drawn
# where the mesh hides them; the other lines are only just in front of the faces that they bound.
_DASHES = ((_RIM, 3.0, -1e6), (_LINE, 1.5, -1e6))

_FRONT = ((_RIM, 5.0, -40.0), (_LINE, 2.0, -40.0))

#: Length of a dash with its gap in pixels, its share that is drawn, and the largest number of dashes of an edge.
_PERIOD, _DRAWN, _MAX_DASHES = 9.0, 0.55, 400


class Highlight:
    """Draws the edges of hexes in the mesh, and values, node and arrow in front of everything else.

    Attributes
    ----------
    edges : HexEdges

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self._pixel_ratio = pixel_ratio
        self._layer = pane.overlay()
        self.edges = HexEdges(pane.renderer, pixel_ratio)
        self._corners = np.zeros((1, 8, 3))
        self._texts = [label_actor(self._layer, round(14 * self._pixel_ratio)) for _ in range(8)]
        self._point, self._arrow = (flat_actor(self._layer, colour=colour) for colour in (_NODE, _ARROW))
        self._point.GetProperty().SetPointSize(12 * pixel_ratio)
        self._point.GetProperty().RenderPointsAsSpheresOn()
        self._with_values = False
        self._layer.AddObserver("StartEvent", self._fit_texts)
        self.hide()

    @property
    def layer(self) -> vtkRenderer:
        """Renderer in front of everything else."""
        return self._layer

    def show(self, corners: np.ndarray, values: np.ndarray | None = None, middles: np.ndarray | None = None) -> None:
        """Highlight hexes with these corners.

        Parameters
        ----------
        corners : (k, 8, 3) float64
        values : (8,) float64, optional
            Values shown at the corners of the first hex.
        middles : (k, 12, 3) float64, optional
            Mid-nodes of curved edges, see `HexEdges.show`.
        """
        self._corners = corners
        self.edges.show(corners, middles)
        self._with_values = values is not None
        self._layer.DrawOn()
        outside = corners[0] + 0.15 * (corners[0] - corners[0].mean(axis=0))
        for k, text in enumerate(self._texts):
            if values is not None:
                text.SetInput(f"{values[k]:.2f}")
                text.SetPosition(*outside[k])

    def show_node(self, point: np.ndarray | None, arrow: np.ndarray | None = None) -> None:
        """Mark a node, (3,), with an optional arrow, (3,), from it; None removes the mark."""
        self._point.SetVisibility(point is not None)
        self._arrow.SetVisibility(point is not None and arrow is not None)
        if point is not None:
            self._point.GetMapper().SetInputData(pv.PolyData(point[None]))
            if arrow is not None:
                length = float(np.linalg.norm(arrow))
                solid = pv.Arrow(start=point, direction=arrow, tip_radius=0.09, shaft_radius=0.03, scale=length)
                self._arrow.GetMapper().SetInputData(solid)

    def _fit_texts(self, *_: object) -> None:
        """Show the values if the hex is large enough in the picture."""
        on = self._with_values and self._radius() > self._pixel_ratio * _MIN_RADIUS
        for text in self._texts:
            text.SetVisibility(on)

    def _radius(self) -> float:
        """Return the radius of the hex in pixels."""
        corners = self._corners[0]
        centre = corners.mean(axis=0)
        return pixels(self._layer, np.sqrt(np.square(corners - centre).sum(axis=1).max()), centre)

    def hide(self) -> None:
        """Hide the highlight."""
        self.edges.hide()
        self._layer.DrawOff()


class HexEdges:
    """Draws the edges of hexes in the renderer of the mesh.

    All lines are drawn in the pass of translucent actors, after the mesh. They do not write depths, so that they cover
    each other in the order in which they are drawn: dashes first, then visible edges over them. Opaque lines of two
    widths at the same place would instead compete for each pixel.

    Attributes
    ----------
    lines : pyvista.PolyData
        All edges; each hex has points of its own: its eight corners, or the points along its curved edges.
    dashes : pyvista.PolyData
        Dashes of all edges, fitted to the size of the edges in the picture.

    Parameters
    ----------
    renderer : vtkRenderer
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, renderer: vtkRenderer, pixel_ratio: float = 1.0):
        self._renderer, self._pixel_ratio = renderer, pixel_ratio
        self.lines, self.dashes = pv.PolyData(), pv.PolyData()
        self._middles: np.ndarray | None = None
        self._counts = np.empty(0, dtype=np.int64)  # of dashes, by edge
        self._dash_actors = [self._actor(*style) for style in _DASHES]
        self._front_actors = [self._actor(*style) for style in _FRONT]
        renderer.AddObserver("StartEvent", self._fit_dashes)

    def _actor(self, colour: str, width: float, depth: float) -> vtkActor:
        actor = flat_actor(self._renderer, self._pixel_ratio * width, colour=colour)
        actor.ForceTranslucentOn()
        offset_depth(actor.GetMapper(), lines=depth, slope=-2.0)
        return actor

    def show(self, corners: np.ndarray, middles: np.ndarray | None = None) -> None:
        """Draw the edges of hexes.

        Parameters
        ----------
        corners : (k, 8, 3) float64
        middles : (k, 12, 3) float64, optional
            Points halfway along the edges, in the order of `EDGES`; None for straight edges.
        """
        self._ends = corners[:, EDGES].reshape(-1, 2, 3)
        self._middles = None if middles is None else middles.reshape(-1, 3)
        if self._middles is None:
            ends = (EDGES[None] + 8 * np.arange(len(corners))[:, None, None]).reshape(-1, 2)
            self.lines = pv.PolyData(corners.reshape(-1, 3), lines=pv.CellArray.from_regular_cells(ends))  # type: ignore[arg-type]
        else:
            points = divided(self._ends, self._middles)
            chains = np.arange(len(points) * (DIVISIONS + 1)).reshape(len(points), -1)
            self.lines = pv.PolyData(points.reshape(-1, 3), lines=pv.CellArray.from_regular_cells(segments(chains)))
        self._counts = np.empty(0, dtype=np.int64)
        for actor in self._front_actors:
            actor.GetMapper().SetInputData(self.lines)
        self._set_visible(len(corners) > 0)

    def hide(self) -> None:
        """Draw no edges."""
        self._set_visible(False)

    @property
    def shown(self) -> bool:
        """True while edges are drawn."""
        return bool(self._front_actors[0].GetVisibility())

    def _set_visible(self, on: bool) -> None:
        for actor in (*self._dash_actors, *self._front_actors):
            actor.SetVisibility(on)

    def _fit_dashes(self, *_: object) -> None:
        """Divide the edges into dashes of the same length in the picture."""
        if not self.shown:
            return
        start, end = self._ends[:, 0], self._ends[:, 1]
        centre = self._ends.reshape(-1, 3).mean(axis=0)
        period = _PERIOD * self._pixel_ratio / max(pixels(self._renderer, 1.0, centre), 1e-300)
        length = np.sqrt(np.square(end - start).sum(axis=1))
        counts = np.clip(np.rint(length / period), 1, _MAX_DASHES).astype(np.int64)
        if np.array_equal(counts, self._counts):
            return
        self._counts = counts
        self.dashes = dashed(start, end, counts, self._middles)
        for actor in self._dash_actors:
            actor.GetMapper().SetInputData(self.dashes)


def dashed(start: np.ndarray, end: np.ndarray, counts: np.ndarray, middles: np.ndarray | None = None) -> pv.PolyData:
    """Build dashes along edges; each edge begins and ends with half a dash, so that its ends are visible.

    Parameters
    ----------
    start, end : (e, 3) float64
    counts : (e,) int64
        Number of periods of an edge, at least 1.
    middles : (e, 3) float64, optional
        Points halfway along curved edges.
    """
    edge = np.repeat(np.arange(len(counts)), counts + 1)
    first = np.cumsum(counts + 1) - (counts + 1)
    middle = (np.arange(len(edge)) - first[edge]) / counts[edge]
    half = _DRAWN / 2 / counts[edge]
    shares = np.clip(np.stack([middle - half, middle + half], axis=1), 0.0, 1.0)[..., None]
    points = start[edge][:, None] * (1 - shares) + end[edge][:, None] * shares
    if middles is not None:
        points += 4 * shares * (1 - shares) * (middles - (start + end) / 2)[edge][:, None]
    return pv.line_segments_from_points(points.reshape(-1, 3))
