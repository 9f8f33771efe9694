"""Orientation axes in a corner of a view."""

from __future__ import annotations

import numpy as np
from vtkmodules.vtkInteractionWidgets import vtkOrientationMarkerWidget
from vtkmodules.vtkRenderingAnnotation import vtkAxesActor
from vtkmodules.vtkRenderingCore import vtkTextProperty

from hexmend_app.scene.camera.pane import Pane
from hexmend_app.theme.palette import AXES, rgb

#: Position of the axes in a window with a single view: x low, y low, x high, y high as fractions of the window.
_VIEWPORT = (0.0, 0.0, 0.13, 0.18)

#: Minimum width and height in pixels, below which letters would overlap.
_MIN_SIZE = 80

#: Colours of X, Y and Z.
_COLOURS = {"X": "#ff6347", "Y": "#2e8b57", "Z": "#0000ff"}


class AxesLayer:
    """Draws the X, Y and Z axes in the orientation of the camera.

    Attributes
    ----------
    widget : vtkOrientationMarkerWidget

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self._pane = pane
        self._actor = vtkAxesActor()
        for letter, colour in _COLOURS.items():
            for part in ("Shaft", "Tip"):
                prop = getattr(self._actor, f"Get{letter}Axis{part}Property")()
                prop.SetColor(rgb(colour))
                prop.SetAmbient(0.5)
                prop.SetLineWidth(2 * pixel_ratio)
            self._text(letter).ShadowOff()
        self.widget = vtkOrientationMarkerWidget()
        self.widget.SetOrientationMarker(self._actor)
        self.widget.SetInteractor(pane.window.GetInteractor())
        self.widget.SetDefaultRenderer(pane.renderer)
        self.widget.EnabledOn()
        self.widget.InteractiveOff()
        self.widget.SetViewport(*_VIEWPORT)

    def _text(self, letter: str) -> vtkTextProperty:
        return getattr(self._actor, f"Get{letter}AxisCaptionActor2D")().GetCaptionTextProperty()

    def set_dark(self, dark: bool) -> None:
        """Use the letter colour of the dark or of the light theme."""
        for letter in _COLOURS:
            self._text(letter).SetColor(rgb(AXES.of(dark)))

    def fit(self) -> None:
        """Give the axes the size that they have in a single view."""
        pixels = np.maximum(np.multiply(_VIEWPORT[2:], self._pane.window.GetSize()), _MIN_SIZE)
        self.widget.SetViewport(0, 0, *np.minimum(pixels / np.maximum(self._pane.renderer.GetSize(), 1), 1))
