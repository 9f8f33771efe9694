"""A PyVista plotter that draws into the 3D view, for features, scripts and the console.

pyvistaqt's `QtInteractor` is not the canvas: its import and first picture take 1.5 s of processor time, and it needs a
native window, over which no other widget can lie. Instead the plotter adopts the render window of the view: it puts its
actors into the renderer of the first view, and the two cameras follow each other. Widgets and picking of PyVista need
PyVista's interactor: `open_window` opens a pyvistaqt window for them.
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
from hexmend_app.scene.views.prop_copy import copy_prop
from hexmend_app.theme.palette import THEME


class View(Protocol):
    """The 3D view as the plotter uses it: `hexmend_app.canvas.camera_view.CameraView`."""

    interactor: Any
    panes: Any
    viewport: Any

    def changed(self) -> None:
        """Draw soon: something else is to be seen."""

    def draw_soon(self) -> None:
        """Draw soon from where the camera is."""

    def devicePixelRatioF(self) -> float:
        """Return the pixels of the screen for one of Qt's."""


class AdoptedRenderer(pv.Renderer):
    """PyVista's list of its own actors, which another renderer draws.

    Parameters
    ----------
    plotter : Plotter
    target : vtkRenderer
        Draws what is added here; nothing else of it is touched.
    """

    def __init__(self, plotter: BasePlotter, target: vtkRenderer):
        super().__init__(plotter, border=False)
        self._target = target

    def AddActor(self, prop: vtkProp) -> None:
        """Draw a prop."""
        self.AddViewProp(prop)

    def AddViewProp(self, prop: vtkProp) -> None:
        """Draw a prop."""
        super().AddViewProp(prop)
        self._target.AddViewProp(prop)

    def RemoveActor(self, prop: vtkProp) -> None:
        """Draw a prop no longer."""
        self.RemoveViewProp(prop)

    def RemoveViewProp(self, prop: vtkProp) -> None:
        """Draw a prop no longer."""
        self._target.RemoveViewProp(prop)
        super().RemoveViewProp(prop)

    def RemoveAllViewProps(self) -> None:
        """Draw none of the props that were added here."""
        for prop in list(self.GetViewProps()):
            self.RemoveViewProp(prop)


class CanvasPlotter(pv.Plotter):
    """PyVista's plotter on the first view of a canvas.

    `clear` removes only what was added through the plotter. Another mesh, look or theme leaves it as it is, and saved
    pictures have it too.

    Parameters
    ----------
    canvas : View
    """

    def __init__(self, canvas: View):
        # Plotter's own constructor makes a render window.
        BasePlotter.__init__(self, lighting="none", border=False, theme="dark" if THEME.dark else "document")
        self._initialized = False  # attributes may still be added
        self._canvas = canvas
        self.off_screen = self.notebook = False
        self.ren_win = canvas.interactor.render_window
        self.renderers._renderers[0] = AdoptedRenderer(self, canvas.viewport.layers[0])
        self._link = _CameraLink(canvas, self.renderer.camera)
        self.camera_set = True  # adding a mesh moves no camera
        self._first_time = False
        self._initialized = True

    def render(self) -> None:
        """Draw soon; several calls make one frame."""
        if not (self._closed or self._suppress_rendering):
            self._canvas.panes.eye.reset_depth()
            self._canvas.changed()

    def show(self, *_: Any, **__: Any) -> None:
        """Draw soon: the window is open already."""
        self.render()

    def screenshot(self, filename: Any = None, **_: Any) -> np.ndarray:
        """Return the pixels of the view, (height, width, 3) uint8, and write them to a file if one is named."""
        image = self._canvas.interactor.grabFramebuffer().convertToFormat(QImage.Format.Format_RGB888)
        size = image.width(), image.height()
        pixels = Image.frombuffer("RGB", size, bytes(image.constBits()), "raw", "RGB", image.bytesPerLine(), 1)
        if filename is not None:
            pixels.save(filename)
        return np.array(pixels)

    def copied_props(self, line_width: float) -> list[vtkProp]:
        """Copies of the visible props for another render window.

        Parameters
        ----------
        line_width : float
            Width in pixels of a thin line there.
        """
        ratio = line_width / self._canvas.devicePixelRatioF()
        return [copy_prop(prop, ratio) for prop in self.renderer.GetViewProps() if prop.GetVisibility()]

    def close(self) -> None:
        """Remove what was added, and leave the view to the canvas."""
        if not self._closed:
            self._link.close()
            self.clear()
            self.ren_win = None  # it stays the canvas's
            super().close()


class _CameraLink:
    """Keeps a camera of PyVista's like that of a view, whichever is moved."""

    def __init__(self, canvas: View, camera: pv.Camera):
        self._canvas, self._busy = canvas, False
        view = canvas.viewport.camera
        camera.DeepCopy(view)
        self._observers: list[tuple[vtkObject, int]] = [
            (view, view.AddObserver("ModifiedEvent", lambda *_: self._copy(view, camera))),
            (camera, camera.AddObserver("ModifiedEvent", lambda *_: self._lead(camera, view))),
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

    def _lead(self, camera: Any, view: Any) -> None:
        if self._copy(camera, view):
            self._canvas.draw_soon()

    def close(self) -> None:
        for camera, observer in self._observers:
            camera.RemoveObserver(observer)
        self._observers.clear()


def open_window(title: str = "PyVista") -> Any:
    """Open a further view in a window of its own, through pyvistaqt.

    Returns
    -------
    pyvistaqt.BackgroundPlotter
        With PyVista's interactor, widgets and picking.

    Raises
    ------
    HexmendError
        If pyvistaqt is not installed.
    """
    try:
        from pyvistaqt import BackgroundPlotter
    except ImportError as error:
        raise HexmendError(f'pyvistaqt cannot be imported ({error}): pip install "hexmend[app]"') from None
    return BackgroundPlotter(title=title, app=QApplication.instance(), auto_update=False)
