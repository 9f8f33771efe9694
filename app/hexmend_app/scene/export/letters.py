"""Letters of a page: how large they are, and how wide a text is."""

from __future__ import annotations

from functools import cache

from PIL import ImageFont

from hexmend_app.scene.export.fonts import font_file
from hexmend_app.state.scene import Page
from hexmend_app.state.scene.page import PT_PER_INCH

#: Pixels of the letters that texts are measured in.
_MEASURED = 200

#: Pixels by which a letter is wider where it is drawn as pixels: what draws them rounds each to whole ones.
_ROUNDED = 0.4


class Letters:
    """What is written with on a page.

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
        """How wide a text is, in heights of a letter."""
        return _font(bold).getlength(text) / _MEASURED

    def width(self, text: str, bold: bool = False) -> float:
        """How wide a text is at most, in pixels."""
        return self.em(text, bold) * self.height + _ROUNDED * len(text)


@cache
def _font(bold: bool) -> ImageFont.FreeTypeFont:
    return ImageFont.truetype(font_file(bold), _MEASURED)
