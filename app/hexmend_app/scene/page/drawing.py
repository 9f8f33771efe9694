"""Lines and texts on a page, drawn with matplotlib in pixels from the upper left corner."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from hexmend_app.picture.page import PT_PER_INCH
from hexmend_app.scene.page.layout import Layout, Rectangle
from hexmend_app.scene.page.lettering import FAMILY

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Colours of letters and lines on a bright and on a dark background.
_DARK, _BRIGHT = "#1f2630", "#e3e7ed"

#: Colour of secondary lines.
SOFT = "#6e7886"


class Drawing:
    """Draws lines, texts and pictures on a figure, without axes, which would take most of the time of a film frame.

    Parameters
    ----------
    figure : Figure
        Figure in the size of the page.
    layout : Layout
    """

    def __init__(self, figure: Figure, layout: Layout):
        from matplotlib.transforms import Affine2D

        self._figure = figure
        self._place = Affine2D().scale(1 / layout.size[0], -1 / layout.size[1]).translate(0, 1) + figure.transFigure
        self.letters = layout.letters
        self._points = PT_PER_INCH / layout.scene.page.resolution  # size of a pixel in pt
        self.dark, self._ground = layout.scene.page.dark, layout.scene.page.ground
        self.colour = _BRIGHT if self.dark else _DARK
        #: Width of a line, in pixels.
        self.line = max(1.0, self.letters.height / 14)

    def image(self, image: Any, box: Rectangle) -> None:
        """Draw a picture, or the colours of an array of pixels, in a rectangle."""
        from matplotlib.image import BboxImage
        from matplotlib.transforms import Bbox, TransformedBbox

        place = TransformedBbox(Bbox.from_bounds(box.left, box.top, box.width, box.height), self._place)
        artist = BboxImage(place, interpolation="none", zorder=0)
        artist.set_data(image)
        self._figure.add_artist(artist)

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
        halo: bool = False,
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
        halo : bool
            Outline the letters in the background colour, so that they are visible in front of a mesh.
        """
        # The outline is a text of its own, as letters with effects are curves in vector files.
        for effects in (self._halo, []) if halo and self._halo else ([],):
            self._figure.text(
                x,
                y,
                text,
                transform=self._place,
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
                path_effects=effects,
            )

    def arrow(self, start: tuple[float, float], end: tuple[float, float], colour: str) -> None:
        """Draw an arrow, outlined in the background colour."""
        from matplotlib.patches import FancyArrowPatch

        arrow = FancyArrowPatch(
            start,
            end,
            arrowstyle="-|>",
            color=colour,
            linewidth=1.6 * self.line * self._points,
            mutation_scale=self.letters.points,
            shrinkA=0,
            shrinkB=0,
            transform=self._place,
            path_effects=self._halo,
            zorder=3,
        )
        self._figure.add_artist(arrow)

    @property
    def _halo(self) -> list[Any]:
        """Outline in the background colour; none on a transparent page."""
        from matplotlib.patheffects import withStroke

        return (
            []
            if self._ground is None
            else [withStroke(linewidth=4 * self.line * self._points, foreground=self._ground)]
        )

    def lines(self, *ends: tuple[float, float, float, float], colour: str | None = None, width: float = 1.0) -> None:
        """Draw lines from (x, y) to (u, v), given as (x, y, u, v); `width` is a multiple of the default width."""
        from matplotlib.collections import LineCollection

        paths = [((x, y), (u, v)) for x, y, u, v in ends]
        pen: dict[str, Any] = {"colors": colour or self.colour, "linewidths": width * self.line * self._points}
        self._figure.add_artist(LineCollection(paths, capstyle="round", zorder=3, transform=self._place, **pen))

    def fill(self, *corners: Sequence[tuple[float, float]], colours: Any) -> None:
        """Fill polygons, each given by its corners, with one colour or a colour for each."""
        from matplotlib.collections import PolyCollection

        self._figure.add_artist(
            PolyCollection(corners, facecolors=colours, edgecolors="none", zorder=3, transform=self._place)
        )
