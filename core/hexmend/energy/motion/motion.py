"""Motion of the nodes of a mesh, as an energy uses it."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from hexmend.arrays import index_of, mask, row_norms
from hexmend.boundary.band import NO_NODES
from hexmend.energy.ranks import ONE_RANK, Ranks
from hexmend.kernels import sliding_surface, step_limits
from hexmend.mesh.linear_motion import LinearMotion
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import points_like

#: Length of the probing step for slopes on a surface, in mean edge lengths.
_PROBE_LENGTH = 1e-5
#: Share of a rising slope along the tangent up to which the slope after projection may rise.
_KEPT_RISE = 1.01


class Sliding(Protocol):
    """Nodes of a boundary that slide on a surface, such as `hexmend.boundary.SlidingBoundary`; in the mesh's unit."""

    def project(self, x: np.ndarray, nodes: np.ndarray) -> np.ndarray:
        """Project positions (k, 3) of some sliding nodes (k,)."""

    def tangent_bases(self, x: np.ndarray, nodes: np.ndarray) -> np.ndarray:
        """Compute directions in which some sliding nodes (k,) at positions (k, 3) may move, (k, 3, 3)."""

    def rejected(self, before: np.ndarray, after: np.ndarray, changed: np.ndarray | None = None) -> np.ndarray | None:
        """Mark nodes whose moves harm the boundary, (n,) bool; None if there are none."""


