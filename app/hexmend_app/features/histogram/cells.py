"""The places where the histogram counts, and the ranges that show exactly what some of them count."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hexmend.quality import METRICS
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.picture.appearance import ValueRange


@dataclass(frozen=True)
class Cells:
    """Bar of the inverted, bar below the axis if there is one, bins, bar above if there is one: numbered so from 0.

    Parameters
    ----------
    axis : Axis
    bins : int
    """

    axis: Axis
    bins: int

    def __len__(self) -> int:
        return self._first + self.bins + self.axis.open_high

    def place(self, at: int) -> tuple[float, float]:
        """Left and right of a cell on the plot."""
        k = at - self._first
        if at == 0:
            return self.axis.inverted
        if k < 0:
            return self.axis.below
        return self.axis.above if k == self.bins else (k / self.bins, (k + 1) / self.bins)

    def nearest(self, left: float, right: float) -> tuple[int, int]:
        """The first and the last of the cells whose ends are nearest to two places; never none."""
        places = [self.place(at) for at in range(len(self))]
        first = min(range(len(self)), key=lambda at: abs(places[at][0] - left))
        last = min(range(len(self)), key=lambda at: abs(places[at][1] - right))
        if last < first:  # both are nearest to what is between two cells
            first = last = min(range(len(self)), key=lambda at: abs(sum(places[at]) - left - right))
        return first, last

    def range(self, first: int, last: int) -> ValueRange | None:
        """Return the range that shows only the elements counted in cells `first` to `last`; None if that is all.

        >>> Cells(Axis("q"), 50).range(1, 25)
        ValueRange(metric='q', low=0.0, high=0.49999999999999994, inverted=False)
        """
        if not 0 <= first <= last < len(self):
            raise ValueError(f"cells {first} to {last}: expected two of 0 to {len(self) - 1}, the lower first")
        if (first, last) == (0, len(self) - 1):
            return None
        if last == 0:
            return ValueRange(self.axis.metric, -math.inf, -math.inf, inverted=True)
        low, high = METRICS[self.axis.metric].full_range  # these bound nothing
        if first > 1:
            low = self._least(first)
        if last < len(self) - 1:
            high = math.nextafter(self._least(last + 1), -math.inf)
        return ValueRange(self.axis.metric, low, high, inverted=first == 0)

    @property
    def _first(self) -> int:
        """The number of the first bin."""
        return 1 + self.axis.open_low

    def _least(self, at: int) -> float:
        """The least value that is counted in a cell or beyond it; not of the first that counts values.

        Counting rounds, so that a value beside the end of a bin may be counted on the end's other side.
        """
        axis, k = self.axis, at - self._first
        scale = self.bins / (axis.high - axis.low)
        value = axis.low + k / scale
        while (value - axis.low) * scale >= k:
            value = math.nextafter(value, -math.inf)
        while (value - axis.low) * scale < k:
            value = math.nextafter(value, math.inf)
        return value
