"""Boundary nodes of a divided mesh that slide: every rank knows the positions of the whole boundary."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np

from hexmend.arrays import differing_rows, index_of, mask
from hexmend.boundary.sliding import SlidingBoundary, SlidingNodes
from hexmend.energy import SQUARES, ObjectiveNorm, SlidingEnergy
from hexmend.mesh.mesh import Mesh
from hexmend.ranks.rank_energy import RankEnergy
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
    faceted : bool
        Nodes slide on curved patches or curves too, which have creases.

    Attributes
    ----------
    part : RankPart
        The part with the sliding nodes free.
    nodes : (k,) int64
        Sliding nodes of the part that this rank owns, ascending.
    ghosts : (g,) int64
        Other sliding nodes of the part, ascending.
    """

    def __init__(self, whole: SlidingNodes, numbers: np.ndarray, part: RankPart, faceted: bool):
        self.whole, self.faceted, mesh, ranks = whole, faceted, part.mesh, part.ranks
        place = np.minimum(np.searchsorted(part.nodes, numbers), part.nodes.size - 1)
        self._in_part = np.where(part.nodes[place] == numbers, place, -1)  # of each node of the boundary
        here = np.flatnonzero(self._in_part >= 0)
        self._on_boundary = np.full(mesh.n_nodes, -1, dtype=np.int64)
        self._on_boundary[self._in_part[here]] = here
        slides = np.zeros(mesh.n_nodes, dtype=bool)
        moving = self._in_part[whole.nodes]
        slides[moving[moving >= 0]] = True
        self.nodes, self.ghosts = np.flatnonzero(slides & part.owned), np.flatnonzero(slides & ~part.owned)
        free = mesh.with_fixed(mesh.fixed & ~slides)
        free._set(mean_edge_length=mesh.mean_edge_length)
        self.part = replace(part, mesh=free)
        self._ranks = ranks
        self._own = here[part.owned[self._in_part[here]]]
        self._all = ranks.gather(self._own)

    @property
    def mesh(self) -> Mesh:
        """The mesh of the part with the sliding nodes free."""
        return self.part.mesh

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

    def rejected(self, before: np.ndarray, after: np.ndarray, changed: np.ndarray | None) -> np.ndarray | None:
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
        nodes = self.whole.rejected_nodes(before, after, changed)
        nodes = nodes[differing_rows(before[nodes], after[nodes])]
        if not nodes.size:
            return None
        here = self._in_part[nodes]
        return mask(here[here >= 0], len(self._on_boundary))

    def _of_boundary(self, rows: np.ndarray) -> np.ndarray:
        """Gather an array with a row for each node of the part, as one with a row for each node of the boundary."""
        gathered = np.empty((self._in_part.size, *rows.shape[1:]), rows.dtype)
        gathered[self._all] = self._ranks.gather(rows[self._in_part[self._own]])
        return gathered


def distribute_sliding(part: RankPart, sliding: SlidingBoundary | None) -> RankSliding:
    """Give all ranks the sliding nodes of the whole mesh that rank 0 has; the others give None."""
    given = None if sliding is None else (*sliding.on_boundary(), sliding.curved_nodes.size > 0)
    whole, numbers, faceted = part.ranks.comm.bcast(given)
    return RankSliding(whole, numbers, part, faceted)


class RankSlidingEnergy(SlidingEnergy, RankEnergy):
    """Energy of a divided mesh whose boundary slides.

    Nodes on flat patches and straight curves are projected as others are.

    Parameters
    ----------
    sliding : RankSliding
    norm, omitted
        See `MeshEnergy`.
    """

    has_parts = False
    sliding: RankSliding

    def __init__(self, sliding: RankSliding, norm: ObjectiveNorm = SQUARES, omitted: np.ndarray | None = None):
        RankEnergy.__init__(self, sliding.part, norm, omitted)
        self._slide(sliding, sliding.nodes)
        self.faceted = sliding.faceted

    def moved(self, x: np.ndarray, step: np.ndarray, alpha: float = 1.0) -> np.ndarray:
        return self.ranks.complete(super().moved(x, step, alpha))

    def infeasible_nodes(
        self, x: np.ndarray, there: np.ndarray, changed: np.ndarray | None = None
    ) -> np.ndarray | None:
        return self.sliding.rejected(x * self.unit, there * self.unit, changed)

    def _with_ghosts(self, projectors: np.ndarray) -> np.ndarray:
        rows = np.concatenate([projectors, np.empty((self.sliding.ghosts.size, 3, 3))])
        self.ranks.exchange_of(index_of(self._sliding_here, self.mesh.n_nodes))(rows)
        return rows

    @property
    def _sliding_here(self) -> np.ndarray:
        """Sliding nodes of the part in the order of `projectors`, (k,) int64."""
        return np.concatenate([self.sliding_nodes, self.sliding.ghosts])

    @cached_property
    def sliding_slots(self) -> np.ndarray:
        return index_of(self.ordered_nodes.nodes, self.mesh.n_nodes)[self._sliding_here]
