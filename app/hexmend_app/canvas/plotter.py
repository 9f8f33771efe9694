"""PyVista plotter that draws into the 3D view, for features, scripts and the console.

The canvas does not use `QtInteractor` of pyvistaqt: its import and first picture take 1.5 s of processor time, and it
requires a native window, which no other widget can overlap. Instead, the plotter uses the render window of the view:
it adds its actors to the renderer of the first view, and synchronises the two cameras. Widgets and picking of PyVista
require its interactor; `open_window` opens a pyvistaqt window for them.
"""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
import pyvista as pv
from PIL import Image
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication
from pyvista.plotting.plotter import BasePlotter
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkRenderingCore import vtkProp, vtkRenderer

from hexmend.errors import HexmendError
from hexmend.terminal_text import install_hint
from hexmend_app.scene.views.prop_copy import copy_prop
from hexmend_app.theme.palette import THEME


class View(Protocol):
    """Interface of the 3D view for the plotter, implemented by `hexmend_app.canvas.camera_view.CameraView`."""

    interactor: Any
    panes: Any
    viewport: Any

    def changed(self) -> None:
        """Schedule drawing after a change."""

    def draw_soon(self) -> None:
        """Schedule drawing after a camera movement."""

    def devicePixelRatioF(self) -> float:
        """Return the number of device pixels per logical pixel."""


class AdoptedRenderer(pv.Renderer):
    """PyVista renderer that lists the actors of a plotter, which another renderer draws.

    Parameters
    ----------
    plotter : BasePlotter
    target : vtkRenderer
        Renderer that draws the props that are added here; its other props are not changed.
    """

    def __init__(self, plotter: BasePlotter, target: vtkRenderer):
        super().__init__(plotter, border=False)
        self._target = target

    def AddActor(self, prop: vtkProp) -> None:
        """Add a prop."""
        self.AddViewProp(prop)

    def AddViewProp(self, prop: vtkProp) -> None:
        """Add a prop."""
        super().AddViewProp(prop)
        self._target.AddViewProp(prop)

    def RemoveActor(self, prop: vtkProp) -> None:
        """Remove a prop."""
        self.RemoveViewProp(prop)

    def RemoveViewProp(self, prop: vtkProp) -> None:
        """Remove a prop."""
        self._target.RemoveViewProp(prop)
        super().RemoveViewProp(prop)

    def RemoveAllViewProps(self) -> None:
        """Remove all props that were added here."""
        for prop in list(self.GetViewProps()):
            self.RemoveViewProp(prop)


class CanvasPlotter(pv.Plotter):
    """PyVista plotter on the first view of a canvas.

    `clear` removes only actors that were added through the plotter. They remain when mesh, look or theme change, and
    are part of saved pictures.

    Parameters
    ----------
    canvas : View
    """

    def __init__(self, canvas: View):
        # The constructor of Plotter would create a render window.
        BasePlotter.__init__(self, lighting="none", border=False, theme="dark" if THEME.dark else "document")
        self._initialized = False  # PyVista forbids new attributes of initialised plotters
        self._canvas = canvas
        self.off_screen = self.notebook = False
        self.ren_win = canvas.interactor.render_window
        self.renderers._renderers[0] = AdoptedRenderer(self, canvas.viewport.layers[0])
        self._link = _CameraLink(canvas, self.renderer.camera)
        self.camera_set = True  # adding a mesh moves no camera
        self._first_time = False
        self._initialized = True

    def render(self) -> None:
        """Schedule drawing; several calls are combined into one frame."""
        if not (self._closed or self._suppress_rendering):
            self._canvas.panes.camera_controller.reset_depth()
            self._canvas.changed()

    def show(self, *_: Any, **__: Any) -> None:
        """Schedule drawing; the window is open already."""
        self.render()

    def screenshot(self, filename: Any = None, **_: Any) -> np.ndarray:
        """Return the pixels of the view, (height, width, 3) uint8, and optionally write them to a file."""
        image = self._canvas.interactor.grabFramebuffer().convertToFormat(QImage.Format.Format_RGB888)
        size = image.width(), image.height()
        pixels = Image.frombuffer("RGB", size, bytes(image.constBits()), "raw", "RGB", image.bytesPerLine(), 1)
        if filename is not None:
            pixels.save(filename)
        return np.array(pixels)

    def copied_props(self, line_width: float) -> list[vtkProp]:
        """Return copies of the visible props for another render window.

        Parameters
        ----------
        line_width : float
            Width of a thin line in the other window, in pixels.
        """
        ratio = line_width / self._canvas.devicePixelRatioF()
        return [copy_prop(prop, ratio) for prop in self.renderer.GetViewProps() if prop.GetVisibility()]

    def close(self) -> None:
        """Remove all actors of the plotter; the render window remains open."""
        if not self._closed:
            self._link.close()
            self.clear()
            self.ren_win = None  # the canvas owns the render window
            super().close()


class _CameraLink:
    """Synchronises a PyVista camera with the camera of a view, in both directions."""

    def __init__(self, canvas: View, camera: pv.Camera):
        self._canvas, self._busy = canvas, False
        view = canvas.viewport.camera
        camera.DeepCopy(view)
        self._observers: list[tuple[vtkObject, int]] = [
            (view, view.AddObserver("ModifiedEvent", lambda *_: self._copy(view, camera))),
            (camera, camera.AddObserver("ModifiedEvent", lambda *_: self._copy_to_view(camera, view))),
        ]

    def _copy(self, source: Any, target: Any) -> bool:
        if self._busy:
            return False
        self._busy = True
        try:
            target.DeepCopy(source)
        finally:
            self._busy = False
        return True

    def _copy_to_view(self, camera: Any, view: Any) -> None:
        if self._copy(camera, view):
            self._canvas.draw_soon()

    def close(self) -> None:
        for camera, observer in self._observers:
            camera.RemoveObserver(observer)
        self._observers.clear()


def open_window(title: str = "PyVista") -> Any:
    """Open a separate pyvistaqt window.

    Returns
    -------
    pyvistaqt.BackgroundPlotter
        Window with the interactor, widgets and picking of PyVista.

    Raises
    ------
    HexmendError
        If pyvistaqt is not installed.
    """
    try:
        from pyvistaqt import BackgroundPlotter
    except ImportError as error:
        raise HexmendError(f"pyvistaqt cannot be imported ({error}): {install_hint('app')}") from None
    return BackgroundPlotter(title=title, app=QApplication.instance(), auto_update=False)
