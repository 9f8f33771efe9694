"""Histogram of film frames, with the same scale in all frames; drawn with Pillow for speed."""

from __future__ import annotations

import math

import numpy as np
from PIL import Image, ImageDraw

from hexmend_app.scene.colour.colouring import Colouring
from hexmend_app.scene.film.frame_parts import INK, letters, paper

#: Number of bins.
BINS = 40


def histogram(
    values: np.ndarray, kinds: np.ndarray, colouring: Colouring, size: tuple[int, int], unit: float, mode: str = "RGB"
) -> Image.Image:
    """Draw a histogram of values in their colours; special colours have separate bars on the left.

    The scale is logarithmic, from one hex to all hexes, which shows small numbers of bad hexes and makes frames
    comparable.

    Parameters
    ----------
    values : (m,) float64
        Values of the coloured metric.
    kinds : (m,) bool or uint8
        Number of the special colour of each hex, see `Colouring.colours`.
    colouring : Colouring
    size : (width, height)
        Size in pixels.
    unit : float
        Unit of all sizes, in pixels: 1/30 of the height of the colour bar.
    mode : str
        Mode of the picture: RGB or RGBA.
    """
    image = paper(size, mode)
    draw = ImageDraw.Draw(image)
    font = letters(10 * unit)
    left, right = round(44 * unit), size[0] - round(12 * unit)
    top, bottom = round(14 * unit), size[1] - round(34 * unit)
    scale_end = 10 ** math.ceil(math.log10(max(len(values), 10)))

    def y_of(count: float) -> float:
        return bottom - (bottom - top) * (math.log10(count) + 0.3) / (math.log10(scale_end) + 0.3)

    for power in range(round(math.log10(scale_end)) + 1):
        y = y_of(10**power)
        draw.line((left, y, right, y), (222, 226, 232), 1)
        draw.text((left - 5 * unit, y), f"{10**power:,}", INK, font, anchor="rm")
    special = len(colouring.special_colours)
    bar_width = (right - left) / (BINS + 2 * special)
    regular = np.asarray(kinds) == 0
    low, high = (-0.5, len(colouring.names) - 0.5) if colouring.names else (colouring.low, colouring.high)
    positions = (values[regular] - low) * (BINS / (high - low))
    bins = np.clip(np.nan_to_num(positions, nan=0.0), 0, BINS - 1).astype(int)
    bars = [(2 * i, int(np.count_nonzero(kinds == i + 1)), s.colour) for i, s in enumerate(colouring.special_colours)]
    rows = (2 * np.arange(BINS) + 1) * len(colouring.table) // (2 * BINS)
    for i, count in enumerate(np.bincount(bins, minlength=BINS)):
        bars.append((2 * special + i, int(count), tuple(map(int, colouring.table[rows[i]]))))
    for i, count, colour in bars:
        if count:
            x = left + i * bar_width
            draw.rectangle((x, y_of(count), x + bar_width - max(1.0, unit), bottom), colour)
    draw.line((left, bottom, right, bottom), INK, max(1, round(unit)))
    for share in () if colouring.names else (0.0, 0.5, 1.0):
        x = left + (2 * special + share * BINS) * bar_width
        value = colouring.label(colouring.low + share * (colouring.high - colouring.low))
        draw.text((x, bottom + 5 * unit), value, INK, font, anchor=("lt", "mt", "rt")[round(2 * share)])
    draw.text(((left + right) / 2, size[1] - 3 * unit), f"hexes by {colouring.title}", INK, font, anchor="mb")
    return image
