"""Distances of a surface from the boundary that slides on it, followed as nodes move."""

from __future__ import annotations

import copy

import numpy as np

from hexmend.arrays import largest_of_rows, mask
from hexmend.boundary import SlidingBoundary
from hexmend.mesh.topology.marked_rows import any_of_rows
from hexmend.optimise.maxmin.linear_program import LinearConstraints, lower_bounds


class DeviationTracker:
    """Distances of the surface's edges, faces and nodes from a boundary that has moved.

    Only distances whose closest point has moved are recomputed; the others remain valid upper bounds.

    Parameters
    ----------
    sliding : SlidingBoundary
    points : (n, 3) float64

    Attributes
    ----------
    distances : (s,) float64
        See `SlidingBoundary.surface_deviation`.
    """

    def __init__(self, sliding: SlidingBoundary, points: np.ndarray):
        self.sliding, self.points = sliding, points
        far, self._nodes, self._weights = sliding.initial_surface_deviation
        self.distances, self._away = far.copy(), np.zeros((far.size, 3))
        self._update(np.arange(far.size))

    def after_move(self, points: np.ndarray, nodes: np.ndarray) -> DeviationTracker:
        """A tracker of the boundary at points (n, 3), where only nodes (k,) have moved."""
        other = copy.copy(self)
        other.points = points
        other.distances, other._away = self.distances.copy(), self._away.copy()
        touched = mask(nodes, len(points))
        other._update(np.flatnonzero(any_of_rows(touched, self._nodes)))
        return other

    def exceeds(self, before: DeviationTracker, nodes: np.ndarray, max_deviation: float) -> bool:
        """Return True if a distance exceeds `max_deviation` and what it was before nodes (k,) moved."""
        if (self.distances > np.maximum(before.distances, max_deviation)).any():
            return True
        beyond = self.sliding.boundary_deviation(self.points, self.sliding.samples_at(nodes), max_deviation)
        if not beyond.indices.size:
            return False
        was = self.sliding.boundary_deviation(before.points, beyond.indices, max_deviation)
        if was.indices.size < beyond.indices.size:
            return True
        return bool((beyond.distances > was.distances).any())

    def bounds(self, moves: np.ndarray, max_deviation: float) -> LinearConstraints:
        """Constraints on the distances while each node moves by moves (n,) at most, in the mesh's unit."""
        sliding = self.sliding
        which = sliding.samples_at(np.flatnonzero(moves))
        beyond = sliding.boundary_deviation(
            self.points, which, max_deviation - largest_of_rows(moves, sliding.samples[which])
        )
        models = lower_bounds(
            beyond.nodes, max_deviation - beyond.distances, -beyond.weights[:, :, None] * beyond.directions[:, None]
        )
        reach = largest_of_rows(moves, self._nodes)
        near = np.flatnonzero((reach > 0) & (self.distances > 0) & (self.distances + reach > max_deviation))
        slopes = self._weights[near, :, None] * self._away[near, None]
        return models.concatenate(lower_bounds(self._nodes[near], max_deviation - self.distances[near], slopes))

    def _update(self, which: np.ndarray) -> None:
        """Find what is closest to some places of the surface, beginning with what was closest at first."""
        self._nodes, self._weights = self._nodes.copy(), self._weights.copy()
        into = self.distances, self._away, self._nodes, self._weights
        self.sliding.find_surface_distances(self.points, which, into)
