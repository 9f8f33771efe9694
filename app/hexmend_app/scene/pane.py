"""A part of a window in which something is drawn for itself."""

from __future__ import annotations

from vtkmodules.vtkRenderingCore import vtkCamera, vtkLight, vtkRenderer, vtkRenderWindow

from hexmend_app.scene.palette import rgb

_LIGHT = (-0.12, 0.25, 1.0)  # from over the viewer's left shoulder


class Pane:
    """A renderer under one light: the five of a kit cost twice the frame.

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
        That of another pane, to be looked through here too.
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
        """What is looked through."""
        return self.renderer.GetActiveCamera()

    def overlay(self) -> vtkRenderer:
        """What draws over all that is here already, through the same camera, so that nothing of it hides anything."""
        layer = vtkRenderer()
        layer.SetLayer(1)
        layer.InteractiveOff()
        layer.SetActiveCamera(self.camera)
        self.window.SetNumberOfLayers(max(2, self.window.GetNumberOfLayers()))
        self.window.AddRenderer(layer)
        return layer

    def set_background(self, colour: str) -> None:
        """Take another ground."""
        self.renderer.SetBackground(rgb(colour))
