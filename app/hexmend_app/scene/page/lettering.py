"""Lettering of a page: size of letters and width of texts."""

from __future__ import annotations

from functools import cache

from PIL import ImageFont

from hexmend_app.picture import Page
from hexmend_app.picture.page import PT_PER_INCH
from hexmend_app.scene.page.fonts import font_file

#: Pixels of the letters that texts are measured in.
_MEASURED = 200

#: Pixels by which a letter is wider where it is drawn as pixels: what draws them rounds each to whole ones.
_ROUNDED = 0.4


class Lettering:
    """Font size of a page.

    Attributes
    ----------
    points : float
        Size in pt.
    height : float
        The same in pixels.

    Parameters
    ----------
    page : Page
    """

    def __init__(self, page: Page):
        self.points = page.letters
        self.height = page.letters / PT_PER_INCH * page.resolution

    def em(self, text: str, bold: bool = False) -> float:
        """Return the width of a text, in heights of a letter."""
        return _font(bold).getlength(text) / _MEASURED

    def width(self, text: str, bold: bool = False) -> float:
        """Return an upper bound of the width of a text, in pixels."""
        return self.em(text, bold) * self.height + _ROUNDED * len(text)


@cache
def _font(bold: bool) -> ImageFont.FreeTypeFont:
    return ImageFont.truetype(font_file(bold), _MEASURED)
