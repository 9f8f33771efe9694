"""The room around a surface in which a boundary that slides on it stays."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hexmend.boundary.comparison import SkinSurface

#: By what share of it a distance is off by rounding, and the least room, as a share of the diagonal.
_ROUNDING = 1e-9
NOBODY = np.empty(0, dtype=np.int64)


@dataclass(frozen=True, eq=False)
class Deviations:
    """Places where boundary and surface are apart.

    Parameters
    ----------
    which : (k,) int64
        Of those that were looked at, ascending.
    far : (k,)
        The distance of each from the closest place of the other.
    away : (k, 3)
        Unit vectors along which it grows: from the closest place to this one.
    nodes : (k, 4)
        Nodes of the boundary that make the place, or the closest one.
    weights : (k, 4)
        Theirs.
    """

    which: np.ndarray
    far: np.ndarray
    away: np.ndarray
    nodes: np.ndarray
    weights: np.ndarray


class Band:
    """How far a boundary and the surface that it slides on are from each other, both ways.

    Nodes are on the surface, but what lies between them cuts off its bends.

    Parameters
    ----------
    points : (n, 3) float64
        Where the boundary was.
    faces : (k, 4) int32
    start : (n, 3) float64
        Where it is before it slides, its nodes on the surface.
    target : SkinSurface or None
        The surface; None where it is the boundary as it was.
    room : float
        How far the two may be from each other, in the mesh's unit; 0 for no further than rounding leaves them apart.
    """

    def __init__(
        self, points: np.ndarray, faces: np.ndarray, start: np.ndarray, target: SkinSurface | None, room: float
    ):
        self.points, self._faces, self._start, self._given = points, faces, start, target
        corners = points[faces.ravel()]
        size = float(np.linalg.norm(np.ptp(corners, axis=0))) if corners.size else 0.0
        self.room = max(room, _ROUNDING * size)

    @cached_property
    def skin(self) -> SkinSurface:
        """The boundary as it was, as a whole."""
        return SkinSurface(self.points, self._faces)

    @property
    def target(self) -> SkinSurface:
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

    def off(self, points: np.ndarray, which: np.ndarray, room: float | np.ndarray = 0.0) -> Deviations:
        """Those of some `middles` that are further than a room from the surface.

        Parameters
        ----------
        points : (n, 3) float64
        which : (k,) int64
            Of `middles`.
        room : float or (k,) float64
            One for all, or one for each.
        """
        room = np.broadcast_to(room, which.shape)
        moved = (points - self._start)[self.middles[which]].mean(axis=1)
        may = self._off_at_first[which] + np.linalg.norm(moved, axis=1) > np.maximum(room, 0.0)
        which, room = which[may], room[may]
        x = points[self.middles[which]].mean(axis=1)
        far, away = _apart(x, self.target.closest(x, max(float(room.min(initial=np.inf)), 0.0)))
        out = far > room
        nodes = self.middles[which[out]]
        return Deviations(which[out], far[out], away[out], nodes, np.full(nodes.shape, 0.25))

    def behind(self, points: np.ndarray, which: np.ndarray | None = None, room: float | np.ndarray = 0.0) -> Deviations:
        """Those of the surface's nodes and middles that are further than a room from the boundary as it is now.

        Parameters
        ----------
        points : (n, 3) float64
        which : (k,) int64, optional
            Of them; all, if None.
        room : float or (k,) float64
            One for all, or one for each.
        """
        first, nodes, weights = self.behind_at_first
        if which is None:
            which = np.arange(len(first))
        room = np.broadcast_to(room, which.shape)
        moved = np.einsum("sk,ski->si", weights[which], (points - self._start)[nodes[which]])
        may = first[which] + np.linalg.norm(moved, axis=1) > np.maximum(room, 0.0)
        which, room = which[may], room[may]
        if not which.size:
            return Deviations(which, np.empty(0), np.empty((0, 3)), nodes[which], weights[which])
        x = self._samples[which]
        places, nodes, weights = self.skin.with_points(points).closest_on(x, max(float(room.min(initial=np.inf)), 0.0))
        far, away = _apart(x, places)
        out = far > room
        return Deviations(which[out], far[out], away[out], nodes[out], weights[out])

    def beyond(self, points: np.ndarray) -> np.ndarray:
        """The nodes at which the boundary has left its room, further than it was at first, (k,) int.

        Where it is far from a place of the surface these are the nodes that are closest to it, and that were at first.
        """
        if not np.isfinite(self.room):
            return NOBODY
        at_first, nodes, _ = self.behind_at_first
        off = self.off(points, np.arange(len(self.middles)), self._most(self._off_at_first))
        behind = self.behind(points, room=self._most(at_first))
        return np.unique(np.concatenate([one.ravel() for one in (off.nodes, behind.nodes, nodes[behind.which])]))

    def _most(self, at_first: np.ndarray) -> np.ndarray:
        return np.maximum(at_first, self.room) * (1 + _ROUNDING)

    @cached_property
    def _samples(self) -> np.ndarray:
        return self._start[self.middles].mean(axis=1) if self._given is None else self._given.samples()

    @cached_property
    def _off_at_first(self) -> np.ndarray:
        """How far `middles` are from the surface before anything slides, (s,)."""
        if self._given is None:
            return np.zeros(len(self.middles))
        return self.target.distances(self._start[self.middles].mean(axis=1))

    @cached_property
    def behind_at_first(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """How far the surface's nodes and middles are from the boundary before anything slides, (s,).

        Also the nodes and weights that make what is closest to them, (s, 4).
        """
        if self._given is None:
            return np.zeros(len(self.middles)), self.middles, np.full(self.middles.shape, 0.25)
        x = self._samples
        places, nodes, weights = self.skin.with_points(self._start).closest_on(x)
        return np.linalg.norm(x - places, axis=1), nodes, weights


def _apart(x: np.ndarray, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distances (k,) of x (k, 3) from other places, and the unit vectors from these to x (k, 3)."""
    away = x - places
    far = np.linalg.norm(away, axis=1)
    return far, away / np.maximum(far, np.finfo(float).tiny)[:, None]
