"""Counts of hexes in the bins of the histogram."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.cells import Cells
from hexmend_app.picture.visibility import Show
from hexmend_app.scene.colour.value_range import within

#: Default, minimum and maximum number of bins.
DEFAULT_BINS, MIN_BINS, MAX_BINS = 50, 10, 200


@dataclass(frozen=True, eq=False)
class Distribution:
    """Distribution of the values of a metric over the hexes of a mesh.

    Parameters
    ----------
    values : (m,) float64
    is_inverted : (m,) bool
    axis : Axis
    counts : (bins,) int64
        Number of hexes in each bin that are not inverted.
    inverted : int
        Number of inverted hexes.
    below, above : int
        Number of other hexes below and above the axis.
    """

    values: np.ndarray
    is_inverted: np.ndarray
    axis: Axis
    counts: np.ndarray
    inverted: int
    below: int
    above: int

    @property
    def total(self) -> int:
        """Number of hexes."""
        return len(self.values)

    @property
    def edges(self) -> np.ndarray:
        """Values at the ends of the bins, (bins + 1,) float64."""
        return np.linspace(self.axis.low, self.axis.high, len(self.counts) + 1)

    @property
    def cells(self) -> Cells:
        """All bars and bins, from left to right."""
        return Cells(self.axis, len(self.counts))

    def in_cell(self, cell: int) -> int:
        """Return the number of hexes in one of `cells`."""
        k = cell - self.cells.first_bin
        if cell == 0:
            return self.inverted
        if k < 0:
            return self.below
        return self.above if k == len(self.counts) else int(self.counts[k])

    def cumulated(self) -> Distribution:
        """Return the cumulative distribution: inverted hexes first, those above the axis last."""
        below = self.inverted + self.below
        counts = below + np.cumsum(self.counts)
        return Distribution(self.values, self.is_inverted, self.axis, counts, self.inverted, below, self.total)

    def within(self, range: Show) -> int:
        """Return the number of hexes in a range of the axis' metric."""
        return int(np.count_nonzero(within(self.values, self.is_inverted, range)))


def distribute(values: np.ndarray, inverted: np.ndarray, axis: Axis, bins: int = DEFAULT_BINS) -> Distribution:
    """Count hexes by value.

    Parameters
    ----------
    values : (m,) float
    inverted : (m,) bool
        Hexes that are counted in a separate bar.
    axis : Axis
    bins : int

    Raises
    ------
    ValueError
        If `values` and `inverted` differ in shape.

    Examples
    --------
    >>> counted = distribute(np.array([0.0, 0.011, 1.0, 0.3]), np.array([False, False, False, True]), Axis("q"))
    >>> counted.counts[[0, 49]].tolist(), counted.inverted
    ([2, 1], 1)
    """
    values, inverted = np.asarray(values, dtype=np.float64), np.asarray(inverted, dtype=bool)
    if values.ndim != 1 or values.shape != inverted.shape:
        raise ValueError(
            f"values have shape {values.shape} and inverted {inverted.shape}: expected 1-D arrays of the same length"
        )
    with np.errstate(invalid="ignore", over="ignore"):
        place = (values - axis.low) * (bins / (axis.high - axis.low))
    counted = place[~(inverted | np.isnan(place))]
    # One bin more at each end for the values beyond it.
    counts = np.bincount(np.clip(np.floor(counted), -1, bins).astype(np.int64) + 1, minlength=bins + 2)
    below, above = (int(counts[0]) if axis.open_low else 0), (int(counts[-1]) if axis.open_high else 0)
    counts[1] += counts[0] - below
    counts[-2] += counts[-1] - above
    return Distribution(values, inverted, axis, counts[1:-1], len(values) - len(counted), below, above)
