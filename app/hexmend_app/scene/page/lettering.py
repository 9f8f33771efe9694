"""Lettering of a page: font, which is shipped with matplotlib, its size, and widths of texts."""

from __future__ import annotations

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
