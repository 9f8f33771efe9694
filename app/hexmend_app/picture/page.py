"""Page of a scene, and styles of lines, colour bar and axes."""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import StrEnum

from hexmend.errors import ParameterError
from hexmend_app.codec.conversion import ConfigTable, option

MM_PER_INCH, PT_PER_INCH = 25.4, 72.0

#: Default aspect ratio, width by height.
_ASPECT = 8 / 5

#: Assumed width in mm of pages in pixels without dpi, and default dpi of pages in mm.
_DEFAULT_WIDTH, _DEFAULT_DPI = 170.0, 300.0

#: Default font size in pt, and minimum font size in pixels.
_FONT_SIZE, _MIN_FONT_PIXELS = 8.0, 8.0

#: Width of a thin line in mm on a page of `_DEFAULT_WIDTH`; at least one pixel.
_THIN = _DEFAULT_WIDTH / _ASPECT / 900

#: Minimum and maximum side of a page, and maximum number of pixels.
_MIN_SIDE, _MAX_SIDE, _MAX_PIXELS = 16, 16384, 2**26


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
    """Names preceded by (a), (b), ..."""
    NONE = "none"


@dataclass(frozen=True)
class LineStyle(ConfigTable):
    """Widths of lines.

    Parameters
    ----------
    edges : float, optional
        Width of the edges of hexes, to which other widths are proportional; 0 omits edges; by default by the page.
    """

    edges: float | None = option(low=0, high=20, unit="pt")

    @property
    def shown(self) -> bool:
        """True if the edges of hexes are drawn."""
        return self.edges != 0


@dataclass(frozen=True)
class ColourBarStyle(ConfigTable):
    """Style of the colour bar.

    Parameters
    ----------
    place : TextPlace
        Position of the bar.
    ticks : int or tuple of float
        Maximum number of values at the bar, or the values.
    title : str
        Title; by default that of the metric.
    """

    place: TextPlace = option(TextPlace.BELOW)
    ticks: int | tuple[float, ...] = option(6, most=30)
    title: str = option("")

    def check(self) -> None:
        """Raise `ParameterError` for an empty list or too many ticks."""
        if self.ticks == ():
            raise ParameterError("ticks = [] lists no values: expected at least one, or 0 for no ticks")
        if isinstance(self.ticks, int) and not 0 <= self.ticks <= 30:
            raise ParameterError(f"ticks = {self.ticks} is out of range: expected 0 to 30, or a list of values")


@dataclass(frozen=True)
class AxesStyle(ConfigTable):
    """Style of the orientation axes.

    Parameters
    ----------
    show : bool
        Draw the axes.
    place : Corner
        Corner of the axes.
    """

    show: bool = option(True)
    place: Corner = option(Corner.LOWER_LEFT)


@dataclass(frozen=True)
class Page(ConfigTable):
    """Page: size in millimetres or in pixels, background, margin and captions.

    Parameters
    ----------
    width, height : float, optional
        Size of the page; if only one is given, the aspect ratio is 8 : 5.
    pixels : tuple of 2 int, optional
        Width and height in pixels, instead of millimetres.
    dpi : float, optional
        Pixels per inch; by default 300, or for pages in pixels as for a width of 170 mm.
    background : str
        white, transparent or #rrggbb.
    margin : float
        Margin on all sides.
    columns : int, optional
        Number of panels in a row; by default by their number.
    crop : bool
        Crop empty margins around the mesh.
    captions : Captions
        Captions of panels; a single panel has one only if it is specified.
    figures : bool
        Add q min and the number of inverted hexes to the captions of several meshes.
    font_size : float, optional
        Size of all texts; by default 8 pt.
    shading : bool
        Apply ambient occlusion, which darkens cavities.
    supersampling : int
        Rendered pixels along each side of a pixel.
    """

    width: float | None = option(low=5, high=3000, unit="mm")
    height: float | None = option(low=5, high=3000, unit="mm")
    pixels: tuple[int, int] | None = option(low=_MIN_SIDE, high=_MAX_SIDE)
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
        """Raise `ParameterError` for an invalid size, background or margin."""
        if self.pixels is not None and (self.width is not None or self.height is not None):
            raise ParameterError("the page has pixels and a width or height in mm: expected one of them")
        width, height = self.size
        if not (min(width, height) >= _MIN_SIDE and max(width, height) <= _MAX_SIDE):
            raise ParameterError(
                f"the page has {width:,} × {height:,} pixels: expected sides of {_MIN_SIDE} to {_MAX_SIDE:,}"
            )
        if width * height > _MAX_PIXELS:
            raise ParameterError(f"the page has {width:,} × {height:,} pixels: expected at most {_MAX_PIXELS:,}")
        if self.background not in ("white", "transparent") and not re.fullmatch("#[0-9a-fA-F]{6}", self.background):
            raise ParameterError(f"background = {self.background!r} is unknown: expected white, transparent or #rrggbb")
        if 2 * self.pixels_of(self.margin) > min(width, height) - _MIN_SIDE:
            raise ParameterError(
                f"margin = {self.margin:g} leaves no space: expected less than half a side of the page"
            )

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
            return _DEFAULT_DPI
        width, height = self.size
        return min(width, height * _ASPECT) / _DEFAULT_WIDTH * MM_PER_INCH

    def pixels_of(self, mm: float) -> int:
        """Convert a length in mm to pixels."""
        return round(mm / MM_PER_INCH * self.resolution)

    @property
    def letters(self) -> float:
        """Font size in pt."""
        return self.font_size or max(_FONT_SIZE, _MIN_FONT_PIXELS * PT_PER_INCH / self.resolution)

    def line_width(self, lines: LineStyle) -> float:
        """Return the width of a thin line in pixels."""
        if lines.edges:
            return lines.edges / PT_PER_INCH * self.resolution
        width, height = self.size
        return max(1.0, min(width, height * _ASPECT) / _DEFAULT_WIDTH * _THIN)

    @property
    def ground(self) -> str | None:
        """Background colour, #rrggbb in lower case; None if transparent."""
        return {"white": "#ffffff", "transparent": None}.get(self.background, self.background.lower())

    @property
    def dark(self) -> bool:
        """True if the background is dark and texts must be bright."""
        if self.ground is None:
            return False
        red, green, blue = bytes.fromhex(self.ground[1:])
        return 0.299 * red + 0.587 * green + 0.114 * blue < 110
