"""The page that a scene is drawn on, and what is drawn around the mesh."""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import StrEnum

from hexmend.errors import ParameterError
from hexmend_app.codec.config_table import ConfigTable, option

MM_PER_INCH, PT_PER_INCH = 25.4, 72.0

#: Width by height of a page of which one is named.
_ASPECT = 8 / 5

#: Width in mm of the page that so many pixels stand for where no dpi is named, and dpi where millimetres are.
_USUAL_WIDTH, _USUAL_DPI = 170.0, 300.0

#: Letters in pt: of a page in mm where nothing is named, and the least pixels that can be read.
_LETTERS, _LEAST_PIXELS = 8.0, 8.0

#: Width in mm, on the page of `_USUAL_WIDTH`, of a thin line, which is a pixel wide at least.
_THIN = _USUAL_WIDTH / _ASPECT / 900

#: Pixels of a side, and of a page.
_LEAST_SIDE, _MOST_SIDE, _MOST_PIXELS = 16, 16384, 2**26


class TextPlace(StrEnum):
    """Position of the colour bar."""

    BELOW = "below"
    RIGHT = "right"
    NONE = "none"


class Corner(StrEnum):
    """Corner of a panel in which the axes are drawn."""

    LOWER_LEFT = "lower left"
    LOWER_RIGHT = "lower right"
    UPPER_LEFT = "upper left"
    UPPER_RIGHT = "upper right"


class Captions(StrEnum):
    """Text above each of several panels."""

    NAMES = "names"
    LETTERS = "letters"
    """(a), (b), ... before the names."""
    NONE = "none"


@dataclass(frozen=True)
class LineStyle(ConfigTable):
    """Widths of lines.

    Parameters
    ----------
    edges : float, optional
        The elements' edges, to which all other lines stay in proportion; 0 leaves edges out. Without it, as the size of
        the page suits.
    """

    edges: float | None = option(low=0, high=20, unit="pt")


@dataclass(frozen=True)
class ColourBarStyle(ConfigTable):
    """The colour bar.

    Parameters
    ----------
    place : Place
        below, right or none.
    ticks : int or tuple of float
        How many values stand at it at most, or which.
    title : str
        Instead of the metric's.
    """

    place: TextPlace = option(TextPlace.BELOW)
    ticks: int | tuple[float, ...] = option(6, most=30)
    title: str = option("")

    def check(self) -> None:
        """A number of ticks that has room."""
        if self.ticks == ():
            raise ParameterError("ticks = [] lists no value: expected some, or 0 for none")
        if isinstance(self.ticks, int) and not 0 <= self.ticks <= 30:
            raise ParameterError(f"ticks = {self.ticks} is out of range: expected 0 to 30, or a list of values")


@dataclass(frozen=True)
class AxesStyle(ConfigTable):
    """The axes in a corner.

    Parameters
    ----------
    show : bool
        Draw them.
    place : Corner
        lower left, lower right, upper left or upper right.
    """

    show: bool = option(True)
    place: Corner = option(Corner.LOWER_LEFT)


@dataclass(frozen=True)
class Page(ConfigTable):
    """The page: its size in millimetres, or in pixels.

    Parameters
    ----------
    width, height : float, optional
        Of one alone, the other follows as 8 : 5.
    pixels : tuple of 2 int, optional
        Width and height in pixels instead.
    dpi : float, optional
        Pixels per inch. Of a page in mm 300 where nothing is said; so many pixels stand for a page 170 mm wide.
    background : str
        white, transparent or #rrggbb.
    margin : float
        What stays free on all sides.
    columns : int, optional
        Panels in a row; without it, as suits their number.
    crop : bool
        Cut away empty paper around the mesh: the page becomes smaller.
    captions : Captions
        names, letters or none; of one panel, what is named for it alone.
    figures : bool
        Write least q and number of inverted hexes beside captions where meshes are compared.
    font_size : float, optional
        Of all that is written; without it, 8 pt.
    shading : bool
        Draw what light from all around hardly reaches darker.
    supersampling : int
        Pixels along each side of which one of the mesh's picture is made.
    """

    width: float | None = option(low=5, high=3000, unit="mm")
    height: float | None = option(low=5, high=3000, unit="mm")
    pixels: tuple[int, int] | None = option(low=_LEAST_SIDE, high=_MOST_SIDE)
    dpi: float | None = option(low=5, high=4800)
    background: str = option("white", offered=("white", "transparent", "#f2f2f2"))
    margin: float = option(0.0, low=0, high=500, unit="mm")
    columns: int | None = option(low=1, high=12)
    crop: bool = option(False)
    captions: Captions = option(Captions.NAMES)
    figures: bool = option(True)
    font_size: float | None = option(low=1, high=200, unit="pt")
    shading: bool = option(True)
    supersampling: int = option(2, low=1, high=4)

    def check(self) -> None:
        """One size, of not too many pixels, and a colour."""
        if self.pixels is not None and (self.width is not None or self.height is not None):
            raise ParameterError("the page has pixels and a width or height in mm: expected one of them")
        width, height = self.size
        if not (min(width, height) >= _LEAST_SIDE and max(width, height) <= _MOST_SIDE):
            raise ParameterError(
                f"the page has {width:,} × {height:,} pixels: expected sides of {_LEAST_SIDE} to {_MOST_SIDE:,}"
            )
        if width * height > _MOST_PIXELS:
            raise ParameterError(f"the page has {width:,} × {height:,} pixels: expected {_MOST_PIXELS:,} at most")
        if self.background not in ("white", "transparent") and not re.fullmatch("#[0-9a-fA-F]{6}", self.background):
            raise ParameterError(f"background = {self.background!r} is unknown: expected white, transparent or #rrggbb")
        if 2 * self.pixels_of(self.margin) > min(width, height) - _LEAST_SIDE:
            raise ParameterError(f"margin = {self.margin:g} leaves no room: expected less than half a side of the page")

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        if self.pixels is not None:
            return self.pixels
        if self.width is None and self.height is None:
            return 1600, 1000
        width = self.height * _ASPECT if self.width is None else self.width
        height = self.width / _ASPECT if self.height is None else self.height
        return self.pixels_of(width), self.pixels_of(height)

    @property
    def resolution(self) -> float:
        """Pixels per inch."""
        if self.dpi is not None:
            return self.dpi
        if self.pixels is None and not (self.width is None and self.height is None):
            return _USUAL_DPI
        width, height = self.size
        return min(width, height * _ASPECT) / _USUAL_WIDTH * MM_PER_INCH

    def pixels_of(self, mm: float) -> int:
        """A length in pixels."""
        return round(mm / MM_PER_INCH * self.resolution)

    @property
    def letters(self) -> float:
        """The size of what is written, in pt."""
        return self.font_size or max(_LETTERS, _LEAST_PIXELS * PT_PER_INCH / self.resolution)

    def pen(self, lines: LineStyle) -> float:
        """Width of a thin line in pixels."""
        if lines.edges:
            return lines.edges / PT_PER_INCH * self.resolution
        width, height = self.size
        return max(1.0, min(width, height * _ASPECT) / _USUAL_WIDTH * _THIN)

    @property
    def ground(self) -> str | None:
        """The colour of the paper, #rrggbb; None where it is transparent."""
        return {"white": "#ffffff", "transparent": None}.get(self.background, self.background)

    @property
    def dark(self) -> bool:
        """True if the paper is so dark that text has to be bright."""
        if self.ground is None:
            return False
        red, green, blue = bytes.fromhex(self.ground[1:])
        return 0.299 * red + 0.587 * green + 0.114 * blue < 110
