"""Heights of layers that are fitted to one first height of the wall."""

from __future__ import annotations

import numpy as np

from hexmend.layers.walls import Layers, Wall

#: Factor by which first heights may differ from the wall's, and the share of columns within it, for a fit.
_MAX_FACTOR, _MIN_SHARE = 2.0, 0.9
#: Range of the factor, from layer to layer, by which heights of a column are changed.
_LEAST, _GREATEST = 0.8, 1.25
#: Bisections for that factor.
_BISECTIONS = 60


def fitted_lengths(lengths: np.ndarray, layers: Layers) -> np.ndarray:
    """Give the layers on each wall one first height; growth makes up for it, so that stacks keep their thickness.

    The first height of a wall is that which most columns have. Columns that were squeezed, such as those over a bump,
    get it too, and grow faster or more slowly than the others. A wall whose first heights differ by more than a factor
    of two has no such height: its layers stay as they are.

    Parameters
    ----------
    lengths : (m, 3) float64
        Lengths of all hexes.
    layers : Layers

    Returns
    -------
    (m, 3) float64
    """
    lengths = lengths.copy()
    for wall in layers.walls:
        heights = _fitted_heights(wall.of(lengths))
        there = wall.hexes >= 0
        lengths[wall.hexes[there], wall.faces[there] // 2] = heights[there]
    return lengths


def first_height(wall: Wall, lengths: np.ndarray) -> float:
    """Height of a wall's first layer that most columns have, in the unit of the lengths (m, 3) of all hexes."""
    return _mode(wall.of(lengths)[:, 0])


def _fitted_heights(heights: np.ndarray) -> np.ndarray:
    """Heights (w, k), NaN where columns have ended, with one first height, and with their sums as before."""
    wanted = _mode(heights[:, 0]) / heights[:, 0]
    if np.mean(np.abs(np.log(wanted)) < np.log(_MAX_FACTOR)) < _MIN_SHARE:
        return heights
    number = np.arange(heights.shape[1])
    total = np.nansum(heights, axis=1)
    low, high = np.full(len(heights), _LEAST), np.full(len(heights), _GREATEST)
    for _ in range(_BISECTIONS):
        factor = np.sqrt(low * high)
        above = np.nansum(heights * wanted[:, None] * factor[:, None] ** number, axis=1) > total
        low, high = np.where(above, low, factor), np.where(above, factor, high)
    fits = (low > _LEAST) & (high < _GREATEST)
    return np.where(fits[:, None], heights * wanted[:, None] * factor[:, None] ** number, heights)


def _mode(values: np.ndarray) -> float:
    """The value around which most of some positive values lie, by halving their sample to its narrowest part."""
    logs = np.sort(np.log(values))
    while logs.size > 2:
        half = (logs.size + 1) // 2
        widths = logs[half - 1 :] - logs[: logs.size - half + 1]
        begin = int(widths.argmin())
        logs = logs[begin : begin + half]
    return float(np.exp(logs.mean()))
