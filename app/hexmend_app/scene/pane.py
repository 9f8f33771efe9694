"""A part of a window in which something is drawn for itself."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkRenderWindow


class Pane:
    """One of a plotter's renderers, with what drawing needs of a plotter.

    All panes of a plotter look through the camera of the first.

    Parameters
    ----------
    plotter : pyvista.BasePlotter
        With a row of renderers, one for each pane.
    at : int
        Which of them.
    """

    def __init__(self, plotter: pv.BasePlotter, at: int):
        self._plotter, self._at = plotter, at
        self.renderer: pv.Renderer = plotter.renderers[at]
        if at:
            self.renderer.camera = plotter.renderers[0].camera

    @property
    def camera(self) -> pv.Camera:
        """What is looked through."""
        return self.renderer.camera

    @property
    def render_window(self) -> vtkRenderWindow:
        """The window that this is a part of."""
        return self._plotter.render_window

    def add_mesh(self, mesh: pv.DataSet, **how: Any) -> pv.Actor:
        """Draw a mesh here, as `pyvista.Plotter.add_mesh` does."""
        return self._here(self._plotter.add_mesh, mesh, **how)

    def add_axes(self, **how: Any) -> pv.AxesActor:
        """Draw the axes in a corner, as `pyvista.Plotter.add_axes` does."""
        return self._here(self._plotter.add_axes, **how)

    def _here(self, act: Callable, *what: Any, **how: Any) -> Any:
        """Let the plotter do something here; by itself it does it in the first pane."""
        self._plotter.subplot(0, self._at)
        try:
            return act(*what, **how)
        finally:
            self._plotter.subplot(0, 0)

    def add_light(self, light: pv.Light) -> None:
        """Light what is here."""
        self.renderer.add_light(light)

    def remove_all_lights(self) -> None:
        """Leave it dark."""
        self.renderer.remove_all_lights()

    def set_background(self, colour: str) -> None:
        """Take another ground."""
        self.renderer.set_background(colour)
