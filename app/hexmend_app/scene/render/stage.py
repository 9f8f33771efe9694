"""Off-screen render window."""

from __future__ import annotations

import numpy as np
import vtkmodules.vtkRenderingFreeType
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  both bring what VTK draws with
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkWindowToImageFilter
from vtkmodules.vtkRenderingUI import vtkGenericRenderWindowInteractor

from hexmend.signal_guard import uninterrupted


class Stage:
    """Off-screen window; close it, for example by `with`.

    Attributes
    ----------
    window : vtkRenderWindow
        For `hexmend_app.scene.views.pane.Pane`, one or several.

    Parameters
    ----------
    size : (width, height)
        In pixels.
    """

    def __init__(self, size: tuple[int, int]):
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SetSize(*size)
        vtkGenericRenderWindowInteractor().SetRenderWindow(self.window)  # VTK's widgets are in none without

    def __enter__(self) -> Stage:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @uninterrupted  # VTK ends the process where its callbacks raise KeyboardInterrupt
    def picture(self, transparent: bool = False) -> np.ndarray:
        """Draw and return the pixels, (height, width, 3) uint8, or (height, width, 4) without background."""
        self.window.Render()
        seen = vtkWindowToImageFilter()
        seen.SetInput(self.window)
        seen.ShouldRerenderOff()
        seen.ReadFrontBufferOn()  # edges are smooth in it already, as they are on the screen
        (seen.SetInputBufferTypeToRGBA if transparent else seen.SetInputBufferTypeToRGB)()
        seen.Update()
        image = seen.GetOutput()
        width, height, _ = image.GetDimensions()
        rows = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)
        return np.ascontiguousarray(rows[::-1])

    def close(self) -> None:
        """Release graphics resources."""
        self.window.Finalize()
        self.window.SetInteractor(None)
