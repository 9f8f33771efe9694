"""Division of places among ranks by recursive bisection of coordinates (Berger and Bokhari 1987)."""

from __future__ import annotations

import numpy as np

from hexmend.energy.ranks import Ranks

#: Halvings of an interval in which a cut is searched.
_HALVINGS = 60


def bisect(ranks: Ranks, places: np.ndarray, count: int) -> np.ndarray:
    """Divide places, distributed over the ranks, into parts of about the same size; all ranks call it together.

    A set of places is cut across its longest extent, into shares for half the parts each, and so is each share.

    Parameters
    ----------
    ranks : Ranks
    places : (k, 3) float64
    count : int
        Number of parts.

    Returns
    -------
    (k,) int32
        Part of each place, from 0.

    Examples
    --------
    >>> from hexmend.energy.ranks import ONE_RANK
    >>> bisect(ONE_RANK, np.array([[0.0, 0, 0], [9, 0, 0], [1, 0, 0], [8, 1, 0]]), 2).tolist()
    [0, 1, 0, 1]
    """
    part = np.zeros(len(places), np.int32)
    waiting = [(np.arange(len(places)), 0, count)]
    while waiting:
        rows, first, parts = waiting.pop()
        if parts == 1:
            part[rows] = first
            continue
        here = places[rows]
        low = [ranks.least(float(x.min(initial=np.inf))) for x in here.T]
        high = [ranks.greatest(float(x.max(initial=-np.inf))) for x in here.T]
        axis, lower = int(np.argmax(np.subtract(high, low))), parts // 2
        wanted = ranks.sum(len(rows)) * lower / parts
        below = here[:, axis] <= _cut(ranks, here[:, axis], low[axis], high[axis], wanted)
        waiting += [(rows[below], first, lower), (rows[~below], first + lower, parts - lower)]
    return part


def _cut(ranks: Ranks, values: np.ndarray, low: float, high: float, wanted: float) -> float:
    """Find a number that about as many values of all ranks as are wanted are not greater than."""
    for _ in range(_HALVINGS):
        middle = low + (high - low) / 2
        if ranks.sum(int(np.count_nonzero(values <= middle))) < wanted:
            low = middle
        else:
            high = middle
    return high
