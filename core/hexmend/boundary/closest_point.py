"""Closest points on triangles and segments, found by a bounding-box tree for each group of them."""

from __future__ import annotations

import copy
from dataclasses import dataclass

import numpy as np

from hexmend.errors import MeshError
from hexmend.kernels import closest_point
from hexmend.mesh.fields import as_set
from hexmend.mesh.validation import as_faces, as_points, points_like

#: Squares of coordinates beyond this overflow.
MAX_CLOSEST_COORDINATE = 1e150
#: Share of samples that may be too far away, beyond which all are checked anew.
_MAX_DOUBTFUL = 0.25


@dataclass(frozen=True, eq=False)
class ClosestPoints:
    """Closest points and the triangles or segments on which they lie.

    Parameters
    ----------
    places : (k, 3) float64
        Positions of the closest points.
    pieces : (k,) int32
        Number of the triangle or segment of each.
    weights : (k, 3) float64
        Barycentric coordinates of each with respect to the corners of its piece.
    """

    points: np.ndarray
    pieces: np.ndarray
    weights: np.ndarray


class ClosestPointTrees:
    """Bounding-box trees of groups of triangles and segments ("pieces").

    Parameters
    ----------
    points : (n, 3) float64
    pieces : (k, 3) int32
        Triangles (a, b, c), and segments as (a, b, b).
    group : (k,) int
        Group of each piece, from 0; no group is empty.

    Attributes
    ----------
    order : (k,) int64
        Number in the given `pieces` of each piece as `ClosestPoints.pieces` numbers them.
    points, pieces, boxes, links, roots
        Arguments of `hexmend.kernels.closest_point`.

    Raises
    ------
    MeshError
        For arrays of another shape or type, and for a point that does not exist.
    """

    def __init__(self, points: np.ndarray, pieces: np.ndarray, group: np.ndarray):
        points = as_points(points)
        pieces = as_faces(pieces, len(points))
        group = as_set(group, "group", len(pieces))
        if pieces.shape[1] != 3 or len(group) != len(pieces):
            raise MeshError(
                f"pieces have shape {pieces.shape} and group {group.shape}: expected (k, 3), and a group for each"
            )
        order = np.argsort(group, kind="stable")
        start = np.searchsorted(group[order], np.arange(group.max(initial=-1) + 2)).astype(np.int32)
        pieces = np.ascontiguousarray(pieces[order], dtype=np.int32)
        within, self.boxes, self.links, self.roots = closest_point.build_trees(points, pieces, start)
        self.points, self.pieces, self.order = points, np.ascontiguousarray(pieces[within]), order[within]

    @property
    def box_trees(self) -> closest_point.BoxTrees:
        """The trees as kernels take them; a view, cheap to make."""
        return closest_point.BoxTrees(self.points, self.pieces, self.boxes, self.links)

    def with_points(self, points: np.ndarray) -> ClosestPointTrees:
        """Return trees of the same pieces with other points (n, 3); fast if the points have moved little."""
        other, points = copy.copy(self), points_like(points, self.points.shape)
        other.points, other.boxes = points, np.empty_like(self.boxes)
        closest_point.refit(points, self.pieces, self.links, other.boxes)
        return other

    def closest(self, x: np.ndarray, group: np.ndarray, stop_distance: float = 0.0) -> ClosestPoints:
        """Find the point of a group that is closest to each given point.

        Parameters
        ----------
        x : (k, 3) float64
        group : (k,) int
            Group to be searched for each point.
        stop_distance : float
            The search ends at any point within this distance.

        Returns
        -------
        ClosestPoints

        Raises
        ------
        MeshError
            For coordinates that are not finite or exceed `MAX_COORDINATE`, and for arrays of another shape or type.
        """
        x = as_points(x, "places")
        group = as_set(group, "group", len(self.roots))
        if len(group) != len(x):
            raise MeshError(f"there are {len(group)} groups: expected one for each of {len(x)} places")
        piece, places, weights = np.empty(len(x), dtype=np.int32), np.empty_like(x), np.empty_like(x)
        closest_point.closest(self.box_trees, x, self.roots[group], stop_distance, piece, places, weights)
        if len(piece) and piece.min() < 0:
            wrong = x[np.flatnonzero(piece < 0)[0]].tolist()
            raise MeshError(
                f"nothing is closest to the point {wrong}: expected finite numbers, below {MAX_CLOSEST_COORDINATE:g}"
            )
        return ClosestPoints(places, piece, weights)


