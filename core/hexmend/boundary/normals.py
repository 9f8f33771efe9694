"""Normals of triangles and tangents of curves, at pieces and at vertices."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from hexmend.arrays import cross_products, row_norms
from hexmend.boundary.classification import Boundary, NodeClass
from hexmend.boundary.edges import segment_pairs
from hexmend.boundary.tolerances import ROUNDING
from hexmend.kernels import closest_point


class PieceDirections:
    """Directions of the triangles and segments of a surface, triangles first; each kind is computed when it is needed.

    Parameters
    ----------
    vertices : (v, 3) float64
    triangles : (t, 3) int32
    patch : (t,) int
        Patch number of each triangle.
    points : (n, 3) float64
        Nodes of the boundary.
    boundary : Boundary
        Its segments follow the triangles.
    """

    def __init__(
        self, vertices: np.ndarray, triangles: np.ndarray, patch: np.ndarray, points: np.ndarray, boundary: Boundary
    ):
        self.triangles = triangles
        self._vertices, self._patch, self._points, self._boundary = vertices, patch, points, boundary

    @cached_property
    def flat(self) -> np.ndarray:
        """Unit normal of each triangle and unit tangent of each segment, (t + s, 3); 0 where it has no extent."""
        tangents = segment_tangents(self._points, self._boundary.segments)
        return np.concatenate([triangle_normals(self._vertices, self.triangles), tangents])

    @cached_property
    def smooth(self) -> np.ndarray:
        """Unit normals and tangents at the corners of each triangle (a, b, c) and segment (a, b, b), (t + s, 3, 3)."""
        tangents = curve_tangents(self._points, self._boundary)[:, [0, 1, 1]]
        return np.concatenate([vertex_normals(self._vertices, self.triangles, self._patch), tangents])


def triangle_normals(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Unit normals of triangles, (t, 3), 0 for one without area."""
    a, b, c = (vertices.take(triangles[:, k], axis=0) for k in range(3))
    return unit_vectors(cross_products(b - a, c - a))


def vertex_normals(vertices: np.ndarray, triangles: np.ndarray, patch: np.ndarray) -> np.ndarray:
    """Compute angle-weighted vertex normals; a vertex of several patches has one in each.

    They do not depend on how a flat region is divided into triangles: Thürmer and Wüthrich, "Computing vertex normals
    from polygonal facets" (1998).

    Parameters
    ----------
    vertices : (v, 3) float64
    triangles : (t, 3) int32
    patch : (t,) int
        Patch number of each triangle.

    Returns
    -------
    (t, 3, 3) float64
        Unit normals at the three corners of each triangle.
    """
    normals = np.empty((3 * len(triangles), 3))
    triangles, patch = (np.ascontiguousarray(numbers, dtype=np.int32) for numbers in (triangles, patch))
    closest_point.vertex_normals(np.ascontiguousarray(vertices), triangles, patch, normals)
    return normals.reshape(-1, 3, 3)


def segment_tangents(points: np.ndarray, segments: np.ndarray) -> np.ndarray:
    """Unit vectors from the first to the second node of segments, (s, 3)."""
    return unit_vectors(points[segments[:, 1]] - points[segments[:, 0]])


def curve_tangents(points: np.ndarray, boundary: Boundary) -> np.ndarray:
    """Compute unit tangents of curves at the nodes of their segments.

    At a node inside a curve the tangent is parallel to the line between its neighbours, at a corner to the segment.

    Parameters
    ----------
    points : (n, 3) float64
    boundary : Boundary

    Returns
    -------
    (s, 2, 3) float64
        Tangents at both nodes of each segment, in its direction.
    """
    own = segment_tangents(points, boundary.segments)
    tangents = np.repeat(own[:, None], 2, axis=1)
    ends, at = boundary.segments.ravel(), segment_pairs(boundary.segments, boundary.node_class == NodeClass.CURVE)
    chord = unit_vectors(points[ends[at[:, 1] ^ 1]] - points[ends[at[:, 0] ^ 1]])
    for end in at.T:
        along = np.where(np.einsum("ij,ij->i", chord, own[end // 2]) < 0, -1.0, 1.0)
        tangents[end // 2, end % 2] = along[:, None] * chord
    return tangents


def unit_vectors(vectors: np.ndarray) -> np.ndarray:
    """Normalise vectors (..., 3); those of length 0 stay 0."""
    size = row_norms(vectors)[..., None]
    return vectors / np.where(size > 0, size, 1.0)


def directions_of_means(means: np.ndarray, otherwise: np.ndarray) -> np.ndarray:
    """Normalise means of unit vectors, (k, 3); opposed vectors, whose mean is 0, have the directions `otherwise`."""
    size = row_norms(means)[:, None]
    return np.where(size > ROUNDING, means / np.maximum(size, ROUNDING), otherwise)
