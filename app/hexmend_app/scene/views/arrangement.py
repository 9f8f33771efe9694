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
    """Return the rectangles of a grid of views, row by row: x low, y low, x high, y high as fractions of the window.

    >>> grid(2)
    [(0.0, 0.0, 0.5, 1.0), (0.5, 0.0, 1.0, 1.0)]
    >>> grid(4)[1]
    (0.5, 0.5, 1.0, 1.0)
    """
    n_columns = columns(views)
    n_rows = views // n_columns
    return [
        (column / n_columns, 1 - (row + 1) / n_rows, (column + 1) / n_columns, 1 - row / n_rows)
        for row, column in (divmod(k, n_columns) for k in range(views))
    ]


class Arrangement:
    """Places views in a window.

    Parameters
    ----------
    window : vtkRenderWindow
    pixel_ratio : float
        Width of a thin line, in pixels.

    Attributes
    ----------
    caption_height : int
        Height in pixels that is reserved for the caption above each of several views side by side.
    legend_width : int
        Width in pixels that is reserved for the legend to the right of several views side by side.
    """

    def __init__(self, window: vtkRenderWindow, pixel_ratio: float = 1.0):
        self._window, self._pixel_ratio = window, pixel_ratio
        self._size = (0, 0)
        self._is_wipe = False
        self._visible: Sequence[Viewport] = ()
        self._centres: dict[Viewport, float] = {}  # window centres of the two views of a wipe
        self._separators: list[tuple[vtkRenderer, vtkActor2D]] = []
        self._dark = False
        self.caption_height = self.legend_width = 0

    @property
    def outdated(self) -> bool:
        """True if the window was resized since the last `arrange`."""
        return self._window.GetSize() != self._size

    @property
    def aspect(self) -> float:
        """Aspect ratio of a view, or of the two views of a wipe."""
        width, height = self._window.GetSize()
        left, low, right, high = (0, 0, 1, 1) if self._is_wipe else self._side_by_side(max(len(self._visible), 1))[0]
        return (right - left) * width / max((high - low) * height, 1) if width else 1.0  # before the window is laid out

    def _side_by_side(self, views: int) -> list[Rectangle]:
        """Return the rectangles of views side by side, below their captions and to the left of the legend."""
        if views == 1:
            return grid(1)
        width, height = (max(side, 1) for side in self._window.GetSize())
        caption, share = self.caption_height / height, max(1 - self.legend_width / width, 0.0)
        return [(left * share, low, right * share, max(high - caption, low)) for left, low, right, high in grid(views)]

    def arrange(self, views: Sequence[Viewport], visible: Sequence[Viewport], wipe: Wipe | None) -> None:
        """Place all views in the window at its current size; the edge of a wipe is at a whole pixel.

        Parameters
        ----------
        views : sequence of Viewport
            All views, starting with the first view.
        visible : sequence of Viewport
            The visible views.
        wipe : Wipe, optional
            Wipe between the two visible views.
        """
        self._size, self._visible, self._is_wipe = self._window.GetSize(), visible, wipe is not None
        width = max(self._size[0], 2)
        if wipe is None:
            rectangles, self._centres = self._side_by_side(len(visible)), {}
        else:
            edge = min(max(round(wipe.at * width), 1), width - 1) / width
            rectangles = [(0.0, 0.0, edge, 1.0), (edge, 0.0, 1.0, 1.0)]
            # Each view shows its part of the same picture: its frustum is not centred on the camera axis.
            self._centres = dict(zip(visible, (1 - 1 / edge, edge / (1 - edge)), strict=True))
        for view in views:
            for layer in view.layers:
                shown = view in visible
                if shown:
                    layer.SetViewport(*rectangles[visible.index(view)])
                if shown != bool(self._window.HasRenderer(layer)):
                    (self._window.AddRenderer if shown else self._window.RemoveRenderer)(layer)
        if views[0] in visible:
            views[0].axes.fit()
        self._draw_separators()

    def set_dark(self, dark: bool) -> None:
        """Use the separator colour of the dark or of the light theme."""
        self._dark = dark
        self._draw_separators()

    def _draw_separators(self) -> None:
        """Draw separators between views side by side."""
        for renderer, line in self._separators:
            renderer.RemoveViewProp(line)
        self._separators.clear()
        for view in () if self._is_wipe else self._visible:
            renderer = view.layers[0]
            sides = _inner_sides(renderer.GetViewport())
            if sides:
                line = _line(sides, LINE.of(self._dark), self._pixel_ratio)
                renderer.AddViewProp(line)
                self._separators.append((renderer, line))

    def at(self, x: float, y: float) -> Viewport:
        """Return the view at a position in pixels of the window, from its lower left corner."""
        width, height = self._window.GetSize()
        for view in self._visible:
            left, low, right, high = view.layers[0].GetViewport()
            if left * width <= x < right * width and low * height <= y < high * height:
                return view
        return self._visible[0]

    def centre_of(self, view: Viewport) -> float:
        """Return the horizontal window centre of the camera for a view, as defined by `vtkCamera.SetWindowCenter`."""
        return self._centres.get(view, 0.0)


#: End points of the left and the lower side of a view, in normalised viewport coordinates.
_LEFT, _LOWER = ((0.0, 1.0, 0.0), (0.0, 0.0, 0.0)), ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))


def _inner_sides(rectangle: Rectangle) -> list[tuple]:
    """Return the left and lower sides of a view that border on another view."""
    return [side for side, low in ((_LEFT, rectangle[0]), (_LOWER, rectangle[1])) if low > 0]


def _line(sides: list[tuple], colour: str, width: float) -> vtkActor2D:
    """Build lines along sides of a view, `width` in pixels."""
    coordinates = vtkCoordinate()
    coordinates.SetCoordinateSystemToNormalizedViewport()
    mapper = vtkPolyDataMapper2D()
    mapper.SetInputData(pv.line_segments_from_points(np.reshape(sides, (-1, 3))))
    mapper.SetTransformCoordinate(coordinates)
    actor = vtkActor2D()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(rgb(colour))
    actor.GetProperty().SetLineWidth(2 * width)  # the viewport clips half of it
    return actor
