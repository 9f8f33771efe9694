"""Several views in a window, side by side or as a wipe."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from vtkmodules.vtkRenderingCore import vtkRenderWindow

from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality
from hexmend_app.scene.camera.camera_controller import CameraController
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.colour.colouring import declared_ends
from hexmend_app.scene.cutting.filters import Filters
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.layers.overlay_layers import raise_error
from hexmend_app.scene.views.arrangement import Arrangement
from hexmend_app.scene.views.picking import Hit
from hexmend_app.scene.views.viewport import Viewport
from hexmend_app.state.view.side_views import Wipe


class Panes:
    """Views that share camera, look, cut and colour range, and are drawn together.

    Attributes
    ----------
    first : Viewport
    pane : Pane
        Pane of the first view.
    wipe : Wipe or None
        None if the views are side by side.
    camera_controller : CameraController

    Parameters
    ----------
    window : vtkRenderWindow
        Window with an interactor.
    filters : Filters, optional
        Filters of a view in another window, which are reused if the mesh has the same hexes.
    pixel_ratio : float
        Width of a thin line, in pixels.
    on_failure : callable, optional
        Called with the exception of a layer that fails, which is then hidden; by default the exception is raised.
    """

    def __init__(
        self,
        window: vtkRenderWindow,
        filters: Filters | None = None,
        pixel_ratio: float = 1.0,
        on_failure: Callable[[Exception], object] = raise_error,
    ):
        self._window, self._pixel_ratio, self._on_failure = window, pixel_ratio, on_failure
        self.pane = Pane(window)
        self.first = Viewport(self.pane, filters=filters, pixel_ratio=pixel_ratio, on_failure=on_failure, gradient=True)
        self._dark = False
        self._others: list[tuple[Mesh, Viewport]] = []
        self.wipe: Wipe | None = None
        self._arrangement = Arrangement(self._window, pixel_ratio)
        self.camera_controller = CameraController(lambda: self.visible, lambda: self._arrangement.aspect)
        self.arrange()
        self._observe(self.first)
        # Widgets that are dragged are in the first view.
        self._window.AddObserver("EndEvent", lambda *_: self._aim(self.first))

    # Content

    @property
    def all(self) -> list[Viewport]:
        """All views, starting with the first view."""
        return [self.first, *(view for _, view in self._others)]

    @property
    def visible(self) -> list[Viewport]:
        """The visible views; both views of a wipe."""
        return self.all if self.wipe is None else [self.all[self.wipe.left], self.all[self.wipe.right]]

    def draw(self, frame: Frame) -> None:
        """Draw a frame in the first view, and update the others to its look and movement.

        Another mesh closes the other views and resets the camera.
        """
        new_mesh = not frame.is_of(self.first.frame)
        if new_mesh:
            self.show([])
        self.first.draw(frame)
        for _, view in self._others:
            view.draw(view.frame.matching(frame))
        self.share_colour_range()
        if new_mesh:
            self.camera_controller.look_along("iso")

    def clear(self) -> None:
        """Draw no mesh."""
        self.show([])
        self.first.clear()

    def show(self, others: Sequence[tuple[Mesh, ElementQuality]], wipe: Wipe | None = None) -> None:
        """Show other meshes besides the mesh of the first view; meshes with equal hexes share its filters.

        Parameters
        ----------
        others : sequence of (Mesh, ElementQuality)
            Views of meshes that are shown already are reused.
        wipe : Wipe, optional
            None shows all views side by side.
        """
        aspect, fitted = self._arrangement.aspect, self.camera_controller.fitted
        previous = self._others
        known = {id(mesh): view for mesh, view in previous}
        self._others = [(mesh, known.pop(id(mesh), None) or self._open(mesh, quality)) for mesh, quality in others]
        for _, view in previous:
            if view not in self.all:
                view.close()
        self.wipe = wipe
        self.arrange()
        self.share_colour_range()
        if fitted and abs(self._arrangement.aspect - aspect) > 1e-6:
            self.camera_controller.fit()

    def _open(self, mesh: Mesh, quality: ElementQuality) -> Viewport:
        pane = Pane(self._window, self.first.camera)
        view = Viewport(pane, False, self.first.filters, self._pixel_ratio, self._on_failure, True)
        view.set_dark(self._dark)
        view.draw(Frame(mesh, quality).matching(self.first.frame))
        self._observe(view)
        return view

    def set_dark(self, dark: bool) -> None:
        """Use the colours of the dark or of the light theme."""
        self._dark = dark
        for view in self.all:
            view.set_dark(dark)
        self._arrangement.set_dark(dark)

    def share_colour_range(self) -> None:
        """Extend a fitted colour range to the values of all views."""
        if self.first.frame is None:
            return
        ends = None
        if self._others and declared_ends(self.first.frame.look.colours) is None:
            lows, highs = zip(*(view.colours.ends for view in self.all), strict=True)
            ends = min(lows), max(highs)
        for view in self.all:
            view.extend_range(ends)

    # Arrangement

    def move_wipe(self, wipe: Wipe) -> None:
        """Move the edge of the wipe."""
        self.wipe = wipe
        self.arrange()

    def reserve_captions(self, pixels: int) -> None:
        """Reserve space for a caption above each of several views, in pixels."""
        self._arrangement.caption_height = pixels

    def reserve_legend(self, pixels: int) -> None:
        """Reserve space for a legend to the right of several views, in pixels; a fitted camera is fitted again."""
        if pixels == self._arrangement.legend_width:
            return
        fitted, self._arrangement.legend_width = self.camera_controller.fitted, pixels
        self.arrange()
        if fitted:
            self.camera_controller.fit()

    def arrange(self) -> None:
        """Place all views in the window at its current size."""
        self._arrangement.arrange(self.all, self.visible, self.wipe)

    def at(self, x: float, y: float) -> Viewport:
        """Return the view at a position in pixels of the window, from its lower left corner."""
        return self._arrangement.at(x, y)

    def pick(self, x: float, y: float) -> Hit | None:
        """Pick at a position in pixels of the window, from its lower left corner; None outside the meshes."""
        view = self.at(x, y)
        self._aim(view)
        hit = view.pick(x, y)
        self._aim(self.first)
        return hit

    def _observe(self, view: Viewport) -> None:
        """Prepare the camera before each layer of a view is drawn."""
        for layer in view.layers:
            # Before the observers of layers, which use the camera and the vertical axis.
            layer.AddObserver("StartEvent", lambda *_, view=view: self._begin(view), 1.0)

    def _begin(self, view: Viewport) -> None:
        if self._arrangement.outdated:
            fitted = self.camera_controller.fitted
            self.arrange()
            if fitted:
                self.camera_controller.fit()
        if self._others and view is self.visible[0]:
            self.camera_controller.reset_depth()
        self._aim(view)

    def _aim(self, view: Viewport) -> None:
        """Set the window centre of the camera for a view."""
        self.first.camera.SetWindowCenter(self._arrangement.centre_of(view), 0.0)

    # Fast frames and fine ones

    def moving(self) -> None:
        """Prepare for fast frames."""
        for view in self.visible:
            view.moving()

    def turning(self) -> None:
        """Prepare for fast frames in which only the camera moves."""
        for view in self.visible:
            view.turning(len(self.visible))

    def still(self) -> None:
        """Prepare for a fine frame."""
        for view in self.visible:
            view.still()
