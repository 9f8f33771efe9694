"""Parts of film frames: colour bar and fonts, drawn fast."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from hexmend_app.scene.colour.colouring import Colouring
from hexmend_app.scene.page.fonts import font_file

INK = (31, 38, 48)

#: Height of a picture up to which thin lines are a pixel wide.
_ONE_PIXEL = 900

#: Width and height in pixels below which there is no room for the colour bar.
_SMALLEST_WITH_BAR = (320, 160)


def paper(size: tuple[int, int], mode: str) -> Image.Image:
    """Return an empty picture of a size in pixels: white, or transparent in the mode RGBA."""
    return Image.new(mode, size, (255, 255, 255, 0) if mode == "RGBA" else (255, 255, 255))


def pixel_ratio_of(size: tuple[int, int]) -> float:
    """Return the width of a thin line for a picture size, in pixels: in print, all sizes look alike."""
    width, height = size
    return max(1.0, min(height, width * 5 / 8) / _ONE_PIXEL)


def strip_height(size: tuple[int, int]) -> int:
    """Return the height of the colour bar for a picture size, in pixels; 0 if it does not fit."""
    width, height = size
    space = width >= _SMALLEST_WITH_BAR[0] and height >= _SMALLEST_WITH_BAR[1]
    return max(30, round(0.075 * min(height, width * 5 / 8))) if space else 0


def colour_bar(
    colouring: Colouring,
    special: Sequence[tuple[str, int | None, tuple]],
    size: tuple[int, int],
    mode: str = "RGB",
) -> Image.Image:
    """Draw the gradient from the lowest value to the highest, ticks, and swatches of special colours.

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
    swatch, side = right + round(24 * unit), (11 if len(special) == 1 else 7) * unit
    small = font if len(special) == 1 else letters(8 * unit)
    for row, (name, count, colour) in enumerate(special):
        above = top + round(9 * unit) * row
        draw.rectangle((swatch, above, swatch + round(side), above + round(side)), colour)
        text = name if count is None else f"{name} ({count:,})"
        draw.text((swatch + round(17 * unit), above + side / 2), text, INK, small, anchor="lm")
    return image


def letters(size: float) -> ImageFont.FreeTypeFont:
    """Return the font of pictures in a height in pixels."""
    return ImageFont.truetype(font_file(), max(8, round(size)))
