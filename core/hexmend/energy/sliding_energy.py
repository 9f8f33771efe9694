"""Energy of a mesh whose boundary nodes slide on its surface."""

from __future__ import annotations

from functools import cached_property
from typing import Protocol

import numpy as np

from hexmend.arrays import differing_rows, index_of, mask, row_norms
from hexmend.boundary import SlidingBoundary
from hexmend.boundary.band import NO_NODES
from hexmend.boundary.tolerances import FLAT_DISTANCE
from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.hessian import Hessian
from hexmend.energy.mesh_energy import MeshEnergy
from hexmend.energy.norm import SQUARES, ObjectiveNorm
from hexmend.energy.sparsity import BlockSparsity
from hexmend.kernels import conjugate_gradients, sliding_surface
from hexmend.mesh.mesh import Mesh

#: Length of the probing step for directional derivatives, in mean edge lengths.
_PROBE_LENGTH = 1e-5
#: Share of a rising slope along the tangent up to which the slope after projection may rise.
_KEPT_RISE = 1.01


class Slides(Protocol):
    """Sliding nodes as an energy uses them; see `SlidingNodes`."""

    def project(self, x: np.ndarray, nodes: np.ndarray) -> np.ndarray:
        """Project positions (k, 3) of some sliding nodes (k,)."""

    def tangent_bases(self, x: np.ndarray, nodes: np.ndarray) -> np.ndarray:
        """Compute directions in which some sliding nodes (k,) at positions (k, 3) may move, (k, 3, 3)."""

    def rejected_nodes(self, before: np.ndarray, after: np.ndarray, changed: np.ndarray | None = None) -> np.ndarray:
        """Find nodes whose moves harm the boundary, (k,) int."""


class PartSliding:
    """Sliding nodes of a part of a mesh, whose other nodes stay.

    Parameters
    ----------
    whole : Slides
        Those of the mesh.
    nodes : (j,) int
        Numbers of the part's nodes in the mesh.
    points : (n, 3) float64
        Positions of all nodes of the mesh, in its unit of length.
    """

    def __init__(self, whole: Slides, nodes: np.ndarray, points: np.ndarray):
        self._whole, self._nodes, self._points = whole, nodes, points
        self._number = index_of(nodes, len(points))

    def project(self, x: np.ndarray, nodes: np.ndarray) -> np.ndarray:
        """See `Slides`."""
        return self._whole.project(x, self._nodes[nodes])

    def tangent_bases(self, x: np.ndarray, nodes: np.ndarray) -> np.ndarray:
        """See `Slides`."""
        return self._whole.tangent_bases(x, self._nodes[nodes])

    def rejected_nodes(self, before: np.ndarray, after: np.ndarray, changed: np.ndarray | None = None) -> np.ndarray:
        """See `Slides`."""
        marks = None if changed is None else mask(self._nodes[changed], len(self._points))
        rejected = self._number[self._whole.rejected_nodes(self._of_all(before), self._of_all(after), marks)]
        return rejected[rejected >= 0].astype(np.int64)

    def _of_all(self, points: np.ndarray) -> np.ndarray:
        """Return the positions of all nodes, (n, 3), with the nodes of the part at `points` (j, 3)."""
        merged = self._points.copy()
        merged[self._nodes] = points
        return merged


