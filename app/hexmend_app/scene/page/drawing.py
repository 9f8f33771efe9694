"""Lines and texts on a page, drawn with matplotlib in pixels from the upper left corner."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from hexmend_app.picture.page import PT_PER_INCH
from hexmend_app.scene.page.fonts import FAMILY
from hexmend_app.scene.page.layout import Layout, Rectangle

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.axes import Axes

#: Colours of letters and lines on a bright and on a dark background.
_DARK, _BRIGHT = "#1f2630", "#e3e7ed"


class Drawing:
    """Draws lines, texts and pictures on a page.

    Parameters
    ----------
    axes : Axes
        Matplotlib axes that cover the page, in pixels from its upper left corner.
    layout : Layout
    """

    def __init__(self, axes: Axes, layout: Layout):
        self._axes = axes
        self.letters = layout.letters
        self._points = PT_PER_INCH / layout.scene.page.resolution  # size of a pixel in pt
        self.colour = _BRIGHT if layout.scene.page.dark else _DARK
        #: Width of a line, in pixels.
        self.line = max(1.0, self.letters.height / 14)

    def image(self, image: Any, box: Rectangle) -> None:
        """Draw a picture in a rectangle of its size."""
        from matplotlib.image import AxesImage

        extent = (box.left, box.left + box.width, box.top + box.height, box.top)
        artist = AxesImage(self._axes, extent=extent, origin="upper", interpolation="none", zorder=0)
        artist.set_data(image)
        self._axes.add_image(artist)

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
        """Draw a text.

        Parameters
        ----------
        x, y : float
        text : str
            Plain text; math is not parsed.
        anchor : str
            Two letters: l, m or r for left, middle or right, then t, m or b for top, middle or bottom.
        share : float
            Size as a fraction of the font size of the page.
        bold : bool
        turned : bool
            Rotate the text by 90° counter-clockwise.
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

    def lines(self, *ends: tuple[float, float, float, float], colour: str | None = None, width: float = 1.0) -> None:
        """Draw lines from (x, y) to (u, v), given as (x, y, u, v); `width` is a multiple of the default width."""
        from matplotlib.collections import LineCollection

        paths = [((x, y), (u, v)) for x, y, u, v in ends]
        points = width * self.line * self._points
        self._axes.add_collection(
            LineCollection(paths, colors=colour or self.colour, linewidths=points, capstyle="round", zorder=3),
            autolim=False,
        )

    def fill(
        self, corners: Sequence[tuple[float, float]], colour: str | Sequence[float], alpha: float | None = None
    ) -> None:
        """Fill the polygon with these corners."""
        from matplotlib.patches import Polygon

        self._axes.add_patch(Polygon(corners, closed=True, facecolor=colour, edgecolor="none", alpha=alpha, zorder=3))

    def gradient(self, box: Rectangle, colours: np.ndarray, *, upright: bool) -> None:
        """Draw a gradient from left to right, or from bottom to top.

        The area of each colour extends to the end of the gradient and is covered by the next, which avoids seams.

        Parameters
        ----------
        box : Rectangle
        colours : (k, 3) float
            Red, green and blue from 0 to 1.
        upright : bool
            Draw from bottom to top.
        """
        from matplotlib.collections import PolyCollection

        right, bottom = box.left + box.width, box.top + box.height
        areas = []
        for k in range(len(colours)):
            left = box.left if upright else box.left + box.width * k / len(colours)
            below = bottom - box.height * k / len(colours) if upright else bottom
            areas.append(((left, box.top), (right, box.top), (right, below), (left, below)))
        self._axes.add_collection(PolyCollection(areas, facecolors=colours, edgecolors="none", zorder=2), autolim=False)
