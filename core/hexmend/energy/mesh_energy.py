"""Energy of a mesh as a function of its free nodes: value and gradient."""

from __future__ import annotations

import copy
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from hexmend.arrays import as_immutable_owned, dot, index_of
from hexmend.boundary import SlidingBoundary
from hexmend.energy.barriers.floor_barrier import FloorBarrier
from hexmend.energy.barriers.height_barrier import HeightBarrier
from hexmend.energy.hessian import Hessian
from hexmend.energy.hex_energy import as_omitted_corners, energies
from hexmend.energy.motion import HessianReduction, Motion
from hexmend.energy.norm import SQUARES, ObjectiveNorm
from hexmend.energy.sparsity import BlockSparsity
from hexmend.energy.target import TargetScales
from hexmend.energy.workspace import Workspace
from hexmend.kernels import objective as kernels
from hexmend.kernels.target import TargetMatrices
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import points_like

if TYPE_CHECKING:
    from hexmend.energy.terms import Term


class MeshEnergy(TargetScales):
    """Sum of eta(H)^p over all hexes, which has the same minimisers as (3.3).

    The unit of length is the mean edge length of the given mesh, so that delta means the same on every mesh. With a
    target (`Mesh.element_target`) eta is that of S W^-1, and delta is relative to the volume that each hex is to have.

    Parameters
    ----------
    mesh : Mesh
    norm : ObjectiveNorm
        p and offset.
    omitted : (m,) uint8, optional
        Corner tetrahedron t of a hex is left out, as if it were perfect, if bit t is set.
    motion : Motion, optional
        Of the nodes; by default they move as the linear motion of the mesh says, or freely. Values and slopes are sums
        over the ranks among which the mesh is divided, gradients those of the nodes that this rank moves.

    Attributes
    ----------
    unit : float
        Mean edge length of the mesh.
    nodes : (k,) int32
        Nodes that move independently of each other; row i of a gradient belongs to nodes[i] and all tied to it.
    n_hexes : int
        Number of hexes, of all ranks.
    counted : (m,) bool or slice
        Hexes that this rank counts.
    target : TargetMatrices or None
        Of the mesh, in the energy's unit of length.
    barrier : FloorBarrier or None
        Added to the energy; for delta = 0.
    surface : Term or None
        Of the boundary, added to that of the hexes.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> mesh = make("cube", size=27)
    >>> energy = MeshEnergy(mesh)
    >>> x = energy.to_edge_units(mesh.points)
    >>> round(energy.value(x), 12), energy.gradient(x).shape
    (0.0, (8, 3))
    """

    def __init__(
        self,
        mesh: Mesh,
        norm: ObjectiveNorm = SQUARES,
        omitted: np.ndarray | None = None,
        motion: Motion | None = None,
    ):
        self.mesh = mesh
        self.norm = norm
        self.omitted = as_omitted_corners(omitted, mesh.n_elements)
        self.unit = mesh.mean_edge_length or 1.0
        self.motion = motion or Motion(mesh)
        self.nodes, self.ranks, owned = self.motion.nodes, self.motion.ranks, self.motion.owned
        self.counted = slice(None) if owned is None else owned[mesh.elements[:, 0]]
        self.n_hexes = mesh.n_elements if owned is None else self.ranks.sum(int(self.counted.sum()))
        self._set_target(mesh)
        self.barrier: FloorBarrier | HeightBarrier | None = None
        self.surface: Term | None = None
        self._workspace = Workspace()
        self.reduction = HessianReduction(self.motion, self._workspace)

    @classmethod
    def on_surface(cls, sliding: SlidingBoundary, norm: ObjectiveNorm = SQUARES) -> MeshEnergy:
        """Make the energy of a mesh whose boundary slides.

        Nodes that slide on flat patches and straight curves get a linear motion: they stay on them exactly, and
        Newton's method converges as it does inside.

        Parameters
        ----------
        sliding : SlidingBoundary
        norm : ObjectiveNorm

        Returns
        -------
        MeshEnergy
            Of `SlidingBoundary.linear_mesh`.
        """
        mesh = sliding.linear_mesh
        return cls(mesh, norm, motion=Motion(mesh, sliding, sliding.curved_nodes))

    @property
    def limits_moves(self) -> bool:
        """True if `infeasible_nodes` may find some."""
        return self.motion.sliding is not None or (self.surface is not None and self.surface.limits_moves)

    @cached_property
    def slots(self) -> np.ndarray:
        """Index of each corner among the free nodes, -1 if it is fixed, (m, 8) int32."""
        return index_of(self.motion.free, self.mesh.n_nodes)[self.mesh.elements]

    @property
    def sparsity(self) -> BlockSparsity:
        """Sparsity pattern of the Hessian: pairs of free nodes that share a hex, or a corner tetrahedron for p = 1."""
        couples_hexes = self.norm.p != 1 or self.barrier is not None
        ordered = self.reduction.ordered_nodes
        return ordered if couples_hexes else ordered.of_tetrahedra

    @property
    def cube_value(self) -> float:
        """Value of the energy if all hexes are cubes, or as the target wants them, and delta is 0."""
        return self.norm.cube_value * self.n_hexes

    def count(self, marks: np.ndarray) -> int:
        """Count the marked hexes of all ranks; marks (m,), marked where they are not 0."""
        return self.ranks.sum(int(np.count_nonzero(marks[self.counted])))

    def mean(self, values: np.ndarray) -> float:
        """Return the mean of a value (m,) of the hexes of all ranks."""
        return self.ranks.sum(float(values[self.counted].sum())) / self.n_hexes

    def on_part(self, part: Mesh, hexes: np.ndarray, nodes: np.ndarray, x: np.ndarray | None = None) -> MeshEnergy:
        """Return the energy of a part of the mesh, as a function of the free nodes of the part.

        Parameters
        ----------
        part : Mesh
            Its hexes are some of this mesh.
        hexes : (k,) int
            Their numbers in this mesh.
        nodes : (j,) int
            Numbers of its nodes in this mesh.
        x : (n, 3) float64, optional
            Positions of all nodes, in mean edge lengths; a term of the boundary has those outside the part there.

        Returns
        -------
        MeshEnergy
            Of positions in mean edge lengths of this mesh, with its norm, omitted corners and target.
        """
        motion = self.motion.on_part(part, nodes)
        energy = MeshEnergy(motion.mesh, self.norm, self.omitted[hexes], motion)
        self._give_to_part(energy, hexes)
        return energy if self.surface is None else energy.with_surface(self.surface.on_part(nodes, motion.mesh.free, x))

    def _give_to_part(self, energy: MeshEnergy, hexes: np.ndarray) -> None:
        """Give the unit, barrier and target of some hexes (k,) to the energy of a part."""
        energy.unit = self.unit
        energy.barrier = None if self.barrier is None else self.barrier.on_part(hexes)
        if self._lengths is not None:
            energy._lengths, energy._weight = self._lengths[hexes], self._weight
            energy.target = self._target_of(hexes)

    def _target_of(self, hexes: np.ndarray) -> TargetMatrices | None:
        """The target of some hexes (k,), None if there is none."""
        if self._lengths is None:
            return None
        return TargetMatrices(self.unit / self._lengths[hexes], self._weight)

    def with_objective(self, norm: ObjectiveNorm, omitted: np.ndarray) -> MeshEnergy:
        """Return a copy with another norm and other omitted corners; the data that depend on the mesh alone are shared.

        Both may be used by several threads at once.

        Parameters
        ----------
        norm : ObjectiveNorm
        omitted : (m,) uint8
            As of `MeshEnergy`.
        """
        other = copy.copy(self)
        other.norm, other.omitted = norm, as_omitted_corners(omitted, self.mesh.n_elements)
        return other

    def with_barrier(self, barrier: FloorBarrier | HeightBarrier | None) -> MeshEnergy:
        """Return a copy to which a barrier of floors is added in place of its own; see `with_objective`."""
        other = copy.copy(self)
        other.barrier = barrier
        return other

    def with_surface(self, surface: Term | None) -> MeshEnergy:
        """Return a copy with a term of the boundary in place of its own; see `with_objective`."""
        other = copy.copy(self)
        other.surface = surface
        return other

    def to_edge_units(self, points: np.ndarray) -> np.ndarray:
        """Points in mean edge lengths, (n, 3)."""
        return self.as_points(points) / self.unit

    def to_mesh_units(self, x: np.ndarray) -> np.ndarray:
        """Points in the mesh's own unit of length, (n, 3), immutable.

        Fixed nodes are to the last bit where they were, and linear constraints hold to the last bit.
        """
        points = self.mesh.points.copy()
        np.multiply(self.as_points(x), self.unit, out=points, where=self.mesh.free[:, None])
        return as_immutable_owned(self.mesh.constrained(points))

    def moved(self, x: np.ndarray, step: np.ndarray, alpha: float = 1.0) -> np.ndarray:
        """Return x (n, 3) with the free nodes moved by alpha times a step of `nodes`, (j, 3)."""
        return self.ranks.complete(self.motion.moved(self.as_points(x), step, alpha))

    def hex_energies(self, x: np.ndarray, delta: float = 0.0, offset: float = 1.0) -> np.ndarray:
        """Compute eta(H) of every hex at points x (n, 3), (m,); +inf at delta = 0 for an inverted hex."""
        return energies(self.as_points(x), self.mesh.elements, delta, self.omitted, offset, self.target)

    def barriers(self, x: np.ndarray) -> np.ndarray | float:
        """Compute the barrier of floors of every hex at points x (n, 3), (m,), or 0 where there is none."""
        if self.barrier is None:
            return 0.0
        return self.barrier.hex_values(self.as_points(x), self.mesh.elements, self.omitted, self.target)

    def with_barriers(self, x: np.ndarray, delta: float, among: np.ndarray | None = None) -> np.ndarray:
        """Compute eta(H) plus the barrier at points x (n, 3), (k,) float64, of some hexes (k,) int or of all."""
        hexes, omitted, target, barrier = self.mesh.elements, self.omitted, self.target, self.barrier
        if among is not None:
            hexes, omitted, target = hexes.take(among, axis=0), omitted[among], self._target_of(among)
            barrier = None if barrier is None else barrier.on_part(among)
        values = energies(x, hexes, delta, omitted, 1.0, target)
        if barrier is not None:
            values += barrier.hex_values(x, hexes, omitted, target)
        return values

    def value(self, x: np.ndarray, delta: float = 0.0) -> float:
        """Compute the sum of eta(H)^p at points x (n, 3); +inf at delta = 0 if any hex is inverted."""
        p, offset = self.norm
        eta = self.hex_energies(x, delta, offset)
        with np.errstate(over="ignore"):  # near the barrier, or with a node far away, it is infinite
            if p == 2:
                np.square(eta, out=eta)
            elif p != 1:
                np.power(eta, p, out=eta)
            own = float(eta[self.counted].sum())
            if self.barrier is not None:
                own += float(self.barriers(x)[self.counted].sum())
        if self.surface is not None:
            own += self.surface.value(self.as_points(x), self.norm)
        return self.ranks.sum(own)

    def gradient(self, x: np.ndarray, delta: float = 0.0) -> np.ndarray:
        """Compute the gradient by `nodes` at points x (n, 3), (j, 3): (B.3), (B.21), (C.2)."""
        x = self.as_points(x)
        return self.motion.contract(x, self._gradient_in_space(x, delta))

    def _gradient_in_space(self, x: np.ndarray, delta: float) -> np.ndarray:
        """Compute the gradient by all free nodes, as if they were free in space, (k, 3)."""
        shares = self.corner_buffer
        kernels.gradient(x, self.mesh.elements, delta, self.norm, self.omitted, shares, self.target)
        if self.barrier is not None:
            self.barrier.add_gradient(x, self.mesh.elements, self.omitted, shares, self.target)
        gradient = self.sum_at_nodes()
        if self.surface is not None:
            gradient += self.surface.gradient(x, self.norm)[self.motion.free]
        return gradient

    def hessian(self, x: np.ndarray, delta: float = 0.0) -> Hessian:
        """Return the Hessian with respect to `nodes` at points x (n, 3)."""
        return Hessian(self, x, delta)

    def directional_derivative(self, x: np.ndarray, delta: float, step: np.ndarray, gradient: np.ndarray) -> float:
        """Compute the slope of `value` at x along a step (j, 3) of `nodes` from the gradient (j, 3) there.

        Steps of nodes that would ascend on a surface are set to 0.
        """
        if not self.motion.projected.size:
            return self.ranks.sum(dot(step, gradient))
        x = self.as_points(x)
        forces = self._gradient_in_space(x, delta)
        return self.ranks.sum(self.motion.slope(x, step, forces, self.node_lengths))

    def infeasible_nodes(
        self, x: np.ndarray, moved: np.ndarray, changed: np.ndarray | None = None
    ) -> np.ndarray | None:
        """Return True for nodes that may not move from x (n, 3) to `moved` (n, 3), (n,) bool; None if all may.

        With `changed`, (n,) bool, other nodes are known to be where they may.
        """
        found = [self.motion.infeasible(x, moved, changed)]
        if self.surface is not None:
            found.append(self.surface.beyond(self.as_points(x), self.as_points(moved)))
        marks = [each for each in found if each is not None]
        return self.motion.with_tied(np.logical_or.reduce(marks)) if marks else None

    def with_tied(self, marks: np.ndarray) -> np.ndarray:
        """Return marks of nodes, (n,) bool, to which the nodes are added that move with them."""
        return self.ranks.complete(self.motion.with_tied(marks))

    @property
    def corner_buffer(self) -> np.ndarray:
        """Storage for the contributions of hexes at their corners, (m, 8, 3), until the workspace is used again."""
        return self._workspace.array((self.mesh.n_elements, 8, 3), np.float64)

    def release_workspace(self) -> None:
        """Free the memory of temporary arrays until they are wanted again."""
        self._workspace.release()

    def as_points(self, x: np.ndarray) -> np.ndarray:
        """Check positions of all nodes, (n, 3) float64; raises `MeshError` for another shape or type."""
        return points_like(x, self.mesh.points.shape, "places of nodes")

    def sum_at_nodes(self) -> np.ndarray:
        """Sum the contributions of the hexes at each free node, (k, 3)."""
        corners = self.mesh.topology.node_corners
        rows = np.empty((self.motion.free.size, 3))
        kernels.gather(self.corner_buffer.reshape(-1, 3), corners.start, corners.items, self.motion.free, rows)
        return rows
