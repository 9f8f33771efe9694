"""Boundary nodes of a divided mesh that slide: every rank knows the positions of the whole boundary."""

from __future__ import annotations

import numpy as np

from hexmend.boundary.sliding import SlidingBoundary, SlidingNodes
from hexmend.energy import Motion
from hexmend.mesh.mesh import Mesh
from hexmend.ranks.rank_part import RankPart


class RankSliding:
    """Sliding nodes of a part; whether a move harms the boundary is judged for the whole boundary by each rank.

    All ranks call `rejected` together. The boundary is small: a mesh of ten million hexes has 280,000 faces there.

    Parameters
    ----------
    whole : SlidingNodes
        Of the nodes of the whole boundary alone; see `SlidingNodes.on_boundary`.
    numbers : (b,) int64
        Numbers of these nodes in the whole mesh, ascending.
    part : RankPart
        Part of the mesh with the boundary fixed.

    Attributes
    ----------
    mesh : Mesh
        The mesh of the part with the sliding nodes free.
    nodes : (k,) int64
        Sliding nodes of the part that this rank owns, ascending.
    motion : Motion
        Of the part; nodes on flat patches and straight curves are projected as others are.
    """

    def __init__(self, whole: SlidingNodes, numbers: np.ndarray, part: RankPart):
        self.whole, mesh, ranks = whole, part.mesh, part.ranks
        place = np.minimum(np.searchsorted(part.nodes, numbers), part.nodes.size - 1)
        self._in_part = np.where(part.nodes[place] == numbers, place, -1)  # of each node of the boundary
        here = np.flatnonzero(self._in_part >= 0)
        self._on_boundary = np.full(mesh.n_nodes, -1, dtype=np.int64)
        self._on_boundary[self._in_part[here]] = here
        slides = np.zeros(mesh.n_nodes, dtype=bool)
        moving = self._in_part[whole.nodes]
        slides[moving[moving >= 0]] = True
        self.nodes = np.flatnonzero(slides & part.owned)
        free = mesh.with_fixed(mesh.fixed & ~slides)
        free._set(mean_edge_length=mesh.mean_edge_length)
        self.mesh = free
        self._ranks = ranks
        self._own = here[part.owned[self._in_part[here]]]
        self._all = ranks.gather(self._own)
        sliding = np.concatenate([self.nodes, np.flatnonzero(slides & ~part.owned)])
        self.motion = Motion(free, self, sliding, part.owned, ranks)

    def with_points(self, points: np.ndarray) -> Mesh:
        """Return `mesh` with other points (n, 3) and the mean edge length of the whole mesh."""
        moved = self.mesh.with_points(points)
        moved._set(mean_edge_length=self.mesh.mean_edge_length)
        return moved

    def project(self, x: np.ndarray, nodes: np.ndarray) -> np.ndarray:
        """See `SlidingNodes.project`."""
        return self.whole.project(x, self._on_boundary[nodes])

    def tangent_bases(self, x: np.ndarray, nodes: np.ndarray) -> np.ndarray:
        """See `SlidingNodes.tangent_bases`."""
        return self.whole.tangent_bases(x, self._on_boundary[nodes])

    def rejected(self, before: np.ndarray, after: np.ndarray, changed: np.ndarray | None = None) -> np.ndarray | None:
        """Mark nodes of the part whose moves harm the boundary, (n,) bool; None if no rank has any.

        Parameters
        ----------
        before, after : (n, 3) float64
            Positions of the nodes of the part, in the mesh's unit.
        changed : (n,) bool, optional
            See `SlidingNodes.rejected_nodes`.
        """
        before, after = self._of_boundary(before), self._of_boundary(after)
        changed = None if changed is None else self._of_boundary(changed)
        marks = self.whole.rejected(before, after, changed)
        return None if marks is None else (self._on_boundary >= 0) & marks[self._on_boundary]

    def _of_boundary(self, rows: np.ndarray) -> np.ndarray:
        """Gather an array with a row for each node of the part, as one with a row for each node of the boundary."""
        gathered = np.empty((self._in_part.size, *rows.shape[1:]), rows.dtype)
        gathered[self._all] = self._ranks.gather(rows[self._in_part[self._own]])
        return gathered


def distribute_sliding(part: RankPart, sliding: SlidingBoundary | None) -> RankSliding:
    """Give all ranks the sliding nodes of the whole mesh that rank 0 has; the others give None."""
    whole, numbers = part.ranks.comm.bcast(None if sliding is None else sliding.on_boundary())
    return RankSliding(whole, numbers, part)
