"""The mean length of the edges of a mesh: the unit in which moves and tolerances are counted."""

from __future__ import annotations

import numpy as np

from hexmend.kernels import elements
from hexmend.mesh.hexahedron import EDGES
from hexmend.mesh.validation import as_hexes, as_points

#: By what factor the longest edges may raise the mean length of all.
SPOILED = 4.0
#: In how many hexes, about, it is looked for that.
_LOOKED_AT = 10_000


def mean_edge_length(points: np.ndarray, hexes: np.ndarray) -> float:
    """Mean length of the edges of hexes, each counted once a hex; the longest are left out where they spoil it.

    That is where it is more than `SPOILED` times the mean of all but the longest tenth: one node far away makes edges
    so long that in their mean all others would have no length.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> mean_edge_length(2 * UNIT_CUBE, np.arange(8, dtype=np.int32)[None])
    2.0
    """
    points = as_points(points)
    hexes = as_hexes(hexes, len(points))
    if not len(hexes):
        return 0.0
    mean = elements.mean_edge_length(points, hexes)
    usual = _usual(points, hexes)
    return usual if mean > SPOILED * usual > 0 else mean


def _usual(points: np.ndarray, hexes: np.ndarray) -> float:
    """Mean length of the edges of hexes without the longest tenth; of many hexes some are looked at."""
    ends = points[hexes[:: len(hexes) // _LOOKED_AT + 1]][:, EDGES]
    with np.errstate(over="ignore"):
        lengths = np.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=2).ravel()
    kept = lengths.size - lengths.size // 10
    return float(np.partition(lengths, kept - 1)[:kept].mean())
