"""Cells of the histogram, which are bins and separate bars, and the ranges of values that match them exactly."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hexmend.quality import METRICS
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.picture.visibility import Show


@dataclass(frozen=True)
class Cells:
    """Bars and bins of a histogram, numbered from 0 at the left.

    They are the bar of inverted hexes, the bar below an axis with an open low end, the bins, and the bar above an axis
    with an open high end.

    Parameters
    ----------
    axis : Axis
    bins : int
    """

    axis: Axis
    bins: int

    def __len__(self) -> int:
        return self.first_bin + self.bins + self.axis.open_high

    def span(self, cell: int) -> tuple[float, float]:
        """Return left and right end of a cell on the plot."""
        k = cell - self.first_bin
        if cell == 0:
            return self.axis.inverted
        if k < 0:
            return self.axis.below
        return self.axis.above if k == self.bins else (k / self.bins, (k + 1) / self.bins)

    def at(self, x: float) -> int | None:
        """Return the cell at a position of the plot; None between two cells."""
        spans = map(self.span, range(len(self)))
        return next((cell for cell, (left, right) in enumerate(spans) if left <= x <= right), None)

    def nearest(self, left: float, right: float) -> tuple[int, int]:
        """Return the first and the last cell of the range of cells that is nearest to two positions on the plot."""
        spans = [self.span(cell) for cell in range(len(self))]
        first = min(range(len(self)), key=lambda cell: abs(spans[cell][0] - left))
        last = min(range(len(self)), key=lambda cell: abs(spans[cell][1] - right))
        if last < first:  # both positions are in the gap between two cells, or in one cell
            first = last = min(range(len(self)), key=lambda cell: abs(sum(spans[cell]) - left - right))
        return first, last

    def range(self, first: int, last: int) -> Show | None:
        """Return the range of exactly the hexes that are counted in cells `first` to `last`; None for all cells.

        Raises
        ------
        ValueError
            If the cells do not exist or are in the wrong order.

        Examples
        --------
        >>> Cells(Axis("q"), 50).range(1, 25).quality
        (0.0, 0.49999999999999994)
        """
        if not 0 <= first <= last < len(self):
            raise ValueError(f"cells {first} to {last}: expected two of 0 to {len(self) - 1}, the lower first")
        if (first, last) == (0, len(self) - 1):
            return None
        if last == 0:
            return Show((-math.inf, -math.inf), self.axis.metric, inverted=True)
        low, high = METRICS[self.axis.metric].full_range  # unbounded
        if first > 1:
            low = self._smallest_value(first)
        if last < len(self) - 1:
            high = math.nextafter(self._smallest_value(last + 1), -math.inf)
        return Show((low, high), self.axis.metric, inverted=first == 0)

    @property
    def first_bin(self) -> int:
        """Number of the cell of the first bin."""
        return 1 + self.axis.open_low

    def _smallest_value(self, cell: int) -> float:
        """Return the smallest value that is counted in a cell from 2 on, or right of it.

        Because of rounding, a value next to the end of a bin may be counted on the other side of this end.
        """
        axis, k = self.axis, cell - self.first_bin
        scale = self.bins / (axis.high - axis.low)
        value = axis.low + k / scale
        while (value - axis.low) * scale >= k:
            value = math.nextafter(value, -math.inf)
        while (value - axis.low) * scale < k:
            value = math.nextafter(value, math.inf)
        return value
