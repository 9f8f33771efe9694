"""Parts of film frames: colour bar and fonts, drawn with Pillow for speed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from hexmend_app.scene.colour.colouring import Colouring
from hexmend_app.scene.page.fonts import font_file

INK = (31, 38, 48)

#: Height in pixels of pictures up to which thin lines are one pixel wide.
_ONE_PIXEL = 900

#: Minimum width and height in pixels of pictures with a colour bar.
_SMALLEST_WITH_BAR = (320, 160)


def pixel_ratio_of(size: tuple[int, int]) -> float:
    """Return the width of a thin line in pixels for a picture size; printed pictures of all sizes look the same."""
    width, height = size
    return max(1.0, min(height, width * 5 / 8) / _ONE_PIXEL)


def strip_height(size: tuple[int, int]) -> int:
    """Return the height of the colour bar in pixels for a picture size; 0 if it does not fit."""
    width, height = size
    fits = width >= _SMALLEST_WITH_BAR[0] and height >= _SMALLEST_WITH_BAR[1]
    return max(30, round(0.075 * min(height, width * 5 / 8))) if fits else 0


def colour_bar(
    colouring: Colouring, special: Sequence[tuple[str, int | None, tuple]], size: tuple[int, int]
) -> Image.Image:
    """Draw a colour bar: gradient from the lowest to the highest value, ticks, and swatches of special colours.

    Parameters
    ----------
    colouring : Colouring
    special : sequence of (name, number of hexes or None, colour)
        Special colours; None omits the number.
    size : (width, height)
        Size in pixels.
    """
    width, height = size
    image = Image.new("RGB", size, "white")
    draw = ImageDraw.Draw(image)
    unit = height / 30
    font = letters(11 * unit)
    title = colouring.title
    left, right = round(20 * unit + font.getlength(title)), width - round(150 * unit)
    top, bottom = round(3 * unit), round(14 * unit)
    draw.text((round(8 * unit), (top + bottom) / 2), title, INK, font, anchor="lm")
    if colouring.names:
        _draw_names(draw, colouring, (left, right), (top, bottom), font)
    else:
        _draw_gradient(image, colouring, (left, top, right, bottom), font)
    swatch, side = right + round(24 * unit), (11 if len(special) == 1 else 7) * unit
    small = font if len(special) == 1 else letters(8 * unit)
    for row, (name, count, colour) in enumerate(special):
        above = top + round(9 * unit) * row
        draw.rectangle((swatch, above, swatch + round(side), above + round(side)), colour)
        text = name if count is None else f"{name} ({count:,})"
        draw.text((swatch + round(17 * unit), above + side / 2), text, INK, small, anchor="lm")
    return image


def _draw_gradient(
    image: Image.Image, colouring: Colouring, box: tuple[int, int, int, int], font: ImageFont.FreeTypeFont
) -> None:
    """Draw the gradient in a box (left, top, right, bottom) with values below it."""
    left, top, right, bottom = box
    draw, unit = ImageDraw.Draw(image), image.height / 30
    gradient = Image.fromarray(np.ascontiguousarray(colouring.table[None])).resize((max(1, right - left), bottom - top))
    image.paste(gradient, (left, top))
    for k in range(6):
        x, value = left + (right - left) * k / 5, colouring.low + (colouring.high - colouring.low) * k / 5
        draw.line((x, bottom, x, bottom + 2 * unit), INK, max(1, round(unit)))
        draw.text((x, bottom + 3 * unit), colouring.label(value), INK, font, anchor="mt")


def _draw_names(
    draw: ImageDraw.ImageDraw,
    colouring: Colouring,
    across: tuple[int, int],
    along: tuple[int, int],
    font: ImageFont.FreeTypeFont,
) -> None:
    """Draw swatches with names from left to right, as many as fit."""
    (x, right), (top, bottom) = across, along
    side, names = bottom - top, colouring.names
    for at, (name, colour) in enumerate(zip(names, colouring.table, strict=True)):
        more = f"and {len(names) - at:,} more"
        last = at == len(names) - 1
        if x + 2 * side + font.getlength(name) + (0 if last else 2 * side + font.getlength(more)) > right:
            draw.text((x, (top + bottom) / 2), more, INK, font, anchor="lm")
            return
        draw.rectangle((x, top, x + side, bottom), tuple(map(int, colour)))
        draw.text((x + 1.4 * side, (top + bottom) / 2), name, INK, font, anchor="lm")
        x += round(2.2 * side + font.getlength(name))


def letters(size: float) -> ImageFont.FreeTypeFont:
    """Return the font of pictures for a height in pixels."""
    return ImageFont.truetype(font_file(), max(8, round(size)))
