"""Lines and texts on a page: drawn by matplotlib, in pixels from the upper left corner."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from hexmend_app.picture.page import PT_PER_INCH
from hexmend_app.scene.page.fonts import FAMILY
from hexmend_app.scene.page.layout import Layout, Rectangle

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from PIL import Image

#: Letters and lines on bright paper, and on dark.
_DARK, _BRIGHT = "#1f2630", "#e3e7ed"


class Drawing:
    """Drawing functions of a page.

    Parameters
    ----------
    axes : Axes
        Of matplotlib, all over the page, in pixels from its upper left corner.
    layout : Layout
    """

    def __init__(self, axes: Axes, layout: Layout):
        self._axes = axes
        self.letters = layout.letters
        self._points = PT_PER_INCH / layout.scene.page.resolution  # a pixel's
        self.colour = _BRIGHT if layout.scene.page.dark else _DARK
        #: Width of a line, in pixels.
        self.line = max(1.0, self.letters.height / 14)

    def image(self, image: Image.Image, box: Rectangle) -> None:
        """Place a picture into a rectangle of its size."""
        from matplotlib.image import AxesImage

        extent = (box.left, box.left + box.width, box.top + box.height, box.top)
        drawn = AxesImage(self._axes, extent=extent, origin="upper", interpolation="none", zorder=0)
        drawn.set_data(image)
        self._axes.add_image(drawn)

    def text(
        self,
        x: float,
        y: float,
        text: str,
        *,
        anchor: str = "lm",
        share: float = 1.0,
        bold: bool = False,
        turned: bool = False,
        colour: str | None = None,
    ) -> None:
        """Write a text.

        Parameters
        ----------
        x, y : float
        text : str
            Nothing in it is a formula.
        anchor : str
            Anchor: left, middle or right, and top, middle or bottom, by first letters.
        share : float
            Of the height of the page's letters.
        bold, turned : bool
            Turned, it is read from below.
        colour : str, optional
        """
        self._axes.text(
            x,
            y,
            text,
            fontsize=share * self.letters.points,
            fontfamily=FAMILY,
            fontweight="bold" if bold else "normal",
            color=colour or self.colour,
            horizontalalignment={"l": "left", "m": "center", "r": "right"}[anchor[0]],
            verticalalignment={"t": "top", "m": "center_baseline", "b": "bottom"}[anchor[1]],
            rotation=90 if turned else 0,
            rotation_mode="anchor",
            parse_math=False,
            zorder=4,
        )

    def lines(self, *ends: tuple[float, float, float, float], colour: str | None = None, wide: float = 1.0) -> None:
        """Draw lines, each from (x, y) to (x, y); `width` is a multiple of the usual one."""
        from matplotlib.collections import LineCollection

        paths = [((x, y), (u, v)) for x, y, u, v in ends]
        width = wide * self.line * self._points
        self._axes.add_collection(
            LineCollection(paths, colors=colour or self.colour, linewidths=width, capstyle="round", zorder=3),
            autolim=False,
        )

    def fill(
        self, corners: Sequence[tuple[float, float]], colour: str | Sequence[float], alpha: float | None = None
    ) -> None:
        """Fill a polygon."""
        from matplotlib.patches import Polygon

        self._axes.add_patch(Polygon(corners, closed=True, facecolor=colour, edgecolor="none", alpha=alpha, zorder=3))

    def gradient(self, box: Rectangle, colours: Sequence[Sequence[float]], *, upright: bool) -> None:
        """Draw colours from left to right, or from bottom to top, without seams.

        Each reaches to the end of the whole and is covered by the next: nothing behind them shows between two.

        Parameters
        ----------
        box : Box
        colours : (k, 3) float
            Red, green and blue from 0 to 1.
        upright : bool
        """
        from matplotlib.collections import PolyCollection

        right, bottom = box.left + box.width, box.top + box.height
        areas = []
        for k in range(len(colours)):
            left = box.left if upright else box.left + box.width * k / len(colours)
            below = bottom - box.height * k / len(colours) if upright else bottom
            areas.append(((left, box.top), (right, box.top), (right, below), (left, below)))
        self._axes.add_collection(PolyCollection(areas, facecolors=colours, edgecolors="none", zorder=2), autolim=False)
