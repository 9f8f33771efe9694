"""Distributions of the histogram, at the start, now and of snapshots, on one axis."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import DEFAULT_BINS, Distribution, distribute
from hexmend_app.features.histogram.outline import Gradient, Series
from hexmend_app.theme.palette import BLUE, GREY, KEPT
from hexmend_app.translation import tr


class Distributions:
    """Distributions of a metric, on an axis that fits the values at the start.

    Attributes
    ----------
    axis : Axis
    current : Distribution or None
    inside : int
        Number of hexes of now that are invalid inside.
    snapshots : list of (slot, name, Distribution)
    gradient : Gradient
        Colours of the view along the axis; () if they show something else.
    """

    def __init__(self) -> None:
        self.axis = Axis("q")
        self.gradient: Gradient = ()
        self._bins = DEFAULT_BINS
        self._clear()

    def reset(self, metric: str) -> None:
        """Remove all distributions and change the metric."""
        self._clear()
        self.axis = Axis.fitted(metric, np.empty(0), np.empty(0, bool))

    def set_bins(self, bins: int) -> None:
        """Change the number of bins."""
        self._bins = bins
        self._recount()

    def set_initial(self, values: np.ndarray, inverted: np.ndarray) -> None:
        """Set the distribution at the start, and fit the axis to it.

        Parameters
        ----------
        values : (m,) float64
        inverted : (m,) bool

        Raises
        ------
        ValueError
            If the arrays differ in shape.
        """
        self._initial = self._count(values, inverted)
        axis = Axis.fitted(self.axis.metric, self._initial.values, self._initial.is_inverted)
        if axis != self.axis:
            self.axis = axis
            self._recount()

    def set_current(self, values: np.ndarray, inverted: np.ndarray, inside: int = 0) -> None:
        """Set the distribution of now, and the number of hexes that are invalid inside; see `set_initial`."""
        self.current, self.inside = self._count(values, inverted), inside

    def set_snapshots(self, snapshots: Sequence[tuple[int, str, np.ndarray, np.ndarray]]) -> None:
        """Set the distributions of snapshots, and count only those with new values.

        Parameters
        ----------
        snapshots : sequence of (slot, name, values, inverted)
            Arrays as in `set_initial`.
        """
        before = {slot: distribution for slot, _, distribution in self.snapshots}
        self.snapshots: list[tuple[int, str, Distribution]] = []
        for slot, name, values, inverted in snapshots:
            distribution = before.get(slot)
            if distribution is None or distribution.values is not values:
                distribution = self._count(values, inverted)
            self.snapshots.append((slot, name, distribution))

    def series(self) -> list[Series]:
        """Return the distributions as they are drawn, in the order of the legend.

        Where that of now has the colours of the view, which are opaque, that of the start is an outline over it.
        """
        series, coloured = [], bool(self.gradient)
        if self._initial is not None:
            series.append(Series("start", tr("at the start"), GREY, self._initial, filled=not coloured))
        if self.current is not None:
            now = Series("now", tr("now"), BLUE, self.current, filled=True, current=True, gradient=self.gradient)
            series.insert(0 if coloured else len(series), now)
        return series + [Series(str(slot), name, KEPT[slot], counts) for slot, name, counts in self.snapshots]

    def _clear(self) -> None:
        self._initial = self.current = None
        self.inside = 0
        self.snapshots = []

    def _count(self, values: np.ndarray, inverted: np.ndarray) -> Distribution:
        return distribute(values, inverted, self.axis, self._bins)

    def _recounted(self, distribution: Distribution | None) -> Distribution | None:
        return distribution and self._count(distribution.values, distribution.is_inverted)

    def _recount(self) -> None:
        self._initial, self.current = self._recounted(self._initial), self._recounted(self.current)
        self.snapshots = [(slot, name, self._recounted(counts)) for slot, name, counts in self.snapshots]
