"""The room around a surface in which a boundary that slides on it stays."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from hexmend.surface.change import Skin

#: By what share of it a distance is off by rounding, and the least room, as a share of the diagonal.
_ROUNDING = 1e-9
NOBODY = np.empty(0, dtype=np.int64)


class Room:
    """How far a boundary and the surface that it slides on are from each other, both ways.

    Nodes are on the surface, but what lies between them cuts off its bends.

    Parameters
    ----------
    points : (n, 3) float64
        Where the boundary was.
    faces : (k, 4) int32
    start : (n, 3) float64
        Where it is before it slides, its nodes on the surface.
    target : Skin or None
        The surface; None where it is the boundary as it was.
    room : float
        How far the two may be from each other, in the mesh's unit.
    """

    def __init__(self, points: np.ndarray, faces: np.ndarray, start: np.ndarray, target: Skin | None, room: float):
        self.points, self.room, self._faces, self._start, self._given = points, room, faces, start, target

    @cached_property
    def skin(self) -> Skin:
        """The boundary as it was, as a whole."""
        return Skin(self.points, self._faces)

    @property
    def target(self) -> Skin:
        """The surface, as a whole."""
        return self._given or self.skin

    @cached_property
    def middles(self) -> np.ndarray:
        """Nodes whose means are the middles of the boundary's edges and faces, (s, 4) int: an edge's nodes twice."""
        nodes = np.tile(self.skin.nodes[:, None], 4)
        return np.concatenate([np.tile(self.skin.edges.nodes, 2), self._faces, nodes])

    def middles_at(self, nodes: np.ndarray) -> np.ndarray:
        """Which of `middles` move with some nodes, (k,) int64."""
        moved = np.zeros(len(self.points), dtype=bool)
        moved[nodes] = True
        return np.flatnonzero(moved[self.middles].any(axis=1))

    def off(self, points: np.ndarray, which: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """How far some of `middles` are from the surface, (k,), and the unit vectors that lead away from it, (k, 3)."""
        x = points[self.middles[which]].mean(axis=1)
        away = x - self.target.closest(x)
        far = np.linalg.norm(away, axis=1)
        return far, away / np.maximum(far, np.finfo(float).tiny)[:, None]

    def behind(
        self, points: np.ndarray, which: np.ndarray | slice = slice(None)
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """How far the surface's nodes and middles, or some of them, are from the boundary as it is now.

        Returns
        -------
        far : (s,)
        away : (s, 3)
            Unit vectors from the boundary to them.
        nodes, weights : (s, 4)
            What makes the closest places of the boundary.
        """
        x = self._samples[which]
        places, nodes, weights = self.skin.with_points(points).closest_on(x)
        far = np.linalg.norm(x - places, axis=1)
        return far, (x - places) / np.maximum(far, np.finfo(float).tiny)[:, None], nodes, weights

    def leaves_behind(self, points: np.ndarray, room: float) -> bool:
        """Whether the boundary may have left a place of the surface by more: not where nothing has moved that far."""
        return self._may_be_behind(points, max(room, 0.0)).size > 0

    def beyond(self, points: np.ndarray) -> np.ndarray:
        """The nodes at which the boundary has left its room, further than it was at first, (k,) int.

        Where it is far from a place of the surface these are the nodes that are closest to it, and that were at first.
        """
        if not np.isfinite(self.room):
            return NOBODY
        beyond = [NOBODY]
        which = self._may_be_off(points, self.room)
        if which.size:
            far = self.off(points, which)[0] > self._most(self._off_at_first[which])
            beyond.append(self.middles[which[far]].ravel())
        which = self._may_be_behind(points, self.room)
        if which.size:
            at_first, first, _ = self._behind_at_first
            distances, _, nodes, _ = self.behind(points, which)
            far = distances > self._most(at_first[which])
            beyond += [nodes[far].ravel(), first[which[far]].ravel()]
        return np.unique(np.concatenate(beyond))

    def _most(self, at_first: np.ndarray) -> np.ndarray:
        least = _ROUNDING * float(np.linalg.norm(np.ptp(self.points[self.skin.nodes], axis=0)))
        return np.maximum(np.maximum(at_first, self.room) * (1 + _ROUNDING), least)

    @cached_property
    def _samples(self) -> np.ndarray:
        return self._start[self.middles].mean(axis=1) if self._given is None else self._given.samples()

    @cached_property
    def _off_at_first(self) -> np.ndarray:
        """How far `middles` are from the surface before anything slides, (s,)."""
        count = len(self.middles)
        return np.zeros(count) if self._given is None else self.off(self._start, np.arange(count))[0]

    @cached_property
    def _behind_at_first(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The same of the surface's samples from the boundary; the nodes and weights that make what is closest."""
        if self._given is None:
            return np.zeros(len(self.middles)), self.middles, np.full(self.middles.shape, 0.25)
        far, _, nodes, weights = self.behind(self._start)
        return far, nodes, weights

    def _may_be_off(self, points: np.ndarray, room: float) -> np.ndarray:
        """Which of `middles` may be further than that from the surface: they have moved that far, (k,) int64."""
        moved = (points - self._start)[self.middles].mean(axis=1)
        return np.flatnonzero(self._off_at_first + np.linalg.norm(moved, axis=1) > room)

    def _may_be_behind(self, points: np.ndarray, room: float) -> np.ndarray:
        """Which samples of the surface may be as far from the boundary: what was closest has moved that far."""
        far, nodes, weights = self._behind_at_first
        moved = np.einsum("sk,ski->si", weights, (points - self._start)[nodes])
        return np.flatnonzero(far + np.linalg.norm(moved, axis=1) > room)
