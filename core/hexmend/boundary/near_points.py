"""Points of a surface that were near samples before: they tell which samples cannot be far from it now."""

from __future__ import annotations

import numpy as np

from hexmend.boundary.closest_point import ClosestPoints, ClosestPointTrees
from hexmend.kernels import closest_point


class NearPoints:
    """Points of trees that were near samples before: they tell which samples cannot be far away now, without a search.

    What is found does not depend on them.

    Parameters
    ----------
    roots : (count,) int32
        Root of the tree that is searched for each sample.

    Attributes
    ----------
    roots : (count,) int32
    pieces : (count,) int32
        Number of the piece on which the point near to each sample lies; -1 for none.
    """

    def __init__(self, roots: np.ndarray):
        self.roots, count = roots, len(roots)
        self.pieces, self._weights = np.full(count, -1, dtype=np.int32), np.zeros((count, 3))
        self._points: np.ndarray | None = None  # of the trees on which `_places` lie
        self._places = np.empty((count, 3))

    def store(self, found: ClosestPoints) -> None:
        """Store the closest points of all samples."""
        self.pieces, self._weights, self._points = found.pieces.copy(), found.weights.copy(), None

    def means_beyond(
        self, trees: ClosestPointTrees, points: np.ndarray, nodes: np.ndarray, examined: np.ndarray, limits: np.ndarray
    ) -> np.ndarray:
        """Find samples that are further than their limits from their trees; stores the closest points.

        Parameters
        ----------
        trees : ClosestPointTrees
            Those of each call have the same pieces.
        points : (n, 3) float64
        nodes : (count, 4) int32
            Points whose mean is each sample.
        examined : (count,) bool
            Samples that are examined.
        limits : (count,) float64
            Not negative.

        Returns
        -------
        (count,) bool
            False for samples that are not examined.
        """
        self._move_places(trees)
        beyond = np.empty(len(nodes), dtype=bool)
        closest_point.means_beyond(trees.box_trees, points, nodes, examined, limits, self._kernel, beyond)
        return beyond

    def beyond_moving(
        self, trees: ClosestPointTrees, points: np.ndarray, x: np.ndarray, examined: np.ndarray, limits: np.ndarray
    ) -> np.ndarray:
        """Find samples that are further than their limits from trees whose points have moved; stores the closest ones.

        Parameters
        ----------
        trees : ClosestPointTrees
            Those of each call have the same pieces.
        points : (n, 3) float64
            Points of the trees; they are fitted to these only where a search is needed.
        x : (count, 3) float64
            Positions of all samples.
        examined : (count,) bool
            Samples that are examined.
        limits : (count,) float64
            Not negative.

        Returns
        -------
        (k,) int32
            Numbers of these samples, ascending.
        """
        self._points, boxes = None, np.empty_like(trees.boxes)
        moving = points, trees.pieces, trees.links, boxes
        return closest_point.samples_beyond(*moving, x, examined, limits, self._kernel)

    @property
    def _kernel(self) -> closest_point.NearPoints:
        return closest_point.NearPoints(self.pieces, self._weights, self._places, self.roots)

    def _move_places(self, trees: ClosestPointTrees) -> None:
        """Move the places of all points, (count, 3), with their pieces of trees; infinite where there is none."""
        if self._points is not trees.points:
            corners = trees.points[trees.pieces[self.pieces]]
            self._points, self._places = trees.points, np.einsum("ki,kij->kj", self._weights, corners)
            self._places[self.pieces < 0] = np.inf
