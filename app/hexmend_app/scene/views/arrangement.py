"""Arrangement of several views in one window: side by side, or a wipe."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor2D, vtkCoordinate, vtkPolyDataMapper2D, vtkRenderer, vtkRenderWindow

from hexmend_app.state.view.side_views import Wipe
from hexmend_app.theme.palette import LINE, rgb

if TYPE_CHECKING:
    from hexmend_app.scene.views.viewport import Viewport

Rectangle = tuple[float, float, float, float]


def columns(views: int) -> int:
    """Return the number of views in a row."""
    return {1: 1, 2: 2, 3: 3, 4: 2}[views]


def grid(views: int) -> list[Rectangle]:
    """Return the rectangles of a grid of views, x low, y low, x high, y high as shares of the window, by rows.

    >>> grid(2)
    [(0.0, 0.0, 0.5, 1.0), (0.5, 0.0, 1.0, 1.0)]
    >>> grid(4)[1]
    (0.5, 0.5, 1.0, 1.0)
    """
    wide = columns(views)
    high = views // wide
    places = (divmod(k, wide) for k in range(views))
    return [(at / wide, 1 - (row + 1) / high, (at + 1) / wide, 1 - row / high) for row, at in places]


class Arrangement:
    """Places views in a window.

    Parameters
    ----------
    window : vtkRenderWindow
    pixel_ratio : float
        Width of a thin line, in pixels.

    Attributes
    ----------
    head : int
        Pixels of the window that are left free above each of several views side by side, for what is said of it.
    """

    def __init__(self, window: vtkRenderWindow, pixel_ratio: float = 1.0):
        self._window, self._pixel_ratio = window, pixel_ratio
        self._size = (0, 0)
        self._wiped = False
        self._seen: Sequence[Viewport] = ()
        self._centres: dict[Viewport, float] = {}  # of the wipe's halves
        self._borders: list[tuple[vtkRenderer, vtkActor2D]] = []
        self._dark = False
        self.head = 0

    @property
    def outdated(self) -> bool:
        """True if the window was resized since the last `arrange`."""
        return self._window.GetSize() != self._size

    @property
    def aspect(self) -> float:
        """Aspect ratio of a view, or of the two views of a wipe."""
        width, height = self._window.GetSize()
        left, low, right, high = (0, 0, 1, 1) if self._wiped else self._side_by_side(max(len(self._seen), 1))[0]
        return (right - left) * width / max((high - low) * height, 1) if width else 1.0  # before it is laid out

    def _side_by_side(self, views: int) -> list[Rectangle]:
        """Return the rectangles of views side by side, below their captions."""
        head = self.head / max(self._window.GetSize()[1], 1) if views > 1 else 0.0
        return [(left, low, right, max(high - head, low)) for left, low, right, high in grid(views)]

    def arrange(self, views: Sequence[Viewport], seen: Sequence[Viewport], wipe: Wipe | None) -> None:
        """Place all views in the present window, and the edge of a wipe at a whole pixel.

        Parameters
        ----------
        views : sequence of Viewport
            All, the first before those beside it.
        seen : sequence of Viewport
            The visible views.
        wipe : Wipe, optional
            Between the two that are seen.
        """
        self._size, self._seen, self._wiped = self._window.GetSize(), seen, wipe is not None
        width = max(self._size[0], 2)
        if wipe is None:
            places, self._centres = self._side_by_side(len(seen)), {}
        else:
            edge = min(max(round(wipe.at * width), 1), width - 1) / width
            places = [(0.0, 0.0, edge, 1.0), (edge, 0.0, 1.0, 1.0)]
            # Each half is what is left of the whole's picture: its frustum lies aside of the camera's axis.
            self._centres = dict(zip(seen, (1 - 1 / edge, edge / (1 - edge)), strict=True))
        for view in views:
            for layer in view.layers:
                shown = view in seen
                if shown:
                    layer.SetViewport(*places[seen.index(view)])
                if shown != bool(self._window.HasRenderer(layer)):
                    (self._window.AddRenderer if shown else self._window.RemoveRenderer)(layer)
        if views[0] in seen:
            views[0].axes.fit()
        self._part()

    def set_dark(self, dark: bool) -> None:
        """Draw separators for the dark theme, or for the light one."""
        self._dark = dark
        self._part()

    def _part(self) -> None:
        """Draw lines between views side by side."""
        for renderer, line in self._borders:
            renderer.RemoveViewProp(line)
        self._borders.clear()
        for view in () if self._wiped else self._seen:
            renderer = view.layers[0]
            sides = _inner(renderer.GetViewport())
            if sides:
                line = _line(sides, LINE.of(self._dark), self._pixel_ratio)
                renderer.AddViewProp(line)
                self._borders.append((renderer, line))

    def at(self, x: float, y: float) -> Viewport:
        """Return the view at a position in pixels of the window, from its lower left corner."""
        width, height = self._window.GetSize()
        for view in self._seen:
            left, low, right, high = view.layers[0].GetViewport()
            if left * width <= x < right * width and low * height <= y < high * height:
                return view
        return self._seen[0]

    def centre_of(self, view: Viewport) -> float:
        """Return the offset of a view's part of the picture from the camera axis."""
        return self._centres.get(view, 0.0)


#: The ends of a view's left side and of its lower one, as shares of it.
_LEFT, _LOWER = ((0.0, 1.0, 0.0), (0.0, 0.0, 0.0)), ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))


def _inner(place: Rectangle) -> list[tuple]:
    """Return the sides at which a view borders on a neighbour."""
    return [side for side, share in ((_LEFT, place[0]), (_LOWER, place[1])) if share > 0]


def _line(sides: list[tuple], colour: str, width: float) -> vtkActor2D:
    """Build a line along sides of a view, with a width in pixels."""
    shares = vtkCoordinate()
    shares.SetCoordinateSystemToNormalizedViewport()
    mapper = vtkPolyDataMapper2D()
    mapper.SetInputData(pv.line_segments_from_points(np.reshape(sides, (-1, 3))))
    mapper.SetTransformCoordinate(shares)
    actor = vtkActor2D()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(rgb(colour))
    actor.GetProperty().SetLineWidth(2 * width)  # half of it lies beyond the view
    return actor
