"""Directions of triangles and curves, and at their vertices."""

from __future__ import annotations

import numpy as np

from hexmend.boundary.classification import Boundary, NodeClass


def triangle_normals(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Unit normals (t, 3), 0 of a triangle without an area."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    return unit(np.cross(b - a, c - a))


def vertex_normals(vertices: np.ndarray, triangles: np.ndarray, patch: np.ndarray) -> np.ndarray:
    """Normals of a patch at the corners of its triangles, weighted by angles, (t, 3 corners, 3).

    After Thürmer and Wüthrich, "Computing vertex normals from polygonal facets" (1998): they do not depend on how a
    flat part is cut into triangles. A vertex of several patches has a normal in each.

    Parameters
    ----------
    vertices : (v, 3) float64
    triangles : (t, 3) int32
    patch : (t,) int
    """
    corners = vertices[triangles]
    one, other = (np.roll(corners, -k, axis=1) - corners for k in (1, 2))
    sine = np.linalg.norm(np.cross(one, other), axis=2)
    angle = np.arctan2(sine, np.einsum("tij,tij->ti", one, other))
    key = patch[:, None].astype(np.int64) * len(vertices) + triangles
    _, vertex = np.unique(key, return_inverse=True)
    share = angle[:, :, None] * triangle_normals(vertices, triangles)[:, None, :]
    sums = np.column_stack([np.bincount(vertex.ravel(), share[:, :, k].ravel()) for k in range(3)])
    return unit(sums)[vertex.reshape(triangles.shape)]


def segment_tangents(points: np.ndarray, segments: np.ndarray) -> np.ndarray:
    """Unit vectors from the first to the second node of segments, (s, 3)."""
    return unit(points[segments[:, 1]] - points[segments[:, 0]])


def curve_tangents(points: np.ndarray, boundary: Boundary) -> np.ndarray:
    """Tangents of curves at both nodes of their segments, in the sense of the segment, (s, 2 nodes, 3).

    At a node inside a curve along the line from the node before to the node after; at a corner along the segment.
    """
    own = segment_tangents(points, boundary.segments)
    tangents = np.repeat(own[:, None], 2, axis=1)
    ends = boundary.segments.ravel()
    at = np.flatnonzero(boundary.kind[ends] == NodeClass.CURVE)
    at = at[np.argsort(ends[at], kind="stable")].reshape(-1, 2)
    chord = unit(points[ends[at[:, 1] ^ 1]] - points[ends[at[:, 0] ^ 1]])
    for end in at.T:
        along = np.where(np.einsum("ij,ij->i", chord, own[end // 2]) < 0, -1.0, 1.0)
        tangents[end // 2, end % 2] = along[:, None] * chord
    return tangents


def unit(vectors: np.ndarray) -> np.ndarray:
    """Vectors (..., 3) with length 1, or 0 where they are 0."""
    size = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(size > 0, size, 1.0)
