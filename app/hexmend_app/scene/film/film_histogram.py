"""Histogram of film frames, with the same scale in all frames; drawn with Pillow for speed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PIL import Image, ImageDraw

from hexmend_app.scene.colour.colouring import Colouring
from hexmend_app.scene.film.frame_parts import INK, letters

#: Number of bins.
BINS = 40

#: Colour of the line of the distribution before the run.
_EARLIER = (110, 120, 134)


@dataclass(frozen=True)
class BarCounts:
    """Heights of the bars of a histogram.

    Parameters
    ----------
    special : sequence of int
        Numbers of hexes of the special colours.
    bins : (BINS,) int64
        Numbers of hexes of the bins from the lowest to the highest value of the colour bar.
    """

    special: Sequence[int]
    bins: np.ndarray

    @property
    def total(self) -> int:
        """Number of hexes."""
        return sum(self.special) + int(self.bins.sum())


def count_bars(values: np.ndarray, kinds: np.ndarray, colouring: Colouring) -> BarCounts:
    """Count the hexes of each bar.

    Parameters
    ----------
    values : (m,) float64
        Values of the coloured metric.
    kinds : (m,) bool or uint8
        Number of the special colour of each hex, see `Colouring.colours`.
    colouring : Colouring
    """
    special = [int(np.count_nonzero(kinds == number + 1)) for number in range(len(colouring.special_colours))]
    regular = np.asarray(kinds) == 0
    low, high = (-0.5, len(colouring.names) - 0.5) if colouring.names else (colouring.low, colouring.high)
    positions = (values[regular] - low) * (BINS / (high - low))
    bins = np.clip(np.nan_to_num(positions, nan=0.0), 0, BINS - 1).astype(int)
    return BarCounts(special, np.bincount(bins, minlength=BINS))


def draw_histogram(
    counts: BarCounts,
    colouring: Colouring,
    size: tuple[int, int],
    unit: float,
    earlier: BarCounts | None = None,
) -> Image.Image:
    """Draw a histogram of values in their colours; special colours have separate bars on the left.

    The scale is logarithmic, from one hex to all hexes, which shows small numbers of bad hexes and makes frames
    comparable.

    Parameters
    ----------
    counts : BarCounts
    colouring : Colouring
    size : (width, height)
        Size in pixels.
    unit : float
        Unit of all sizes, in pixels: 1/30 of the height of the colour bar.
    earlier : BarCounts, optional
        Distribution before the run, drawn as a line.
    """
    image = Image.new("RGB", size, "white")
    draw = ImageDraw.Draw(image)
    font = letters(10 * unit)
    left, right = round(44 * unit), size[0] - round(12 * unit)
    top, bottom = round(14 * unit), size[1] - round(34 * unit)
    scale_end = 10 ** math.ceil(math.log10(max(counts.total, 10)))

    def y_of(count: float) -> float:
        return bottom - (bottom - top) * (math.log10(count) + 0.3) / (math.log10(scale_end) + 0.3)

    for power in range(round(math.log10(scale_end)) + 1):
        y = y_of(10**power)
        draw.line((left, y, right, y), (222, 226, 232), 1)
        draw.text((left - 5 * unit, y), f"{10**power:,}", INK, font, anchor="rm")
    special = len(colouring.special_colours)
    bar_width = (right - left) / (BINS + 2 * special)
    bars = [(2 * i, counts.special[i], s.colour) for i, s in enumerate(colouring.special_colours)]
    rows = (2 * np.arange(BINS) + 1) * len(colouring.table) // (2 * BINS)
    for i, count in enumerate(counts.bins.tolist()):
        bars.append((2 * special + i, count, tuple(colouring.table[rows[i]].tolist())))
    for i, count, colour in bars:
        if count:
            x = left + i * bar_width
            draw.rectangle((x, y_of(count), x + bar_width - max(1.0, unit), bottom), colour)
    if earlier is not None:
        for corners in _outline(earlier):
            points = [(left + place * bar_width, y_of(count) if count else bottom) for place, count in corners]
            draw.line(points, _EARLIER, max(1, round(unit)))
    draw.line((left, bottom, right, bottom), INK, max(1, round(unit)))
    for share in () if colouring.names else (0.0, 0.5, 1.0):
        x = left + (2 * special + share * BINS) * bar_width
        value = colouring.label(colouring.low + share * (colouring.high - colouring.low))
        draw.text((x, bottom + 5 * unit), value, INK, font, anchor=("lt", "mt", "rt")[round(2 * share)])
    draw.text(((left + right) / 2, size[1] - 3 * unit), f"hexes by {colouring.title}", INK, font, anchor="mb")
    return image


def _outline(counts: BarCounts) -> list[list[tuple[int, int]]]:
    """Return lines around the bars that are not empty, one for each group of neighbours, as (place, number of hexes).

    >>> _outline(BarCounts([3], np.array([0, 1, 2])))
    [[(0, 0), (0, 3), (1, 3), (1, 0)], [(3, 0), (3, 1), (4, 1), (4, 2), (5, 2), (5, 0)]]
    """
    bars = [*((2 * i, count) for i, count in enumerate(counts.special))]
    bars += enumerate(counts.bins.tolist(), 2 * len(counts.special))
    lines: list[list[tuple[int, int]]] = []
    for place, count in bars:
        if not count:
            continue
        if lines and lines[-1][-1][0] == place:
            lines[-1].pop()
        else:
            lines.append([(place, 0)])
        lines[-1] += [(place, count), (place + 1, count), (place + 1, 0)]
    return lines
