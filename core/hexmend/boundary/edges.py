"""Edges of a surface's faces, who meets in them, and what hangs together by them."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from hexmend.mesh.components import components


class SurfaceEdges:
    """The edges of faces, each once.

    Parameters
    ----------
    faces : (k, w) int32
        Nodes of each face in order; two that follow each other may be one.
    n : int
        Number of nodes.

    Attributes
    ----------
    key : (e,) int64
        A number for each edge, ascending.
    nodes : (e, 2) int32
        Lower node first.
    count : (e,) int64
        Number of faces that meet in it.
    neighbours : (e, 2) int64
        Two of these faces; one face twice where there is but one.
    opposed : (e,) bool
        Whether these two run through the edge in opposite directions, as faces do that are seen from the same side.
    """

    def __init__(self, faces: np.ndarray, n: int):
        self.faces, self.n = faces, n
        width = faces.shape[1]
        ways = np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2)
        self._sides = np.flatnonzero(ways[:, 0] != ways[:, 1])
        ways = ways[self._sides]
        key = self.keys_of(ways)
        self._order = np.argsort(key, kind="stable")
        self.key, self._first, self.count = np.unique(key[self._order], return_index=True, return_counts=True)
        pair = self._order[self._first], self._order[self._first + (self.count > 1)]
        self.nodes = np.sort(ways[pair[0]], axis=1)
        self.neighbours = np.stack([self._sides[side] // width for side in pair], axis=1)
        self.opposed = ways[pair[0], 0] != ways[pair[1], 0]

    def keys_of(self, edges: np.ndarray) -> np.ndarray:
        """One number for each edge (m, 2), whatever its direction."""
        edges = np.sort(np.asarray(edges, dtype=np.int64), axis=1)
        return edges[:, 0] * self.n + edges[:, 1]

    @cached_property
    def fans(self) -> np.ndarray:
        """Into how many groups, each hanging together by edges, the faces at each node are parted, (n,) int64.

        1 where the surface is a disc around the node, more where sheets touch in it, 0 where there is no face.
        """
        width = self.faces.shape[1]
        # A corner of a face is known by its place in `faces`; those of one node are linked across each common edge.
        side = self._sides[self._order]
        after = side - side % width + (side + 1) % width
        ends = np.stack([side, after], axis=1)
        node = self.faces.ravel()[ends]
        ends = np.take_along_axis(ends, np.argsort(node, axis=1, kind="stable"), axis=1)  # lower node first
        same = np.ones(len(side), dtype=bool)
        same[self._first] = False
        follows = np.flatnonzero(same)
        links = np.concatenate([ends[follows - 1], ends[follows]], axis=1)
        # A face whose two corners are one node has one fan there.
        repeated = np.flatnonzero(self.faces.ravel() == np.roll(self.faces, -1, axis=1).ravel())
        ring = np.stack([repeated, repeated - repeated % width + (repeated + 1) % width], axis=1)
        group = components(self.faces.size, np.concatenate([links[:, [0, 2]], links[:, [1, 3]], ring]))
        _, representative = np.unique(group, return_index=True)
        return np.bincount(self.faces.ravel()[representative], minlength=self.n)


def chains(segments: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """The chain of each segment: those that follow each other through nodes at which no chain ends; (s,) int32.

    Parameters
    ----------
    segments : (s, 2) int32
    ends : (n,) bool
        True where chains end; two segments meet at every other node of theirs.
    """
    through = ~ends[segments.ravel()]
    at = np.flatnonzero(through)
    met = at[np.argsort(segments.ravel()[at], kind="stable")] // 2
    return components(len(segments), met.reshape(-1, 2))
