"""Off-screen render window."""

from __future__ import annotations

import numpy as np
import vtkmodules.vtkRenderingFreeType
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  both register VTK's implementations
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkWindowToImageFilter
from vtkmodules.vtkRenderingUI import vtkGenericRenderWindowInteractor

from hexmend.signal_guard import uninterrupted


class Stage:
    """Off-screen render window, to be closed or used as a context manager.

    Attributes
    ----------
    window : vtkRenderWindow
        Window for `hexmend_app.scene.camera.pane.Pane`.

    Parameters
    ----------
    size : (width, height)
        Size in pixels.
    """

    def __init__(self, size: tuple[int, int]):
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SetSize(*size)
        vtkGenericRenderWindowInteractor().SetRenderWindow(self.window)  # VTK widgets require an interactor

    def __enter__(self) -> Stage:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @uninterrupted  # VTK terminates the process if a callback raises KeyboardInterrupt
    def picture(self, transparent: bool = False) -> np.ndarray:
        """Render and return the pixels, (height, width, 3) uint8, or (height, width, 4) if `transparent`."""
        self.window.Render()
        grabber = vtkWindowToImageFilter()
        grabber.SetInput(self.window)
        grabber.ShouldRerenderOff()
        grabber.ReadFrontBufferOn()  # antialiased, as on the screen
        (grabber.SetInputBufferTypeToRGBA if transparent else grabber.SetInputBufferTypeToRGB)()
        grabber.Update()
        image = grabber.GetOutput()
        width, height, _ = image.GetDimensions()
        rows = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)
        return np.ascontiguousarray(rows[::-1])

    def close(self) -> None:
        """Release graphics resources."""
        self.window.Finalize()
        self.window.SetInteractor(None)