class SlidingEnergy(MeshEnergy):
    """Energy as a function of free nodes; free nodes of the boundary lie on their curves and patches.

    Derivatives are those along the surface: gradient and Hessian have no components off it, so that search directions
    are tangential. The contribution of the surface's curvature to the Hessian is left out. Moved nodes are projected
    back onto the surface.

    Parameters
    ----------
    sliding : SlidingBoundary
    norm, omitted
        See `MeshEnergy`.
    flat_is_linear : bool
        Leave nodes on flat patches and straight curves to the linear motion of the mesh, `SlidingBoundary.linear_mesh`.

    Attributes
    ----------
    sliding_nodes : (k,) int64
        Nodes that are projected.
    """

    limits_moves = True

    def __init__(
        self,
        sliding: SlidingBoundary,
        norm: ObjectiveNorm = SQUARES,
        omitted: np.ndarray | None = None,
        flat_is_linear: bool = False,
    ):
        super().__init__(sliding.linear_mesh if flat_is_linear else sliding.mesh, norm, omitted)
        self._slide(sliding, sliding.curved_nodes if flat_is_linear else sliding.nodes)
        self._linear_nodes = np.setdiff1d(sliding.nodes, self.sliding_nodes, assume_unique=True)

    def _slide(self, sliding: Slides, nodes: np.ndarray) -> None:
        """Let nodes (k,) slide, ascending."""
        self.sliding, self.sliding_nodes = sliding, nodes
        self.faceted = self._slides = self.ranks.any(nodes.size > 0)  # on any rank: they exchange projectors together
        self._rows = np.searchsorted(self.nodes, nodes)
        self._sliding_blocks: dict[BlockSparsity, tuple[np.ndarray, np.ndarray, np.ndarray]] = {}
        self._seen: tuple[np.ndarray, np.ndarray] | None = None
        self._differentiated: tuple[tuple, np.ndarray] | None = None
        self._projected: tuple[np.ndarray, np.ndarray] | None = None

    def moved(self, x: np.ndarray, step: np.ndarray, alpha: float = 1.0) -> np.ndarray:
        there = super().moved(x, step, alpha)
        there[self.sliding_nodes] = self._on_surface(there.take(self.sliding_nodes, axis=0))
        return there

    def on_part(self, part: Mesh, hexes: np.ndarray, nodes: np.ndarray, x: np.ndarray | None = None) -> SlidingEnergy:
        energy = SlidingEnergy.__new__(SlidingEnergy)  # of a part of this boundary, not of one of its own
        MeshEnergy.__init__(energy, part, self.norm, self.omitted[hexes])
        self._give_to_part(energy, hexes)
        number = index_of(nodes, self.mesh.n_nodes)
        sliding, linear = (number[of].astype(np.int64) for of in (self.sliding_nodes, self._linear_nodes))
        sliding, linear = (of[(of >= 0) & part.free[of]] for of in (sliding, linear))
        energy._slide(PartSliding(self.sliding, nodes, x * self.unit), sliding)
        energy._linear_nodes = linear
        return energy

    def _on_surface(self, aims: np.ndarray) -> np.ndarray:
        """Project positions of all sliding nodes, (k, 3) in mean edge lengths; those that are as last time are known.

        Steps are tried again with some nodes' shares of them halved, and the others unchanged.
        """
        known, nodes = self._projected, self.sliding_nodes  # one read, as another thread may replace it
        if known is None:
            places = self.sliding.project(aims * self.unit, nodes) / self.unit
        else:
            places, new = known[1].copy(), np.flatnonzero(differing_rows(aims, known[0]))
            places[new] = self.sliding.project(aims.take(new, axis=0) * self.unit, nodes.take(new)) / self.unit
        self._projected = aims, places
        return places

    def directional_derivative(self, x: np.ndarray, delta: float, step: np.ndarray, gradient: np.ndarray) -> float:
        """Compute the slope along a step (k, 3) after projection; steps of nodes that would ascend are set to 0.

        On a faceted surface the projection of a step across an edge is not along the tangent. With a target, steps
        that ascend along the tangent too are kept: thin hexes couple their nodes, which descend together.
        """
        gradient = self._gradient_in_space(x, delta)
        rows, nodes, unit = self._rows, self.sliding_nodes, self.unit
        places, steps, gradients = x.take(nodes, axis=0), step.take(rows, axis=0), gradient.take(rows, axis=0)
        lengths = 1.0 if self.node_lengths is None else np.minimum(self.node_lengths[rows], 1.0)
        far = _PROBE_LENGTH * lengths / np.maximum(row_norms(steps), np.finfo(float).tiny)[:, None]
        leads = (self.sliding.project((places + far * steps) * unit, nodes) / unit - places) / far
        slopes = np.einsum("ki,ki->k", leads, gradients)
        kept = slopes < 0
        if self.target is not None:
            kept |= slopes <= _KEPT_RISE * np.einsum("ki,ki->k", steps, gradients)
        step[rows[~kept]] = 0.0
        inside = ~mask(rows, len(step))
        return self.ranks.sum(float((step[inside] * gradient[inside]).sum() + slopes[kept].sum()))

    def infeasible_nodes(
        self, x: np.ndarray, there: np.ndarray, changed: np.ndarray | None = None
    ) -> np.ndarray | None:
        points, before = there * self.unit, x * self.unit
        nodes, past_rim = self.sliding.rejected_nodes(before, points, changed), NO_NODES
        if self._linear_nodes.size:
            past_rim = self._past_their_rim(before, points, changed)
        if not (nodes.size or past_rim.size):
            return None
        nodes = np.concatenate([nodes, past_rim])
        nodes = nodes[differing_rows(x[nodes], there[nodes])]
        return mask(nodes, len(x)) if nodes.size else None

    def _past_their_rim(self, before: np.ndarray, points: np.ndarray, changed: np.ndarray | None) -> np.ndarray:
        """Nodes with a linear motion that have left their flat patch or straight curve, across its rim, (k,) int64.

        The band alone would let them: they are in the plane or on the line still, and near the surface. A node that was
        outside may come nearer.
        """
        nodes = self._linear_nodes if changed is None else self._linear_nodes[changed[self._linear_nodes]]
        away = self._distances(points, nodes)
        outside = away > FLAT_DISTANCE * self.unit
        nodes, away = nodes[outside], away[outside]
        return nodes[away > self._distances(before, nodes)] if nodes.size else nodes

    def _distances(self, points: np.ndarray, nodes: np.ndarray) -> np.ndarray:
        """Distances of sliding nodes (k,) from their curves and patches, (k,)."""
        return row_norms(self.sliding.project(points[nodes], nodes) - points[nodes])

    def gradient(self, x: np.ndarray, delta: float = 0.0) -> np.ndarray:
        if not self._slides:
            return super().gradient(x, delta)
        gradient = self._gradient_in_space(x, delta).copy()
        along = self.projectors(x)[: self._rows.size]
        gradient[self._rows] = np.einsum("kij,kj->ki", along, gradient.take(self._rows, axis=0))
        return gradient

    def _gradient_in_space(self, x: np.ndarray, delta: float) -> np.ndarray:
        """Compute the gradient of `MeshEnergy`, (k, 3), not to be changed; a line search needs it twice.

        It is known by the array x, as `projectors` are: points are not changed in place between calls.
        """
        key = x, delta, self.norm, self.omitted, self.barrier, self.surface, self.target
        known = self._differentiated
        if known is None or not all(one is other for one, other in zip(known[0], key, strict=True)):
            known = self._differentiated = key, super().gradient(x, delta)
        return known[1]

    def hessian(self, x: np.ndarray, delta: float = 0.0) -> SlidingHessian:
        return SlidingHessian(self, x, delta)

    def projectors(self, x: np.ndarray) -> np.ndarray:
        """Tangential projectors of the sliding nodes at positions x (n, 3) of all nodes, (k, 3, 3), symmetric.

        Those of sliding nodes that other ranks move follow.
        """
        seen = self._seen  # one read, as another thread may replace it
        if seen is None or seen[0] is not x:
            nodes = self.sliding_nodes
            bases = self.sliding.tangent_bases(x.take(nodes, axis=0) * self.unit, nodes)
            along = np.empty_like(bases)
            sliding_surface.tangent_projectors(bases.reshape(-1, 9), along.reshape(-1, 9))
            seen = self._seen = x, self._with_ghosts(along)
        return seen[1]

    def _with_ghosts(self, projectors: np.ndarray) -> np.ndarray:
        """Append the projectors of sliding nodes that other ranks move to (k, 3, 3); here there are none."""
        return projectors

    @cached_property
    def sliding_slots(self) -> np.ndarray:
        """Slots of the nodes that have `projectors`, (k,) int."""
        return self.ordered_nodes.order[self._rows]

    @property
    def sliding_blocks(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Blocks above the diagonal with a sliding node, and the slots of their rows and columns, (b,) each."""
        sparsity = self.sparsity
        if sparsity not in self._sliding_blocks:
            slides = mask(self.sliding_slots, sparsity.nodes.size)
            row = np.repeat(np.arange(slides.size), np.diff(sparsity.row_start))
            at = np.flatnonzero(slides[row] | slides[sparsity.columns])
            self._sliding_blocks[sparsity] = at.astype(np.int32), row[at].astype(np.int32), sparsity.columns[at]
        return self._sliding_blocks[sparsity]


class SlidingHessian(Hessian):
    """Hessian of a `SlidingEnergy` along the surface; off it a multiple of the identity."""

    energy: SlidingEnergy

    def _product(self, v: np.ndarray) -> np.ndarray:
        energy = self.energy
        rows = energy._rows
        along = energy.projectors(self.x)[: rows.size]
        v = v.reshape(-1, 3).copy()
        normal = v[rows]
        v[rows] = np.einsum("kij,kj->ki", along, normal)
        normal -= v[rows]
        product = super()._product(v.ravel()).reshape(-1, 3)
        product[rows] = np.einsum("kij,kj->ki", along, product[rows]) + normal
        return product.ravel()

    def assembled(self, dtype: type | None = None, reuse: AssembledHessian | None = None) -> AssembledHessian:
        energy, dtype = self.energy, dtype or self.energy.precision
        matrix = super().assembled(dtype, reuse)
        along = energy.projectors(self.x).astype(dtype)
        of_slot = np.broadcast_to(np.eye(3, dtype=dtype), (matrix.sparsity.nodes.size, 3, 3)).copy()
        of_slot[energy.sliding_slots] = along
        at, row, column = energy.sliding_blocks
        conjugate_gradients.turn_blocks(of_slot.reshape(-1, 9), at, row, column, matrix.off_diagonal)
        slots, along = matrix.order[energy._rows], along[: energy._rows.size]
        conjugate_gradients.project_diagonal(along.reshape(-1, 9), slots, matrix.diagonal)
        return matrix
