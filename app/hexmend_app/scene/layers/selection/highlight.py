"""Highlight of hexes: their edges, a value at each corner of a hex, and a node with an arrow."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend_app.scene.camera.fitting import pixels
from hexmend_app.scene.layers.flat_actor import flat_actor, label_actor
from hexmend_app.scene.layers.selection.hex_edges import HexEdges
from hexmend_app.scene.views.pane import Pane

_NODE, _ARROW = "#ffffff", "#ff8c00"

#: Minimum radius of a hex in pixels at which values are shown at its corners.
_MIN_RADIUS = 45


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
