"""Measured points, the lines between them, and their distances and angle, in front of the mesh."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend_app.picture.appearance import Measurement
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.layers.flat_actor import flat_actor, label_actor, offset_depth

_LINE, _RIM = "#ffffff", "#11151c"
#: Distance of the angle's text from its corner, as a fraction of the shorter line.
_FROM_CORNER = 0.25
_IN_FRONT = -66_000  # depth offset of the line from its rim


class MeasurementLayer:
    """Draws a measurement, light with a dark rim.

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self._layer, self._text_layer = pane.overlay(), pane.overlay()  # texts are in front of the lines
        self._poly = pv.PolyData()
        self._actors = []
        for colour, width, offset in ((_RIM, 5, 0), (_LINE, 2, _IN_FRONT)):
            actor = flat_actor(self._layer, width * pixel_ratio, colour=colour)
            actor.GetMapper().SetInputData(self._poly)
            actor.GetProperty().SetPointSize((width + 6) * pixel_ratio)
            offset_depth(actor.GetMapper(), lines=offset, points=offset)
            self._actors.append(actor)
        # Two distances and an angle.
        self._texts = [label_actor(self._text_layer, round(15 * pixel_ratio)) for _ in range(3)]
        self.hide()

    @property
    def layers(self) -> tuple[vtkRenderer, vtkRenderer]:
        """Renderers in front of the mesh."""
        return self._layer, self._text_layer

    @property
    def texts(self) -> list[str]:
        """The texts that are drawn."""
        return [text.GetInput() for text in self._texts if text.GetVisibility()]

    def draw(self, measurement: Measurement) -> None:
        """Draw a measurement; without points, nothing is drawn."""
        if not measurement.points:
            self.hide()
            return
        points = np.array(measurement.points)
        count = len(points)
        self._poly.points = points
        self._poly.verts = np.column_stack([np.ones(count, int), np.arange(count)]).ravel()
        segments = np.column_stack([np.full(count - 1, 2), np.arange(count - 1), np.arange(1, count)])
        self._poly.lines = segments.ravel()
        for actor in self._actors:
            actor.SetVisibility(True)
        labels = [
            (f"{length:.4g}", 0.5 * (start + end))
            for length, start, end in zip(measurement.distances, points[:-1], points[1:], strict=True)
        ]
        if measurement.angle is not None:
            arms = points[[0, 2]] - points[1]
            lengths = np.linalg.norm(arms, axis=1)
            middle = (arms / lengths[:, None]).sum(axis=0)
            labels.append((f"{measurement.angle:.1f}°", points[1] + _FROM_CORNER * lengths.min() * middle))
        for k, text in enumerate(self._texts):
            text.SetVisibility(k < len(labels))
            if k < len(labels):
                text.SetInput(labels[k][0])
                text.SetPosition(*labels[k][1])
        for layer in self.layers:
            layer.DrawOn()

    def hide(self) -> None:
        """Hide the measurement."""
        for prop in (*self._actors, *self._texts):
            prop.SetVisibility(False)
        for layer in self.layers:
            layer.DrawOff()
