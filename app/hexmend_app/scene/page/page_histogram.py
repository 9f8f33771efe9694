"""Histogram of the coloured values on a page, with the same scale in all frames of a film."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from hexmend_app.scene.colour.colouring import Colouring
from hexmend_app.scene.page.drawing import SOFT, Drawing
from hexmend_app.scene.page.layout import Layout
from hexmend_app.scene.page.rasters import Rasters

#: Number of bins, and width of a bar relative to that of its bin.
_BINS, _WIDE = 40, 0.9

#: Free space for the numbers and the title in font heights, and font size relative to that of the page.
_LEFT, _RIGHT, _BELOW, _SHARE = 4.2, 1.4, 3.2, 0.9

#: Lower end of the logarithmic scale, so that a single hex has a bar.
_LOWEST = -0.3


def draw_histogram(drawing: Drawing, layout: Layout, drawn: Rasters) -> None:
    """Draw the numbers of hexes of the last mesh in their colours, and those of an earlier mesh as a line.

    Special colours have bars of their own on the left. The scale is logarithmic, from one hex to all hexes, which shows
    small numbers of bad hexes and makes frames comparable.
    """
    if not layout.histogram:
        return
    box, colouring, letter = layout.histogram_place, drawn.colouring, drawing.letters.height
    left, right = box.left + _LEFT * letter, box.left + box.width - _RIGHT * letter
    top, bottom = box.top + letter, box.top + box.height - _BELOW * letter
    *earlier, counts = (_counts(colouring, values, kinds) for values, kinds in drawn.values)
    powers = range(math.ceil(math.log10(max(counts.sum(), 10))) + 1)
    height = (bottom - top) / (powers[-1] - _LOWEST)  # of a power of ten
    edges = np.linspace(left, right, len(counts) + 1).tolist()
    wide = _WIDE * (edges[1] - edges[0])

    def y_of(count: float) -> float:
        return bottom - height * (math.log10(count) - _LOWEST) if count else bottom

    for power in powers:
        y = y_of(10**power)
        drawing.lines((left, y, right, y), colour=SOFT, width=0.3)
        drawing.text(left - 0.5 * letter, y, f"{10**power:,}", anchor="rm", share=_SHARE)
    colours = np.repeat([one.colour for one in colouring.special_colours], 2, axis=0)
    table = colouring.table[(2 * np.arange(_BINS) + 1) * len(colouring.table) // (2 * _BINS)]
    bars = [(x, y_of(count)) for x, count in zip(edges, counts, strict=False) if count]
    corners = [[(x, bottom), (x, y), (x + wide, y), (x + wide, bottom)] for x, y in bars]
    drawing.fill(*corners, colours=np.concatenate([colours, table])[counts > 0] / 255)
    for other in earlier:
        ys = [bottom, *map(y_of, other), bottom]
        sides = [(x, y, x, v) for x, y, v in zip(edges, ys, ys[1:], strict=False) if y != v]
        tops = [(x, y, u, y) for (x, u), y in zip(pairwise(edges), ys[1:], strict=False) if y != bottom]
        drawing.lines(*sides, *tops, colour=SOFT, width=0.7)
    drawing.lines((left, bottom, right, bottom))
    for share in () if colouring.names else (0.0, 0.5, 1.0):
        value = colouring.low + share * (colouring.high - colouring.low)
        x = edges[-1 - _BINS] + share * (right - edges[-1 - _BINS])
        drawing.text(x, bottom + 0.9 * letter, colouring.label(value), anchor="mm", share=_SHARE)
    drawing.text((left + right) / 2, bottom + 2.2 * letter, f"hexes by {colouring.title}", anchor="mm", share=_SHARE)


def _counts(colouring: Colouring, values: np.ndarray, kinds: np.ndarray) -> np.ndarray:
    """Return the numbers of hexes of each special colour, with gaps, then of the bins of the colour range."""
    low, high = (-0.5, len(colouring.names) - 0.5) if colouring.names else (colouring.low, colouring.high)
    regular = values[(kinds == 0) & ~np.isnan(values)].clip(low, high)
    special = np.zeros(2 * len(colouring.special_colours), dtype=np.int64)
    special[::2] = np.bincount(kinds, minlength=len(colouring.special_colours) + 1)[1:]
    return np.concatenate([special, np.histogram(regular, _BINS, (low, high))[0]])