class NearPoints:
    """Points of trees that were near samples before: they tell which samples cannot be far away now, without a search.

    What is found does not depend on them. A sample is at most as far away as it was at the last full check, plus the
    moves since then of the sample and of the piece on which the point near to it lies.

    Parameters
    ----------
    count : int
        Number of samples.
    """

    def __init__(self, count: int):
        self._pieces, self._weights = np.full(count, -1, dtype=np.int32), np.zeros((count, 3))
        self._distances = np.full(count, np.inf)
        self._x: np.ndarray | None = None  # samples and points of the trees at the last full check
        self._points = np.empty((0, 3))

    def store(self, found: ClosestPoints) -> None:
        """Store the closest points of all samples."""
        self._pieces, self._weights = found.pieces.copy(), found.weights.copy()

    def beyond(
        self, trees: ClosestPointTrees, x: np.ndarray, samples: np.ndarray | None, limits: np.ndarray
    ) -> np.ndarray:
        """Find samples that are further than their limits from the first group of trees.

        Parameters
        ----------
        trees : ClosestPointTrees
            Those of each call have the same pieces, at any points.
        x : (k, 3) float64
            Positions of the samples; finite. The same array means the same positions.
        samples : (k,) int or None
            Their numbers; None for all.
        limits : (k,) float64
            Not negative.

        Returns
        -------
        (k,) bool
        """
        if samples is not None:
            return self._distances_of(trees, x, samples, limits) > limits
        if self._x is not None:
            bounds = self._bounds(trees, x)
            doubtful = np.flatnonzero(bounds > limits)
            if len(doubtful) < _MAX_DOUBTFUL * len(x):
                far = np.zeros(len(x), dtype=bool)
                far[doubtful] = self._distances_of(trees, x[doubtful], doubtful, limits[doubtful]) > limits[doubtful]
                return far
        self._distances = self._distances_of(trees, x, None, limits)
        self._x, self._points = x, trees.points
        return self._distances > limits

    def _bounds(self, trees: ClosestPointTrees, x: np.ndarray) -> np.ndarray:
        """Return upper bounds of the distances of all samples, (k,)."""
        moves = np.linalg.norm(trees.points - self._points, axis=1)[trees.pieces].max(axis=1)
        bounds = self._distances + moves[self._pieces]
        return bounds if x is self._x else bounds + np.linalg.norm(x - self._x, axis=1)

    def _distances_of(
        self, trees: ClosestPointTrees, x: np.ndarray, samples: np.ndarray | None, limits: np.ndarray
    ) -> np.ndarray:
        """Return distances of samples, exact where they exceed their limits; store the points near to them."""
        pieces, weights = self._pieces, self._weights
        if samples is not None:
            pieces, weights = pieces[samples], weights[samples]
        distances, before = np.empty(len(x)), pieces.copy()
        closest_point.near(trees.box_trees, x, np.ascontiguousarray(limits), pieces, weights, distances)
        if samples is not None:
            self._pieces[samples], self._weights[samples] = pieces, weights
            self._distances[samples[pieces != before]] = np.inf  # not known at the points of the last full check
        return distances


def triangulate(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Divide quads into four triangles around their centres, so that no diagonal is preferred; triangles stay.

    Parameters
    ----------
    points : (n, 3) float64
    faces : (k, 4) or (k, 3) int32

    Returns
    -------
    vertices : (v, 3) float64
        The points, then the centres of quads.
    triangles : (t, 3) int32
    face : (t,) int64
        Number of the face of each triangle.
    """
    if faces.shape[1] == 3:
        return np.ascontiguousarray(points), faces, np.arange(len(faces))
    middle = len(points) + np.arange(len(faces), dtype=np.int32)
    around = np.stack([faces, np.roll(faces, -1, axis=1), np.repeat(middle[:, None], 4, axis=1)], axis=-1)
    vertices = np.concatenate([points, points[faces].mean(axis=1)])
    return vertices, around.reshape(-1, 3).astype(np.int32), np.repeat(np.arange(len(faces)), 4)
