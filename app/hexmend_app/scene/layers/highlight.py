"""One element made to stand out: its edges over everything else, and a figure at each of its corners."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor, vtkBillboardTextActor3D, vtkPolyDataMapper, vtkRenderer

from hexmend.mesh.hexahedron import EDGES
from hexmend_app.scene.camera.fitting import pixels
from hexmend_app.scene.palette import rgb
from hexmend_app.scene.pane import Pane

_LINE, _HALO, _ARROW = "#ffffff", "#11151c", "#ff8c00"
_LINES = np.column_stack([np.full(12, 2), EDGES]).ravel()

#: Radius of a hex in pixels from which on there is room for figures at its corners.
_ROOM = 45


class Highlight:
    """Draws the edges of one hex, light on dark, so that they are seen on every colour, before everything else.

    Attributes
    ----------
    box : pyvista.PolyData
        The edges.

    Parameters
    ----------
    pane : Pane
    pen : float
        How many pixels wide a thin line is.
    """

    def __init__(self, pane: Pane, pen: float = 1.0):
        self._pen = pen
        self._layer = pane.overlay()
        self.box = pv.PolyData(np.zeros((8, 3)), lines=_LINES)
        self._actors = [self._lines(colour, width) for colour, width in ((_HALO, 5), (_LINE, 2))]
        self._texts = [self._text() for _ in range(8)]
        self._point = self._add(pv.PolyData(np.zeros((1, 3))), _LINE)
        self._point.GetProperty().SetPointSize(12 * pen)
        self._point.GetProperty().RenderPointsAsSpheresOn()
        self._arrow = self._add(pv.PolyData(), _ARROW)
        self._with_values = False
        self._layer.AddObserver("StartEvent", self._fit_texts)
        self.hide()

    @property
    def layer(self) -> vtkRenderer:
        """What draws before everything else."""
        return self._layer

    def _lines(self, colour: str, width: int) -> vtkActor:
        actor = self._add(self.box, colour)
        actor.GetProperty().SetLineWidth(self._pen * width)
        return actor

    def _add(self, poly: pv.PolyData, colour: str) -> vtkActor:
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(poly)
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(rgb(colour))
        actor.GetProperty().LightingOff()
        self._layer.AddActor(actor)
        return actor

    def _text(self) -> vtkBillboardTextActor3D:
        actor = vtkBillboardTextActor3D()
        actor.SetInput(" ")
        how = actor.GetTextProperty()
        how.SetFontSize(round(14 * self._pen))
        how.SetBold(True)
        how.SetColor(1, 1, 1)
        how.SetBackgroundColor(0.07, 0.08, 0.11)
        how.SetBackgroundOpacity(0.75)
        how.SetJustificationToCentered()
        how.SetVerticalJustificationToCentered()
        self._layer.AddActor(actor)
        return actor

    def show(self, corners: np.ndarray, values: np.ndarray | None = None) -> None:
        """Mark the hex with these corners.

        Parameters
        ----------
        corners : (8, 3) float64
        values : (8,) float64, optional
            Written beside the corners.
        """
        self.box.points = corners
        self._with_values = values is not None
        self._layer.DrawOn()
        outside = corners + 0.15 * (corners - corners.mean(axis=0))
        for k, text in enumerate(self._texts):
            if values is not None:
                text.SetInput(f"{values[k]:.2f}")
                text.SetPosition(*outside[k])

    def show_node(self, point: np.ndarray | None, arrow: np.ndarray | None = None) -> None:
        """Mark a node beside the hex, and an arrow (3,) from it, as long as it is to be drawn; None marks none."""
        self._point.SetVisibility(point is not None)
        self._arrow.SetVisibility(point is not None and arrow is not None)
        if point is not None:
            self._point.GetMapper().SetInputData(pv.PolyData(point[None]))
            if arrow is not None:
                drawn = pv.Arrow(
                    start=point, direction=arrow, tip_radius=0.09, shaft_radius=0.03, scale=float(np.linalg.norm(arrow))
                )
                self._arrow.GetMapper().SetInputData(drawn)

    def _fit_texts(self, *_: object) -> None:
        """Show the figures where the hex is large enough for them to stand apart."""
        on = self._with_values and self._pixels() > self._pen * _ROOM
        for text in self._texts:
            text.SetVisibility(on)

    def _pixels(self) -> float:
        """The radius of the hex in the picture."""
        corners = self.box.points
        centre = corners.mean(axis=0)
        return pixels(self._layer, np.sqrt(np.square(corners - centre).sum(axis=1).max()), centre)

    def hide(self) -> None:
        """Mark none."""
        self._layer.DrawOff()  # costs nothing then
