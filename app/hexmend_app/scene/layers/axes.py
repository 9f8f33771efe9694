"""The axes in a corner of a view."""

from __future__ import annotations

import numpy as np
from vtkmodules.vtkInteractionWidgets import vtkOrientationMarkerWidget
from vtkmodules.vtkRenderingAnnotation import vtkAxesActor
from vtkmodules.vtkRenderingCore import vtkTextProperty

from hexmend_app.scene.views.pane import Pane
from hexmend_app.theme.palette import AXES, rgb

#: Where they are, x low, y low, x high, y high as shares of a window that is one view.
_PLACE = (0.0, 0.0, 0.13, 0.18)

#: Pixels of their height and width below which their letters lie over one another.
_LEAST = 80

#: Colours of X, Y and Z.
_COLOURS = {"X": "#ff6347", "Y": "#2e8b57", "Z": "#0000ff"}


class AxesLayer:
    """Draws X, Y and Z as the camera sees them.

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
        self.widget.SetViewport(*_PLACE)

    def _text(self, letter: str) -> vtkTextProperty:
        return getattr(self._actor, f"Get{letter}AxisCaptionActor2D")().GetCaptionTextProperty()

    def set_dark(self, dark: bool) -> None:
        """Colour the letters for the dark theme, or for the light one."""
        for letter in _COLOURS:
            self._text(letter).SetColor(rgb(AXES.of(dark)))

    def fit(self) -> None:
        """Keep the size of a single view, and the letters legible."""
        pixels = np.maximum(np.multiply(_PLACE[2:], self._pane.window.GetSize()), _LEAST)
        self.widget.SetViewport(0, 0, *np.minimum(pixels / np.maximum(self._pane.renderer.GetSize(), 1), 1))
