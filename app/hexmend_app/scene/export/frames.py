"""Parts of frames that are drawn fast, one after another, as films need them: a colour bar, and letters."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from hexmend_app.scene.colours import Colouring
from hexmend_app.scene.export.fonts import font_file

INK = (31, 38, 48)

#: Height of a picture up to which thin lines are a pixel wide.
_ONE_PIXEL = 900

#: Width and height in pixels below which there is no room for the colour bar.
_SMALLEST_WITH_BAR = (320, 160)


def paper(size: tuple[int, int], mode: str) -> Image.Image:
    """Nothing, in a picture of so many pixels: white, or transparent in the mode RGBA."""
    return Image.new(mode, size, (255, 255, 255, 0) if mode == "RGBA" else (255, 255, 255))


def pen_of(size: tuple[int, int]) -> float:
    """How many pixels wide a thin line is in a picture of so many: on paper all sizes of it look alike."""
    width, height = size
    return max(1.0, min(height, width * 5 / 8) / _ONE_PIXEL)


def strip_height(size: tuple[int, int]) -> int:
    """How high the colour bar is in a picture of so many pixels; 0 where there is no room for it."""
    width, height = size
    room = width >= _SMALLEST_WITH_BAR[0] and height >= _SMALLEST_WITH_BAR[1]
    return max(30, round(0.075 * min(height, width * 5 / 8))) if room else 0


def colour_bar(
    colouring: Colouring, apart: Sequence[tuple[str, int | None, tuple]], size: tuple[int, int], mode: str = "RGB"
) -> Image.Image:
    """The colours from the lowest value to the highest, ticks, the swatches of what is set apart.

    Parameters
    ----------
    colouring : Colouring
    apart : sequence of (name, number of elements or None, colour)
        None leaves the number out.
    size : (width, height)
        In pixels.
    mode : str
        Of the picture: RGB or RGBA.
    """
    width, height = size
    image = paper(size, mode)
    draw = ImageDraw.Draw(image)
    unit = height / 30
    font = letters(11 * unit)
    low, high, title = colouring.low, colouring.high, colouring.title
    left, right = round(20 * unit + font.getlength(title)), width - round(150 * unit)
    top, bottom = round(3 * unit), round(14 * unit)
    gradient = Image.fromarray(np.ascontiguousarray(colouring.table[None])).resize((max(1, right - left), bottom - top))
    image.paste(gradient, (left, top))
    draw.text((round(8 * unit), (top + bottom) / 2), title, INK, font, anchor="lm")
    for k in range(6):
        x, value = left + (right - left) * k / 5, low + (high - low) * k / 5
        draw.line((x, bottom, x, bottom + 2 * unit), INK, max(1, round(unit)))
        draw.text((x, bottom + 3 * unit), colouring.label(value), INK, font, anchor="mt")
    swatch, side = right + round(24 * unit), (11 if len(apart) == 1 else 7) * unit
    small = font if len(apart) == 1 else letters(8 * unit)
    for row, (name, count, colour) in enumerate(apart):
        above = top + round(9 * unit) * row
        draw.rectangle((swatch, above, swatch + round(side), above + round(side)), colour)
        text = name if count is None else f"{name} ({count:,})"
        draw.text((swatch + round(17 * unit), above + side / 2), text, INK, small, anchor="lm")
    return image


def letters(size: float) -> ImageFont.FreeTypeFont:
    """The font of pictures, so many pixels high."""
    return ImageFont.truetype(font_file(), max(8, round(size)))
