"""A layer over the mesh, in which nothing hides what is inside it."""

from __future__ import annotations

import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend_app.scene.pane import Pane


def overlay(plotter: pv.BasePlotter | Pane) -> vtkRenderer:
    """A renderer with the plotter's camera that draws after, and so over, all that is there before it."""
    layer = vtkRenderer()
    layer.SetLayer(1)
    layer.InteractiveOff()
    layer.SetActiveCamera(plotter.camera)
    window = plotter.render_window
    window.SetNumberOfLayers(max(2, window.GetNumberOfLayers()))
    window.AddRenderer(layer)
    return layer
