"""Where a sliding boundary and its surface are apart, followed as nodes move."""

from __future__ import annotations

import copy

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.optimise.maxmin.linear_program import LinearConstraints, lower_bounds


class DeviationTracker:
    """How far the surface's edges, faces and nodes are from a boundary that has moved.

    As nodes move, only those are looked at anew whose closest place has moved; that of the others is still there, so
    that they are no further than it is.

    Parameters
    ----------
    sliding : SlidingBoundary
    points : (n, 3) float64

    Attributes
    ----------
    distances : (s,)
        The distances: see `SlidingBoundary.behind`.
    """

    def __init__(self, sliding: SlidingBoundary, points: np.ndarray):
        self.sliding, self.points = sliding, points
        far, self._nodes, self._weights = sliding.behind_at_first
        self.distances, self._away = far.copy(), np.zeros((far.size, 3))
        self._update(np.arange(far.size))

    def after_move(self, points: np.ndarray, nodes: np.ndarray) -> DeviationTracker:
        """The same with nodes (k,) elsewhere, all others being where they were."""
        other = copy.copy(self)
        other.points = points
        other.distances, other._away = self.distances.copy(), self._away.copy()
        touched = np.zeros(len(points), dtype=bool)
        touched[nodes] = True
        other._update(np.flatnonzero(touched[self._nodes].any(axis=1)))
        return other

    def exceeds(self, before: DeviationTracker, nodes: np.ndarray, room: float) -> bool:
        """Whether boundary and surface are further apart than a room, and than they were before nodes (k,) moved."""
        if (self.distances > np.maximum(before.distances, room)).any():
            return True
        off = self.sliding.off(self.points, self.sliding.middles_at(nodes), room)
        if not off.which.size:
            return False
        was = self.sliding.off(before.points, off.which, room)
        if was.which.size < off.which.size:
            return True
        return bool((off.far > was.far).any())

    def bounds(self, moves: np.ndarray, room: float) -> LinearConstraints:
        """What keeps boundary and surface no further apart than a room; moves (n,) is how far each node may go."""
        sliding = self.sliding
        which = sliding.middles_at(np.flatnonzero(moves))
        off = sliding.off(self.points, which, room - moves[sliding.middles[which]].max(axis=1, initial=0.0))
        models = lower_bounds(off.nodes, room - off.far, -off.weights[:, :, None] * off.away[:, None])
        reach = moves[self._nodes].max(axis=1, initial=0.0)
        near = np.flatnonzero((reach > 0) & (self.distances > 0) & (self.distances + reach > room))
        slopes = self._weights[near, :, None] * self._away[near, None]
        return models.joined(lower_bounds(self._nodes[near], room - self.distances[near], slopes))

    def _update(self, which: np.ndarray) -> None:
        """Find what is closest to some places of the surface; of the boundary as it was at first that is known."""
        at_first, nodes, weights = self.sliding.behind_at_first
        off = self.sliding.behind(self.points, which, room=-1.0)
        self._nodes, self._weights = self._nodes.copy(), self._weights.copy()
        self.distances[which], self._away[which] = at_first[which], 0.0
        self._nodes[which], self._weights[which] = nodes[which], weights[which]
        self.distances[off.which], self._away[off.which] = off.far, off.away
        self._nodes[off.which], self._weights[off.which] = off.nodes, off.weights
