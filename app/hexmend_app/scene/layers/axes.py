"""The axes in a corner of a view."""

from __future__ import annotations

import numpy as np
import pyvista as pv

from hexmend_app.scene.palette import AXES
from hexmend_app.scene.pane import Pane

#: Where they are, x low, y low, x high, y high as shares of a window that is one view.
_PLACE = (0.0, 0.0, 0.13, 0.18)

#: Pixels of their height and width below which their letters lie over one another.
_LEAST = 80


class Axes:
    """Draws X, Y and Z as the camera sees them.

    Parameters
    ----------
    plotter : pyvista.BasePlotter or Pane
    pen : float
        How many pixels wide a thin line is.
    """

    def __init__(self, plotter: pv.BasePlotter | Pane, pen: float = 1.0):
        self._plotter = plotter
        self._actor = plotter.add_axes(line_width=2 * pen, labels_off=False, viewport=_PLACE)

    def set_dark(self, dark: bool) -> None:
        """Write the letters for the dark theme's ground, or for the light one's."""
        for letter in "XYZ":
            label = getattr(self._actor, f"Get{letter}AxisCaptionActor2D")()
            label.GetCaptionTextProperty().SetColor(*pv.Color(AXES.of(dark)).float_rgb)

    def fit(self) -> None:
        """Draw them as large as in a window of one view, and so that they can be read."""
        renderer = self._plotter.renderer
        pixels = np.maximum(np.multiply(_PLACE[2:], self._plotter.render_window.GetSize()), _LEAST)
        renderer.axes_widget.SetViewport(0, 0, *np.minimum(pixels / np.maximum(renderer.GetSize(), 1), 1))
