"""Highlight of hexes: their edges, a value at each corner of a hex, and a node with an arrow."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend_app.scene.camera.fitting import pixels
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.curved_edges import divided, segments
from hexmend_app.scene.layers.flat_actor import flat_actor, label_actor, offset_depth

_NODE, _ARROW = "#ffffff", "#ff8c00"

#: Minimum radius of a hex in pixels at which values are shown at its corners.
_MIN_RADIUS = 45


# Colour, width in pixels, opacity, and depth offset in VTK's units of lines. Pale lines are in front of everything, so
# that they are seen where the mesh hides the edges; the other lines are only just in front of the faces.
_LINE, _RIM = "#ffffff", "#11151c"
_STYLES = (
    (_RIM, 3.0, 0.5, -1e6), (_LINE, 1.5, 0.7, -1e6),
    (_RIM, 5.0, 1.0, -40.0), (_LINE, 2.0, 1.0, -40.0),
)  # fmt: skip


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
        self.renderer = pane.overlay()  # in front of everything else
        self.edges = HexEdges(pane.renderer, pixel_ratio)
        self._corners, self._values = np.zeros((8, 3)), np.empty(0)
        self._texts = [label_actor(self.renderer, round(14 * self._pixel_ratio)) for _ in range(8)]
        self._point, self._arrow = (flat_actor(self.renderer, colour=colour) for colour in (_NODE, _ARROW))
        self._point.GetProperty().SetPointSize(12 * pixel_ratio)
        self._point.GetProperty().RenderPointsAsSpheresOn()
        self.renderer.AddObserver("StartEvent", self._fit_texts)
        self.hide()

    def show(self, ends: np.ndarray, corners: np.ndarray, values: np.ndarray, middles: np.ndarray | None) -> None:
        """Highlight hexes.

        Parameters
        ----------
        ends : (e, 2, 3) float64
            Ends of their edges.
        corners : (c, 3) float64
            Corners of the first hex.
        values : (c,) float64
            Values shown at these corners; empty for none, NaN for no value.
        middles : (e, 3) float64, optional
            Mid-nodes of curved edges, see `HexEdges.show`.
        """
        self._corners = corners
        self.edges.show(ends, middles)
        self._values = values
        self.renderer.DrawOn()
        outside = corners + 0.15 * (corners - corners.mean(axis=0))
        for text, value, place in zip(self._texts, values, outside, strict=False):
            text.SetInput(f"{value:.2f}")
            text.SetPosition(*place)

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
        large = self._radius() > self._pixel_ratio * _MIN_RADIUS
        for k, text in enumerate(self._texts):
            text.SetVisibility(large and k < len(self._values) and not np.isnan(self._values[k]))

    def _radius(self) -> float:
        """Return the radius of the hex in pixels."""
        centre = self._corners.mean(axis=0)
        return pixels(self.renderer, np.sqrt(np.square(self._corners - centre).sum(axis=1).max()), centre)

    def hide(self) -> None:
        """Hide the highlight."""
        self.edges.hide()
        self.renderer.DrawOff()


class HexEdges:
    """Draws the edges of hexes in the renderer of the mesh, pale where the mesh hides them.

    All lines are drawn in the pass of translucent actors, after the mesh. They do not write depths, so that they cover
    each other in the order in which they are drawn: pale lines first, then visible edges over them. Opaque lines of two
    widths at the same place would instead compete for each pixel.

    Attributes
    ----------
    lines : pyvista.PolyData
        All edges; each edge has points of its own.

    Parameters
    ----------
    renderer : vtkRenderer
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, renderer: vtkRenderer, pixel_ratio: float = 1.0):
        self.lines = pv.PolyData()
        self._actors = []
        for colour, width, opacity, depth in _STYLES:
            actor = flat_actor(renderer, pixel_ratio * width, opacity, colour)
            actor.ForceTranslucentOn()
            offset_depth(actor.GetMapper(), lines=depth, slope=-2.0)
            self._actors.append(actor)

    def show(self, ends: np.ndarray, middles: np.ndarray | None = None) -> None:
        """Draw the edges of hexes.

        Parameters
        ----------
        ends : (e, 2, 3) float64
        middles : (e, 3) float64, optional
            Points halfway along the edges; None for straight edges.
        """
        points = ends if middles is None else divided(ends, middles)
        chains = np.arange(points.shape[0] * points.shape[1]).reshape(points.shape[:2])
        self.lines = pv.PolyData(points.reshape(-1, 3), lines=pv.CellArray.from_regular_cells(segments(chains)))
        for actor in self._actors:
            actor.GetMapper().SetInputData(self.lines)
            actor.SetVisibility(len(ends) > 0)

    def hide(self) -> None:
        """Draw no edges."""
        for actor in self._actors:
            actor.VisibilityOff()
