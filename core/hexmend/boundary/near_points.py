"""Points of a surface that were near samples before: they tell which samples cannot be far from it now."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import row_norms
from hexmend.boundary.closest_point import ClosestPoints, ClosestPointTrees
from hexmend.kernels import closest_point


class NearPoints:
    """Points of trees that were near samples before: they tell which samples cannot be far away now, without a search.

    What is found does not depend on them.

    Parameters
    ----------
    count : int
        Number of samples.

    Attributes
    ----------
    pieces : (count,) int32
        Number of the piece on which the point near to each sample lies; -1 for none.
    """

    def __init__(self, count: int):
        self.pieces, self._weights = np.full(count, -1, dtype=np.int32), np.zeros((count, 3))
        self._points: np.ndarray | None = None  # of the trees on which `_places` lie
        self._places = np.empty((0, 3))

    def store(self, found: ClosestPoints) -> None:
        """Store the closest points of all samples."""
        self.pieces, self._weights, self._points = found.pieces.copy(), found.weights.copy(), None

    def beyond(
        self,
        trees: ClosestPointTrees,
        points: np.ndarray,
        x: np.ndarray,
        limits: np.ndarray,
        samples: np.ndarray | None = None,
    ) -> np.ndarray:
        """Find samples that are further than their limits from the first group of trees; stores the closest points.

        Parameters
        ----------
        trees : ClosestPointTrees
            Those of each call have the same pieces.
        points : (n, 3) float64
            Points of the trees; they are fitted to these only where a search is needed.
        x : (k, 3) float64
            Positions of the samples; finite.
        limits : (k,) float64
            Not negative.
        samples : (k,) int, optional
            Their numbers; all by default.

        Returns
        -------
        (k,) bool
        """
        some = slice(None) if samples is None else samples
        if points is trees.points:  # a surface that does not move: its pieces need not be read again
            distances = row_norms(x - self._places_on(trees)[some])
        else:
            distances, self._points = np.empty(len(x)), None
            closest_point.distances_from(points, trees.pieces, x, self.pieces[some], self._weights[some], distances)
        far = ~(distances <= limits)  # nothing is near a sample that is not finite
        doubtful = np.flatnonzero(far)
        if not doubtful.size:
            return far
        if points is not trees.points:
            trees = trees.with_points(points)
        known = doubtful if samples is None else samples[doubtful]
        pieces, places, weights = self.pieces[known], np.empty((doubtful.size, 3)), np.empty((doubtful.size, 3))
        found, limits = np.empty(doubtful.size), limits[doubtful]
        closest_point.near(trees.box_trees, x[doubtful], limits, pieces, places, weights, found)
        far[doubtful] = ~(found <= limits)
        self.pieces[known], self._weights[known] = pieces, weights
        if self._points is not None:
            self._places[known] = places
        return far

    def _places_on(self, trees: ClosestPointTrees) -> np.ndarray:
        """Return the positions of all points on trees, (count, 3); infinite where there is none."""
        if self._points is not trees.points:
            corners = trees.points[trees.pieces[self.pieces]]
            self._points, self._places = trees.points, np.einsum("ki,kij->kj", self._weights, corners)
            self._places[self.pieces < 0] = np.inf
        return self._places
