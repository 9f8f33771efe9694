"""Several views in one window, side by side or one wiped over the other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pyvista as pv
from vtkmodules.vtkCommonDataModel import vtkBoundingBox
from vtkmodules.vtkRenderingCore import vtkActor2D

from hexmend.mesh import Mesh
from hexmend.quality import ElementQuality
from hexmend_app.scene.colours import declared_ends
from hexmend_app.scene.filters import Filters
from hexmend_app.scene.frame import Frame, same_hexes
from hexmend_app.scene.palette import LINE
from hexmend_app.scene.pane import Pane
from hexmend_app.scene.picking import Hit
from hexmend_app.scene.viewport import Viewport
from hexmend_app.state.views import MOST, Wipe

#: How many views a plotter has to have room for: the first, and those beside it.
ROOM = MOST + 1

Rectangle = tuple[float, float, float, float]


def columns(views: int) -> int:
    """How many of so many views stand side by side in a row."""
    return {1: 1, 2: 2, 3: 3, 4: 2}[views]


def grid(views: int) -> list[Rectangle]:
    """Where views side by side stand, x low, y low, x high, y high as shares of the window, row by row from the top.

    >>> grid(2)
    [(0.0, 0.0, 0.5, 1.0), (0.5, 0.0, 1.0, 1.0)]
    >>> grid(4)[1]
    (0.5, 0.5, 1.0, 1.0)
    """
    wide = columns(views)
    high = views // wide
    places = (divmod(k, wide) for k in range(views))
    return [(at / wide, 1 - (row + 1) / high, (at + 1) / wide, 1 - row / high) for row, at in places]


class Panes:
    """Views with one camera, one look, one cut and one range of colours, drawn in one go.

    Parameters
    ----------
    plotter : pyvista.BasePlotter
        With a row of `ROOM` renderers.
    filters : Filters, optional
        Those of another window's view, whose elements are shown where the mesh has the same hexes.
    """

    def __init__(self, plotter: pv.BasePlotter, filters: Filters | None = None):
        self._plotter = plotter
        self._window = plotter.render_window
        for renderer in list(plotter.renderers)[1:]:
            self._window.RemoveRenderer(renderer)
        plotter.renderers[0].SetViewport(0, 0, 1, 1)
        self.first = Viewport(Pane(plotter, 0), filters=filters)
        self._dark = False
        self._others: dict[int, tuple[Mesh, Viewport]] = {}  # by renderer
        self._order: list[int] = []
        self.wipe: Wipe | None = None  # None where all stand side by side
        self._centres: dict[Viewport, float] = {}  # of the wipe's halves
        self._borders: list[tuple[pv.Renderer, vtkActor2D]] = []
        self._size = (0, 0)
        self._fitted: tuple[float, ...] = ()  # where the camera stands after `fit`
        self._watch(self.first)
        # The hand may grasp what stands in the first view.
        self._window.AddObserver("EndEvent", lambda *_: self._aim(self.first))

    # What is shown

    def draw(self, frame: Frame) -> None:
        """Draw a frame in the first view, and in those beside it what is there under its look, with its movement.

        Another mesh is drawn alone, and seen whole from a corner.
        """
        another = not frame.is_of(self.first.frame)
        if another:
            self.show([])
        self.first.draw(frame)
        for _, view in self._others.values():
            view.draw(_beside(frame, view.frame))
        self.level()
        if another:
            self.look_along("iso")

    @property
    def all(self) -> list[Viewport]:
        """The views, the first before those beside it."""
        return [self.first, *(self._others[at][1] for at in self._order)]

    @property
    def seen(self) -> list[Viewport]:
        """The views that can be seen: of a wipe, the two."""
        return self.all if self.wipe is None else [self.all[self.wipe.left], self.all[self.wipe.right]]

    def show(self, others: Sequence[tuple[Mesh, ElementQuality]], wipe: Wipe | None = None) -> None:
        """Show these beside the first view; of the same hexes, the same are left by a cut.

        Parameters
        ----------
        others : sequence of (Mesh, ElementQuality)
            One that is shown already stays as it is.
        wipe : Wipe, optional
            None shows all side by side.
        """
        aspect, fitted = self._aspect, self._fitted == self._reach
        known = {id(mesh): at for at, (mesh, _) in self._others.items()}
        for at in set(self._others) - {known.get(id(mesh)) for mesh, _ in others}:
            self._close(at)
        order = []
        for mesh, figures in others:
            at = known.get(id(mesh))
            order.append(self._open(mesh, figures) if at is None else at)
        self._order, self.wipe = order, wipe
        self.arrange()
        self.level()
        if fitted and abs(self._aspect - aspect) > 1e-6:
            self.fit()

    def _open(self, mesh: Mesh, figures: ElementQuality) -> int:
        at = min(set(range(1, ROOM)) - set(self._others))
        view = Viewport(Pane(self._plotter, at), axes=False, filters=self.first.filters)
        view.set_dark(self._dark)
        view.draw(_beside(self.first.frame, Frame(mesh, figures)))
        self._others[at] = mesh, view
        self._watch(view)
        return at

    def _close(self, at: int) -> None:
        self._others.pop(at)[1].close()

    def set_dark(self, dark: bool) -> None:
        """Draw on the dark theme's ground, or on the light one's."""
        self._dark = dark
        for view in self.all:
            view.set_dark(dark)
        self._frame()

    def level(self) -> None:
        """Let a range of colours that is fitted span what is drawn in all views."""
        beside = None
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

    def arrange(self) -> None:
        """Give each view its place, and the wipe its edge at a whole pixel of the window as large as it is now."""
        self._size = self._window.GetSize()
        width = max(self._size[0], 2)
        seen, wipe = self.seen, self.wipe
        if wipe is None:
            places, self._centres = grid(len(seen)), {}
        else:
            edge = min(max(round(wipe.at * width), 1), width - 1) / width
            places = [(0.0, 0.0, edge, 1.0), (edge, 0.0, 1.0, 1.0)]
            # Each half is what is left of the whole's picture: its frustum lies aside of the camera's axis.
            self._centres = dict(zip(seen, (1 - 1 / edge, edge / (1 - edge)), strict=True))
        for view in self.all:
            for layer in view.layers:
                shown = view in seen
                if shown:
                    layer.SetViewport(*places[seen.index(view)])
                if shown != bool(self._window.HasRenderer(layer)):
                    (self._window.AddRenderer if shown else self._window.RemoveRenderer)(layer)
        if self.first in seen:
            self.first.axes.fit()
        self._frame()

    def _frame(self) -> None:
        """Part views side by side by lines."""
        for renderer, line in self._borders:
            renderer.RemoveViewProp(line)
        self._borders.clear()
        for view in self.seen if self.wipe is None else ():
            renderer = view.layers[0]
            edges = _inner(renderer.GetViewport())
            if edges:
                self._borders.append((renderer, renderer.add_border(LINE.of(self._dark), 1, edges=edges)))

    def at(self, x: float, y: float) -> Viewport:
        """The view at a place in pixels of the window, from its lower left corner."""
        width, height = self._window.GetSize()
        for view in self.seen:
            left, low, right, high = view.layers[0].GetViewport()
            if left * width <= x < right * width and low * height <= y < high * height:
                return view
        return self.seen[0]

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
        if self._window.GetSize() != self._size:
            self.arrange()
        if self._others and view is self.seen[0]:
            self.reset_depth()
        self._aim(view)

    def _aim(self, view: Viewport) -> None:
        """Lead the camera to what is a view's part of the picture."""
        self.first.camera.SetWindowCenter(self._centres.get(view, 0.0), 0.0)

    # Camera and frames

    def fit(self) -> None:
        """Show what is shown as large as it can be, from where the camera looks."""
        if self.first.frame is None:
            return
        renderer = self.first.layers[0]
        part = renderer.GetViewport()
        if self.wipe is not None:
            renderer.SetViewport(0, 0, 1, 1)  # the mesh has the whole's width
        self.first.eye.fit(np.concatenate([view.places for view in self.seen]))
        renderer.SetViewport(*part)
        self._fitted = self._reach

    def look_along(self, direction: str | tuple[float, float, float]) -> None:
        """Look at what is shown from a direction: a name of `VIEWS`, or a vector."""
        self.first.eye.look_along(direction)
        self.fit()

    @property
    def _reach(self) -> tuple[float, ...]:
        """What changes as the camera is shifted or zooms, but not as it turns."""
        camera = self.first.camera
        return *camera.GetFocalPoint(), round(camera.GetDistance(), 9), camera.GetParallelScale()

    @property
    def _aspect(self) -> float:
        width, height = self._window.GetSize()
        left, low, right, high = self.first.layers[0].GetViewport() if self.wipe is None else (0.0, 0.0, 1.0, 1.0)
        return (right - left) * width / max((high - low) * height, 1)

    def reset_depth(self) -> None:
        """Fit what is near and far enough to be drawn to where the camera is."""
        box = vtkBoundingBox()
        for view in self.seen:
            box.AddBounds(view.layers[0].ComputeVisiblePropBounds())
        if box.IsValid():
            bounds = [0.0] * 6
            box.GetBounds(bounds)
            self.first.layers[0].ResetCameraClippingRange(bounds)

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


def _inner(place: Rectangle) -> list[str]:
    """The sides of a view at which there is another before it, in its row or below."""
    return [side for side, share in (("left", place[0]), ("bottom", place[1])) if share > 0]


def _beside(first: Frame, own: Frame) -> Frame:
    """What a view beside the first draws: its own mesh and figures as the first frame has them looked at.

    It compares with the same moment as the first.
    """
    movement = first.movement
    if movement is not None and not same_hexes(movement.mesh, own.mesh):
        movement = None
    elif movement is not None:
        known = own.movement
        if known is not None and known.before.points is movement.before.points:
            movement = known
        else:
            movement = movement.until(own.mesh.points, own.figures)
    return Frame(own.mesh, own.figures, movement, first.look)
