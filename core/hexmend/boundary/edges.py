"""Edges of the faces of a surface, their incidences, and components and chains connected by them."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from hexmend.kernels import closest_point
from hexmend.mesh.topology.components import components


class SurfaceEdges:
    """Unique edges of the faces of a surface.

    Parameters
    ----------
    faces : (k, w) int32
        Nodes of each face in order; successive nodes may be equal.
    n : int
        Number of nodes.

    Attributes
    ----------
    key : (e,) int64
        Unique number of each edge, ascending.
    nodes : (e, 2) int32
        Lower node first.
    count : (e,) int64
        Number of faces at each edge.
    first_sides : (e,) int32
        A side on each edge: k * w + i is that of face k from its node i to the next.
    neighbours : (e, 2) int64
        Two of these faces; an edge of one face names it twice.
    opposed : (e,) bool
        True if these two traverse the edge in opposite directions, as consistently oriented faces do.
    """

    def __init__(self, faces: np.ndarray, n: int):
        self.faces, self.n = faces, n
        width, corners = faces.shape[1], np.ascontiguousarray(faces, dtype=np.int32).ravel()
        self.nodes, self._sides, self._first = closest_point.edges_of_faces(corners, width, n)
        self.key, self.count = edge_keys(self.nodes, n), np.diff(self._first).astype(np.int64)
        first = self._first[:-1]
        self.first_sides = self._sides[first]
        pair = self.first_sides, self._sides[first + (self.count > 1)]
        self.neighbours = np.stack([side // width for side in pair], axis=1).astype(np.int64)
        self.opposed = corners[pair[0]] != corners[pair[1]]

    def keys_of(self, edges: np.ndarray) -> np.ndarray:
        """Return the unique number of each edge (m, 2), whatever its direction, (m,) int64."""
        return edge_keys(edges, self.n)

    @cached_property
    def fans(self) -> np.ndarray:
        """Number of fans (faces connected by edges) at each node, (n,) int32.

        1 where the surface around the node is a disc, more where sheets touch at it, 0 where there is no face.
        """
        faces = np.ascontiguousarray(self.faces, dtype=np.int32)
        return closest_point.count_fans(faces.ravel(), faces.shape[1], self._sides, self._first, self.n)


def edge_keys(edges: np.ndarray, n: int) -> np.ndarray:
    """Return the unique number of each edge (..., 2) of n nodes, whatever its direction, (...) int64."""
    one, other = np.moveaxis(np.asarray(edges), -1, 0)
    return np.minimum(one, other).astype(np.int64) * n + np.maximum(one, other)  # np.sort takes ten times as long


def segment_pairs(segments: np.ndarray, between: np.ndarray) -> np.ndarray:
    """Find the two segments that meet at each of some nodes, in the order of the nodes.

    Parameters
    ----------
    segments : (s, 2) int32
    between : (n,) bool
        True for nodes at which exactly two segments meet.

    Returns
    -------
    (j, 2) int64
        Ends of segments, numbered as `segments.ravel()`: end e is that of segment e // 2, whose other end is e ^ 1.
    """
    ends = segments.ravel()
    at = np.flatnonzero(between[ends])
    return at[np.argsort(ends[at], kind="stable")].reshape(-1, 2)


def chains(segments: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Group segments into chains that run through nodes at which no chain ends.

    Parameters
    ----------
    segments : (s, 2) int32
    ends : (n,) bool
        True for nodes at which chains end; exactly two segments meet at every other node.

    Returns
    -------
    (s,) int32
        Chain number of each segment, from 0.
    """
    return components(len(segments), segment_pairs(segments, ~ends) // 2)
