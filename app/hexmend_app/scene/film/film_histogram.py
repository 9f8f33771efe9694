"""Histogram of film frames: drawn fast, with one scale for all frames."""

from __future__ import annotations

import math

import numpy as np
from PIL import Image, ImageDraw

from hexmend_app.scene.colour.colouring import Colouring
from hexmend_app.scene.film.frame_parts import INK, letters, paper

#: Bins of a distribution.
BINS = 40


def histogram(
    values: np.ndarray, kinds: np.ndarray, colouring: Colouring, size: tuple[int, int], unit: float, mode: str = "RGB"
) -> Image.Image:
    """Draw the distribution of values in their colours; special colours have separate bars on the left.

    The scale is logarithmic from one hex to all of them, so that few bad ones are seen and frames can be compared.

    Parameters
    ----------
    values : (m,) float64
        Of the metric that the colours show.
    kinds : (m,) bool or uint8
        As in `Colouring.colours`.
    colouring : Colouring
    size : (width, height)
        In pixels.
    unit : float
        Pixels of a thirtieth of the height of a colour bar.
    mode : str
        Of the picture: RGB or RGBA.
    """
    image = paper(size, mode)
    draw = ImageDraw.Draw(image)
    font = letters(10 * unit)
    left, right = round(44 * unit), size[0] - round(12 * unit)
    top, bottom = round(14 * unit), size[1] - round(34 * unit)
    most = 10 ** math.ceil(math.log10(max(len(values), 10)))

    def up(count: float) -> float:
        return bottom - (bottom - top) * (math.log10(count) + 0.3) / (math.log10(most) + 0.3)

    for power in range(round(math.log10(most)) + 1):
        y = up(10**power)
        draw.line((left, y, right, y), (222, 226, 232), 1)
        draw.text((left - 5 * unit, y), f"{10**power:,}", INK, font, anchor="rm")
    special = len(colouring.special_colours)
    wide = (right - left) / (BINS + 2 * special)
    simple = np.asarray(kinds) == 0
    places = (values[simple] - colouring.low) * (BINS / (colouring.high - colouring.low))
    bins = np.clip(np.nan_to_num(places, nan=0.0), 0, BINS - 1).astype(int)
    bars = [
        (2 * at, int(np.count_nonzero(kinds == at + 1)), one.colour) for at, one in enumerate(colouring.special_colours)
    ]
    for at, count in enumerate(np.bincount(bins, minlength=BINS)):
        bars.append((2 * special + at, int(count), tuple(map(int, colouring.table[(2 * at + 1) * 128 // BINS]))))
    for at, count, colour in bars:
        if count:
            x = left + at * wide
            draw.rectangle((x, up(count), x + wide - max(1.0, unit), bottom), colour)
    draw.line((left, bottom, right, bottom), INK, max(1, round(unit)))
    for share in (0.0, 0.5, 1.0):
        x = left + (2 * special + share * BINS) * wide
        value = colouring.label(colouring.low + share * (colouring.high - colouring.low))
        draw.text((x, bottom + 5 * unit), value, INK, font, anchor=("lt", "mt", "rt")[round(2 * share)])
    draw.text(((left + right) / 2, size[1] - 3 * unit), f"hexes by {colouring.title}", INK, font, anchor="mb")
    return image