class Motion:
    """Motion of the nodes of a mesh: free, in planes and along lines, tied to others, between them, or on a surface.

    A linear map T takes steps of the independent nodes to steps of all free nodes. Its blocks of 3 x 3 are the
    projectors of the linear motion, with the rotations of tied nodes, and for nodes on a surface the projectors onto
    its tangents at the present positions. Moved nodes are then projected onto the surface. The derivative of T, the
    curvature of the surface, is left out.

    Parameters
    ----------
    mesh : Mesh
        With its linear motion, if it has one.
    sliding : Sliding, optional
        The surface; it limits the moves of all nodes.
    projected : (s,) int64, optional
        Free nodes without a linear motion that are projected onto the surface, ascending; those of other ranks follow.
    owned : (n,) bool, optional
        Nodes that this rank moves, where a mesh is divided among several.
    ranks : Ranks, optional
        The ranks among which the mesh is divided.

    Attributes
    ----------
    free : (k,) int32
        Nodes that move, ascending.
    nodes : (j,) int32
        Independent nodes: those that neither are tied nor hang. Row i of a step belongs to nodes[i] and all that follow
        it.
    row : (k,) int32 or None
        Index in `nodes` of each free node, or of its master, or of one on which it hangs; None if all are independent.
    hanging : tuple of (w,) int64, (w,) int64, (w,) float64
        Indices in `free` of nodes that hang and of those on which they hang, with the weights of these.
    bent : (b,) int64
        Nodes where T is not the identity; those of other ranks come last.
    projected : (p,) int64
        Nodes of this rank that are projected onto the surface.
    restricted : (r,) int64
        Index in `bent` of the independent nodes of this rank.
    unit : float
        Unit of length of positions and steps: the mean edge length of the mesh.
    """

    def __init__(
        self,
        mesh: Mesh,
        sliding: Sliding | None = None,
        projected: np.ndarray = NO_NODES,
        owned: np.ndarray | None = None,
        ranks: Ranks = ONE_RANK,
    ):
        n, linear = mesh.n_nodes, mesh.linear_motion
        self.mesh, self.sliding, self.owned, self.ranks = mesh, sliding, owned, ranks
        self.unit = mesh.mean_edge_length or 1.0
        self.free = self.nodes = np.flatnonzero(mesh.free if owned is None else mesh.free & owned).astype(np.int32)
        self.row: np.ndarray | None = None
        self.hanging = NO_NODES, NO_NODES, np.empty(0)
        if linear is not None and mesh.free[np.concatenate([linear.tied, linear.hanging])].any():
            own, number = linear.leads(n)[self.free], index_of(self.free, n)
            self.nodes, self._own = self.free[own], np.flatnonzero(own)
            self.row = index_of(self.nodes, n)[linear.roots(n)[self.free]]
            self.tied = np.flatnonzero((self.row >= 0) & ~own)
            ends = number[linear.hanging].astype(np.int64), number[linear.anchors].astype(np.int64)
            moves = (ends[0] >= 0) & (ends[1] >= 0)
            self.hanging = ends[0][moves], ends[1][moves], linear.weights[moves]
            self.row[self.hanging[0]] = self.row[self.hanging[1]]
        nodes, self._turn = _linear_blocks(linear, mesh.free)
        self.bent = np.concatenate([nodes, projected])
        here = self.bent if owned is None else self.bent[owned[self.bent]]
        self.projected = here[nodes.size :]  # that this rank moves
        if self.bent.size:
            self._rows, at = index_of(self.free, n)[here], index_of(self.nodes, n)[here]
            self.restricted = np.flatnonzero(at >= 0)
            self._restricted_rows = at[self.restricted]
        self._seen: tuple[np.ndarray, np.ndarray] | None = None

    @property
    def is_free(self) -> bool:
        """True if T is the identity."""
        return self.row is None and not self.bent.size

    @property
    def has_parts(self) -> bool:
        """True if nodes move independently of each other, so that parts of the mesh have motions of the same form."""
        return self.row is None and self.sliding is None

    def on_part(self, part: Mesh, nodes: np.ndarray) -> Motion:
        """Return the motion of a part of the mesh, from its nodes' numbers (p,) in the mesh; surfaces have no parts."""
        linear, number = self.mesh.linear_motion, index_of(nodes, self.mesh.n_nodes)
        if linear is not None:
            part = part.with_motion_of_rules(linear.renumbered(number)).with_fixed(part.fixed)
        if self.owned is None:
            return Motion(part)
        moving = np.where(mask(nodes[part.free], self.mesh.n_nodes), number, -1)
        return Motion(part, owned=self.owned[nodes], ranks=self.ranks.part(moving))

    def turn(self, x: np.ndarray) -> np.ndarray:
        """Blocks of T of the nodes `bent` at positions x (n, 3) of all nodes, (b, 3, 3).

        The last ones are known by the array x: positions are not changed in place between calls.
        """
        if self.sliding is None or self.bent.size == len(self._turn):
            return self._turn
        seen = self._seen  # one read, as another thread may replace it
        if seen is None or seen[0] is not x:
            nodes = self.bent[len(self._turn) :]
            bases = self.sliding.tangent_bases(x.take(nodes, axis=0) * self.unit, nodes)
            along = np.empty_like(bases)
            sliding_surface.tangent_projectors(bases.reshape(-1, 9), along.reshape(-1, 9))
            seen = self._seen = x, np.concatenate([self._turn, along])
        return seen[1]

    def expand(self, x: np.ndarray, steps: np.ndarray) -> np.ndarray:
        """T at positions x (n, 3) times steps of the independent nodes, (j, 3): those of all free nodes, (k, 3)."""
        return self._expanded(steps, self.turn(x))

    def _expanded(self, steps: np.ndarray, turn: np.ndarray) -> np.ndarray:
        """Give steps of the independent nodes (j, 3) to all free nodes, (k, 3), by blocks of the first of `bent`."""
        if self.is_free:
            return steps
        steps = self._turned(steps.copy() if self.row is None else steps.take(self.row, axis=0), turn)
        self._hang(steps)
        return steps

    def _hang(self, steps: np.ndarray) -> None:
        """Give nodes that hang the weighted sums of the steps of others; steps of all free nodes (k, 3) are changed."""
        nodes, anchors, weights = self.hanging
        if nodes.size:
            steps[nodes] = 0.0
            np.add.at(steps, nodes, weights[:, None] * steps[anchors])

    def contract(self, x: np.ndarray, forces: np.ndarray) -> np.ndarray:
        """Reduce vectors of the free nodes, (k, 3), overwritten, to the independent ones, (j, 3), by T^T at x."""
        if self.is_free:
            return forces
        nodes, anchors, weights = self.hanging
        if nodes.size:
            np.add.at(forces, anchors, weights[:, None] * forces[nodes])
        forces = self._turned(forces, self.turn(x).transpose(0, 2, 1))
        if self.row is None:
            return forces
        sums = forces[self._own]
        np.add.at(sums, self.row[self.tied], forces[self.tied])
        return sums

    def _turned(self, vectors: np.ndarray, turn: np.ndarray) -> np.ndarray:
        """Multiply vectors of free nodes (k, 3), changed, by the blocks of the first of `bent`; returns them."""
        if self.bent.size:
            rows = self._rows[: len(turn)]
            vectors[rows] = np.einsum("kij,kj->ki", turn[: rows.size], vectors.take(rows, axis=0))
        return vectors

    def inadmissible(self, x: np.ndarray, vectors: np.ndarray) -> np.ndarray:
        """Components of vectors of the independent nodes, (j, 3), at x (n, 3) along which these cannot move, (j, 3)."""
        outside = np.zeros(vectors.shape)
        if self.bent.size:
            own = vectors[self._restricted_rows]
            along = np.einsum("kij,kj->ki", self.turn(x)[self.restricted], own)
            outside[self._restricted_rows] = own - along
        return outside

    def moved(self, x: np.ndarray, step: np.ndarray, alpha: float = 1.0) -> np.ndarray:
        """Return x (n, 3) with the free nodes moved by alpha times a step of the independent ones, (j, 3).

        On a surface steps are projected as they are: those of a solver in single precision are tangential but for its
        rounding, and what limits them there is not continuous.
        """
        steps = self._expanded(points_like(step, (self.nodes.size, 3), "steps"), self._turn)
        there = np.empty(x.shape)
        step_limits.displaced(x, self.free, steps, alpha, there)
        if self.projected.size:
            there[self.projected] = self._project(there.take(self.projected, axis=0))
            if self.hanging[0].size:
                steps = there.take(self.free, axis=0) - x.take(self.free, axis=0)
                self._hang(steps)
                at = self.hanging[0]
                there[self.free[at]] = x[self.free[at]] + steps[at]
        return there

    def _project(self, x: np.ndarray) -> np.ndarray:
        """Project positions of the nodes `projected`, (p, 3), onto the surface."""
        assert self.sliding is not None  # else there are none
        return self.sliding.project(x * self.unit, self.projected) / self.unit

    def slope(self, x: np.ndarray, step: np.ndarray, forces: np.ndarray, lengths: np.ndarray | None) -> float:
        """Compute the slope of an energy along a step after projection; steps of nodes that would ascend are set to 0.

        On a faceted surface the projection of a step across an edge is not along the tangent. With a target, steps
        that ascend along the tangent too are kept: thin hexes couple their nodes, which descend together.

        Parameters
        ----------
        x : (n, 3) float64
            Positions, in mean edge lengths.
        step : (j, 3) float64
            Changed.
        forces : (k, 3) float64
            Gradient of the energy by the free nodes, as if they were free in space.
        lengths : (j, 1) float64 or None
            Lengths of the targets at the independent nodes, in mean edge lengths.

        Returns
        -------
        float
            Of the nodes of this rank.
        """
        rows = self._rows[len(self._turn) :]
        at = rows if self.row is None else self.row[rows]
        steps = self._expanded(step, self._turn)
        places, along, own = x.take(self.projected, axis=0), steps.take(rows, axis=0), forces.take(rows, axis=0)
        sizes = 1.0 if lengths is None else np.minimum(lengths[at], 1.0)
        far = _PROBE_LENGTH * sizes / np.maximum(row_norms(along), np.finfo(float).tiny)[:, None]
        slopes = np.einsum("ki,ki->k", (self._project(places + far * along) - places) / far, own)
        kept = slopes < 0
        if lengths is not None:
            kept |= slopes <= _KEPT_RISE * np.einsum("ki,ki->k", along, own)
        step[at[~kept]] = steps[rows] = 0.0
        return float((steps * forces).sum() + slopes[kept].sum())

    def infeasible(self, x: np.ndarray, there: np.ndarray, changed: np.ndarray | None = None) -> np.ndarray | None:
        """Mark nodes that the surface does not let move from x (n, 3) to `there` (n, 3), (n,) bool; None if all may.

        With `changed`, (n,) bool, other nodes are known to be where they may.
        """
        return None if self.sliding is None else self.sliding.rejected(x * self.unit, there * self.unit, changed)

    def with_tied(self, marks: np.ndarray) -> np.ndarray:
        """Return marks of nodes, (n,) bool, to which the nodes are added that move with them, or on which they hang."""
        linear = self.mesh.linear_motion
        return marks if self.row is None or linear is None else linear.with_coupled(marks)


def _linear_blocks(motion: LinearMotion | None, free: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find the free nodes, free (n,) bool, that a linear motion restricts or turns.

    Returns
    -------
    nodes : (b,) int64
    turn : (b, 3, 3) float64
        Displacement of each, from that of itself or of its master.
    """
    if motion is None:
        return NO_NODES, np.empty((0, 3, 3))
    place = index_of(motion.nodes, free.size)[motion.master]
    of_master = np.tile(np.eye(3), (place.size, 1, 1))
    of_master[place >= 0] = motion.projectors[place[place >= 0]]
    nodes = np.concatenate([motion.nodes, motion.tied]).astype(np.int64)
    turn = np.concatenate([motion.projectors, motion.rotations @ of_master])
    used = free[nodes] & (turn != np.eye(3)).any(axis=(1, 2))
    return nodes[used], turn[used]
