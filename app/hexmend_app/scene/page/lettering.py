"""Lettering of a page: font, which is shipped with matplotlib, widths of texts, and entries of a legend."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path

from PIL import ImageFont

from hexmend_app.picture import Page
from hexmend_app.picture.page import PT_PER_INCH

#: Name of the font, so that pictures look the same on all machines.
FAMILY = "DejaVu Sans"

#: Font size in pixels at which texts are measured.
_MEASURED_SIZE = 200

#: Additional width of a letter in pixels when it is rasterised, because positions are rounded to whole pixels.
_ROUNDING = 0.4

#: Entry of a legend: a text and its colour, red, green and blue from 0 to 255; None for a text alone.
Entry = tuple[str, tuple[int, int, int] | None]


class Lettering:
    """Font size of a page.

    Attributes
    ----------
    points : float
        Font size in pt.
    height : float
        Font size in pixels.

    Parameters
    ----------
    page : Page
    """

    def __init__(self, page: Page):
        self.points = page.letters
        self.height = page.letters / PT_PER_INCH * page.resolution

    def em(self, text: str, bold: bool = False) -> float:
        """Return the width of a text, in font heights."""
        return _font(bold).getlength(text) / _MEASURED_SIZE

    def width(self, text: str, bold: bool = False) -> float:
        """Return an upper bound of the width of a text, in pixels."""
        return self.em(text, bold) * self.height + _ROUNDING * len(text)


@cache
def _font(bold: bool) -> ImageFont.FreeTypeFont:
    import matplotlib as mpl

    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    return ImageFont.truetype(str(Path(mpl.get_data_path()) / "fonts/ttf" / name), _MEASURED_SIZE)


def name_entries(names: Sequence[str], table: Iterable[Iterable[int]], most: int) -> list[Entry]:
    """Return the entries of the first names with their colours, and a last entry that counts the rest.

    >>> name_entries(("a", "b", "c"), [(1, 1, 1), (2, 2, 2), (3, 3, 3)], 2)
    [('a', (1, 1, 1)), ('and 2 more', None)]
    """
    entries: list[Entry] = [(name, (int(r), int(g), int(b))) for name, (r, g, b) in zip(names, table, strict=True)]
    if len(entries) <= most:
        return entries
    first = entries[: max(most - 1, 0)]
    return [*first, (f"and {len(entries) - len(first):,} more", None)]
