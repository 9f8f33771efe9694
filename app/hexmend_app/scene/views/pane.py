"""Part of a render window with a renderer of its content."""

from __future__ import annotations

from vtkmodules.vtkRenderingCore import vtkCamera, vtkLight, vtkRenderer, vtkRenderWindow

from hexmend_app.theme.palette import rgb

_LIGHT = (-0.12, 0.25, 1.0)  # from over the viewer's left shoulder


class Pane:
    """Renderer with one light: a light kit of five doubles the time of a frame.

    Attributes
    ----------
    window : vtkRenderWindow
    renderer : vtkRenderer
        All over the window until it is given another place.

    Parameters
    ----------
    window : vtkRenderWindow
        With an interactor.
    camera : vtkCamera, optional
        Camera of another pane, to be shared.
    """

    def __init__(self, window: vtkRenderWindow, camera: vtkCamera | None = None):
        self.window = window
        self.renderer = vtkRenderer()
        self.renderer.SetActiveCamera(vtkCamera() if camera is None else camera)
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(_LIGHT)
        light.SetFocalPoint(0, 0, 0)
        self.renderer.AddLight(light)
        window.AddRenderer(self.renderer)

    @property
    def camera(self) -> vtkCamera:
        """The camera."""
        return self.renderer.GetActiveCamera()

    def overlay(self) -> vtkRenderer:
        """Return a renderer over the existing ones, with the same camera; nothing hides its content."""
        layer = vtkRenderer()
        layer.SetLayer(1)
        layer.InteractiveOff()
        layer.SetActiveCamera(self.camera)
        self.window.SetNumberOfLayers(max(2, self.window.GetNumberOfLayers()))
        self.window.AddRenderer(layer)
        return layer

    def set_background(self, colour: str) -> None:
        """Set the background colour."""
        self.renderer.SetBackground(rgb(colour))
