"""The distributions that the histogram draws: at the start, now, and as they were kept, over one axis."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import BINS, Distribution, distribute
from hexmend_app.features.histogram.outline import Series
from hexmend_app.theme.palette import KEPT
from hexmend_app.theme.style import BLUE, GREY


class Distributions:
    """Values of elements, counted in the bins of an axis that the values at the start are made for.

    Attributes
    ----------
    axis : Axis
    current : Distribution or None
    kept : list of (slot, name, Distribution)
    """

    def __init__(self) -> None:
        self.axis = Axis("q")
        self._bins = BINS
        self._clear()

    def begin(self, metric: str) -> None:
        """Have none, of another metric."""
        self._clear()
        self.axis = Axis.fitted(metric, np.empty(0), np.empty(0, bool))

    def divide(self, bins: int) -> None:
        """Count in another number of bins."""
        self._bins = bins
        self._recount()

    def set_initial(self, values: np.ndarray, inverted: np.ndarray) -> None:
        """Take the values (m,) and (m,) bool of the elements at the start, and fit the axis to them.

        Raises
        ------
        ValueError
            Where the two differ in shape.
        """
        self._initial = self._count(values, inverted)
        axis = Axis.fitted(self.axis.metric, self._initial.values, self._initial.is_inverted)
        if axis != self.axis:
            self.axis = axis
            self._recount()

    def set_current(self, values: np.ndarray, inverted: np.ndarray) -> None:
        """Take values (m,) and (m,) bool of the elements now; raises as `set_initial`."""
        self.current = self._count(values, inverted)

    def set_kept(self, kept: Sequence[tuple[int, str, np.ndarray, np.ndarray]]) -> None:
        """Take slots, names, values (m,) and (m,) bool of what is kept; what is known already is not counted again."""
        before = {slot: part for slot, _, part in self.kept}
        self.kept = []
        for slot, name, values, inverted in kept:
            part = before.get(slot)
            if part is None or part.values is not values:
                part = self._count(values, inverted)
            self.kept.append((slot, name, part))

    def series(self) -> list[Series]:
        """Return the distributions drawn, in the order of the legend."""
        drawn = []
        if self._initial is not None:
            drawn.append(Series("start", "at the start", GREY, self._initial, filled=True))
        if self.current is not None:
            drawn.append(Series("now", "now", BLUE, self.current, filled=True, current=True))
        return drawn + [Series(str(slot), name, KEPT[slot], part) for slot, name, part in self.kept]

    def _clear(self) -> None:
        self._initial: Distribution | None = None
        self.current: Distribution | None = None
        self.kept: list[tuple[int, str, Distribution]] = []

    def _count(self, values: np.ndarray, inverted: np.ndarray) -> Distribution:
        return distribute(values, inverted, self.axis, self._bins)

    def _again(self, part: Distribution | None) -> Distribution | None:
        return part and self._count(part.values, part.is_inverted)

    def _recount(self) -> None:
        self._initial, self.current = self._again(self._initial), self._again(self.current)
        self.kept = [(slot, name, self._again(part)) for slot, name, part in self.kept]
