"""Closest points on triangles and segments, found by a bounding-box tree for each group of them.

Points of a surface that were near samples before: they tell which samples cannot be far from it now.
"""

from __future__ import annotations

import copy
from dataclasses import dataclass

import numpy as np

from hexmend.errors import MeshError
from hexmend.kernels import closest_point, incidence
from hexmend.mesh.fields import as_set
from hexmend.mesh.size_limits import MAX_COORDINATE
from hexmend.mesh.validation import as_faces, as_points, points_like


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


@dataclass(frozen=True, eq=False)
class ClosestPoints:
    """Closest points and the triangles or segments on which they lie.

    Parameters
    ----------
    points : (k, 3) float64
        Positions of the closest points.
    pieces : (k,) int32
        Number of the triangle or segment of each.
    weights : (k, 3) float64
        Barycentric coordinates of each with respect to the corners of its piece.
    """

    points: np.ndarray
    pieces: np.ndarray
    weights: np.ndarray

    def rows(self, which: np.ndarray) -> ClosestPoints:
        """Return those of some rows, (j,) int or (k,) bool."""
        return ClosestPoints(self.points[which], self.pieces[which], self.weights[which])


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
        start, order = incidence.grouped(group.astype(np.int32), int(group.max(initial=-1)) + 1)
        pieces = np.ascontiguousarray(pieces.take(order, axis=0), dtype=np.int32)
        within, self.boxes, self.links, self.roots = closest_point.build_trees(points, pieces, start)
        self.points, self.pieces, self.order = points, pieces.take(within, axis=0), order.take(within).astype(np.int64)

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

    def closest(
        self, x: np.ndarray, group: np.ndarray, stop_distance: float = 0.0, known: np.ndarray | None = None
    ) -> ClosestPoints:
        """Find the point of a group that is closest to each given point.

        Parameters
        ----------
        x : (k, 3) float64
        group : (k,) int
            Group to be searched for each point.
        stop_distance : float
            The search ends at any point within this distance.
        known : (k,) int32, optional
            Piece of the group that is near to each point, and shortens the search; -1 for none.

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
        piece = np.full(len(x), -1, dtype=np.int32) if known is None else known.copy()
        places, weights = np.empty_like(x), np.empty_like(x)
        closest_point.closest(self.box_trees, x, self.roots[group], stop_distance, piece, places, weights)
        return _found(x, ClosestPoints(places, piece, weights))


class ClosestPointCache:
    """Closest points of points that move little from one query to the next.

    The pieces nearest to each are kept. They prove in most queries which point is the closest, so that the tree is not
    searched; what is found does not depend on them.

    Parameters
    ----------
    trees : ClosestPointTrees
    group : (s,) int
        Group of the point in each slot.

    Attributes
    ----------
    kernel : hexmend.kernels.closest_point.ClosestPointCache
    """

    def __init__(self, trees: ClosestPointTrees, group: np.ndarray):
        self._set(trees, trees.roots[as_set(group, "group", len(trees.roots))])

    def _set(self, trees: ClosestPointTrees, roots: np.ndarray) -> None:
        self._trees, self._roots = trees, roots
        self.kernel = closest_point.ClosestPointCache(trees.box_trees, roots)
        self._slots = np.arange(len(roots), dtype=np.int32)

    def __getstate__(self) -> tuple[ClosestPointTrees, np.ndarray]:
        return self._trees, self._roots

    def __setstate__(self, state: tuple[ClosestPointTrees, np.ndarray]) -> None:
        self._set(*state)  # the pieces are found again

    def closest(self, x: np.ndarray, slots: np.ndarray | None = None) -> ClosestPoints:
        """Find the points of their groups that are closest to the points in some slots.

        Parameters
        ----------
        x : (k, 3) float64
            Present positions of these points.
        slots : (k,) int32, optional
            All slots by default.

        Returns
        -------
        ClosestPoints

        Raises
        ------
        MeshError
            See `ClosestPointTrees.closest`.
        """
        x = as_points(x, "places")
        slots = self._slots if slots is None else slots
        if len(slots) != len(x):
            raise MeshError(f"there are {len(x)} places: expected one for each of {len(slots)} slots")
        found = ClosestPoints(np.empty_like(x), np.empty(len(x), dtype=np.int32), np.empty_like(x))
        self.kernel.closest(slots, x, found.pieces, found.points, found.weights)
        return _found(x, found)


def _found(x: np.ndarray, found: ClosestPoints) -> ClosestPoints:
    """Return what was found for points x (k, 3); raise `MeshError` if a point has no closest one."""
    if len(x) and found.pieces.min() < 0:
        wrong = x[np.flatnonzero(found.pieces < 0)[0]].tolist()
        raise MeshError(f"nothing is closest to the point {wrong}: expected finite numbers, below {MAX_COORDINATE:g}")
    return found


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
    return vertices_of(points, faces), around.reshape(-1, 3).astype(np.int32), np.repeat(np.arange(len(faces)), 4)


def vertices_of(points: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Return the vertices that `triangulate` does, (v, 3)."""
    if faces.shape[1] == 3:
        return np.ascontiguousarray(points)
    vertices = np.empty((len(points) + len(faces), 3))
    vertices[: len(points)] = points
    vertices[len(points) :] = means(points, faces)
    return vertices


def means(points: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    """Return the mean of the four points (n, 3) of each row of nodes (k, 4) int32, which must exist, (k, 3)."""
    x = np.empty((len(nodes), 3))
    closest_point.means(points, nodes, x)
    return x
