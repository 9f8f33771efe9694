"""Part of a render window with its renderer."""

from __future__ import annotations

from vtkmodules.vtkRenderingCore import vtkCamera, vtkLight, vtkRenderer, vtkRenderWindow

from hexmend_app.theme.palette import rgb

#: Position of the light in camera coordinates, above the viewer's left shoulder.
_LIGHT = (-0.3, 0.45, 1.0)


class Pane:
    """Renderer with a single light, see `hexmend_app.scene.layers.surface`.

    Attributes
    ----------
    window : vtkRenderWindow
    renderer : vtkRenderer
        Covers the whole window unless its viewport is set.

    Parameters
    ----------
    window : vtkRenderWindow
        Window with an interactor.
    camera : vtkCamera, optional
        Camera of another pane to share; None creates a camera.
    """

    def __init__(self, window: vtkRenderWindow, camera: vtkCamera | None = None):
        self.window = window
        self.renderer = vtkRenderer()
        self._background, self._fast = "#000000", False
        self._ends: tuple[str, str] | None = None
        self.renderer.DitherGradientOff()  # its steps are of one level, and noise makes screenshots twice as large
        self.renderer.UseOITOff()  # translucent actors are drawn in their order: see `HexEdges`
        self.renderer.SetActiveCamera(vtkCamera() if camera is None else camera)
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(_LIGHT)
        light.SetFocalPoint(0, 0, 0)
        self.renderer.AddLight(light)
        window.AddRenderer(self.renderer)

    @property
    def camera(self) -> vtkCamera:
        """Camera of the renderer."""
        return self.renderer.GetActiveCamera()

    def overlay(self) -> vtkRenderer:
        """Add a renderer in front of the others, with the same camera, and return it."""
        layer = vtkRenderer()
        layer.SetLayer(1)
        layer.InteractiveOff()
        layer.SetActiveCamera(self.camera)
        self.window.SetNumberOfLayers(max(2, self.window.GetNumberOfLayers()))
        self.window.AddRenderer(layer)
        return layer

    def set_background(self, colour: str, ends: tuple[str, str] | None = None) -> None:
        """Set the background colour, #rrggbb, and optionally the colours of its gradient in fine frames, from below."""
        self._background, self._ends = colour, ends
        self.set_fast(self._fast)

    def set_fast(self, fast: bool) -> None:
        """Draw the background uniformly, as a gradient takes a fifth of a fast frame in software rendering."""
        self._fast = fast
        gradient = self._ends is not None and not fast
        self.renderer.SetGradientBackground(gradient)
        self.renderer.SetBackground(rgb(self._ends[0] if gradient else self._background))
        if gradient:
            self.renderer.SetBackground2(rgb(self._ends[1]))
