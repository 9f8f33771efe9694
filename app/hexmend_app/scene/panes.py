"""Several views in one window, side by side or one wiped over the other."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from vtkmodules.vtkRenderingCore import vtkRenderWindow

from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality
from hexmend_app.scene.arrangement import Arrangement
from hexmend_app.scene.camera.eye import Eye
from hexmend_app.scene.colours import declared_ends
from hexmend_app.scene.extra_layers import raise_error
from hexmend_app.scene.filters import Filters
from hexmend_app.scene.frame import Frame
from hexmend_app.scene.pane import Pane
from hexmend_app.scene.picking import Hit
from hexmend_app.scene.viewport import Viewport
from hexmend_app.state.views import Wipe


class Panes:
    """Views with one camera, one look, one cut and one range of colours, drawn in one go.

    Attributes
    ----------
    first : Viewport
    pane : Pane
        Where it is drawn.
    wipe : Wipe or None
        None where all stand side by side.
    eye : Eye
        Leads the camera.

    Parameters
    ----------
    window : vtkRenderWindow
        With an interactor.
    filters : Filters, optional
        Those of another window's view, whose elements are shown where the mesh has the same hexes.
    pen : float
        How many pixels wide a thin line is.
    on_failure : callable, optional
        Called with the exception of a layer that fails, which is then left out; without it, the exception is raised.
    """

    def __init__(
        self,
        window: vtkRenderWindow,
        filters: Filters | None = None,
        pen: float = 1.0,
        on_failure: Callable[[Exception], object] = raise_error,
    ):
        self._window, self._pen, self._on_failure = window, pen, on_failure
        self.pane = Pane(window)
        self.first = Viewport(self.pane, filters=filters, pen=pen, on_failure=on_failure)
        self._dark = False
        self._others: list[tuple[Mesh, Viewport]] = []
        self.wipe: Wipe | None = None
        self._arrangement = Arrangement(self._window, pen)
        self.eye = Eye(lambda: self.seen, lambda: self._arrangement.aspect)
        self.arrange()
        self._watch(self.first)
        # The hand may grasp what stands in the first view.
        self._window.AddObserver("EndEvent", lambda *_: self._aim(self.first))

    # What is shown

    @property
    def all(self) -> list[Viewport]:
        """The views, the first before those beside it."""
        return [self.first, *(view for _, view in self._others)]

    @property
    def seen(self) -> list[Viewport]:
        """The views that can be seen: of a wipe, the two."""
        return self.all if self.wipe is None else [self.all[self.wipe.left], self.all[self.wipe.right]]

    def draw(self, frame: Frame) -> None:
        """Draw a frame in the first view, and in those beside it what is there under its look, with its movement.

        Another mesh is drawn alone, and seen whole from a corner.
        """
        another = not frame.is_of(self.first.frame)
        if another:
            self.show([])
        self.first.draw(frame)
        for _, view in self._others:
            view.draw(view.frame.beside(frame))
        self.level()
        if another:
            self.eye.look_along("iso")

    def clear(self) -> None:
        """Draw no mesh."""
        self.show([])
        self.first.clear()

    def show(self, others: Sequence[tuple[Mesh, ElementQuality]], wipe: Wipe | None = None) -> None:
        """Show these beside the first view; of the same hexes, the same are left by a cut.

        Parameters
        ----------
        others : sequence of (Mesh, ElementQuality)
            One that is shown already stays as it is.
        wipe : Wipe, optional
            None shows all side by side.
        """
        aspect, fitted = self._arrangement.aspect, self.eye.fitted
        before = self._others
        known = {id(mesh): view for mesh, view in before}
        self._others = [(mesh, known.pop(id(mesh), None) or self._open(mesh, figures)) for mesh, figures in others]
        stay = {id(view) for _, view in self._others}
        for _, view in before:
            if id(view) not in stay:
                view.close()
        self.wipe = wipe
        self.arrange()
        self.level()
        if fitted and abs(self._arrangement.aspect - aspect) > 1e-6:
            self.eye.fit()

    def _open(self, mesh: Mesh, figures: ElementQuality) -> Viewport:
        pane = Pane(self._window, self.first.camera)
        view = Viewport(pane, False, self.first.filters, self._pen, self._on_failure)
        view.set_dark(self._dark)
        view.draw(Frame(mesh, figures).beside(self.first.frame))
        self._watch(view)
        return view

    def set_dark(self, dark: bool) -> None:
        """Draw on the dark theme's ground, or on the light one's."""
        self._dark = dark
        for view in self.all:
            view.set_dark(dark)
        self._arrangement.set_dark(dark)

    def level(self) -> None:
        """Let a range of colours that is fitted span what is drawn in all views."""
        beside = None
        if self.first.frame is None:
            return
        if self._others and declared_ends(self.first.frame.look.scale) is None:
            lows, highs = zip(*(view.colours.ends for view in self.all), strict=True)
            beside = min(lows), max(highs)
        for view in self.all:
            view.span(beside)

    # Where it is shown

    def move_wipe(self, wipe: Wipe) -> None:
        """Bring the edge between the same two views elsewhere."""
        self.wipe = wipe
        self.arrange()

    def leave_heads(self, pixels: int) -> None:
        """Leave so many pixels of the window free above each of several views side by side, for what is said of it."""
        self._arrangement.head = pixels

    def arrange(self) -> None:
        """Give each view its place in the window as large as it is now."""
        self._arrangement.arrange(self.all, self.seen, self.wipe)

    def at(self, x: float, y: float) -> Viewport:
        """The view at a place in pixels of the window, from its lower left corner."""
        return self._arrangement.at(x, y)

    def pick(self, x: float, y: float) -> Hit | None:
        """What is seen at a place in pixels of the window; None beside the meshes."""
        view = self.at(x, y)
        self._aim(view)
        hit = view.pick(x, y)
        self._aim(self.first)
        return hit

    def _watch(self, view: Viewport) -> None:
        """Be told before each layer of a view is drawn."""
        for layer in view.layers:
            layer.AddObserver("StartEvent", lambda *_, view=view: self._begin(view))

    def _begin(self, view: Viewport) -> None:
        if self._arrangement.outdated:
            fitted = self.eye.fitted
            self.arrange()
            if fitted:
                self.eye.fit()
        if self._others and view is self.seen[0]:
            self.eye.reset_depth()
        self._aim(view)

    def _aim(self, view: Viewport) -> None:
        """Lead the camera to what is a view's part of the picture."""
        self.first.camera.SetWindowCenter(self._arrangement.centre_of(view), 0.0)

    # Fast frames and fine ones

    def moving(self) -> None:
        """Prepare for fast frames."""
        for view in self.seen:
            view.moving()

    def turning(self) -> None:
        """Prepare for fast frames in which nothing but the camera moves."""
        for view in self.seen:
            view.turning(len(self.seen))

    def still(self) -> None:
        """Prepare for a fine frame."""
        for view in self.seen:
            view.still()

    def shade(self) -> None:
        """Work out here and now what light reaches a fine frame."""
        for view in self.seen:
            view.shade()
