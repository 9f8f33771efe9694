"""Energy of a mesh with linear constraints on the displacements of its nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from hexmend.arrays import as_immutable_owned, dot, index_of, mask
from hexmend.boundary import SlidingBoundary
from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.barriers.floor_barrier import FloorBarrier
from hexmend.energy.barriers.height_barrier import HeightBarrier
from hexmend.energy.hessian import Hessian
from hexmend.energy.mesh_energy import MeshEnergy
from hexmend.energy.norm import SQUARES, ObjectiveNorm
from hexmend.energy.reduction import Reduction
from hexmend.energy.sliding_energy import SlidingEnergy
from hexmend.mesh.mesh import Mesh

if TYPE_CHECKING:
    from hexmend.energy.terms import Term


def energy_of(mesh: Mesh, norm: ObjectiveNorm = SQUARES, sliding: SlidingBoundary | None = None) -> MeshEnergy:
    """Make the energy of a mesh whose boundary is fixed or slides, with its linear motion if it has one.

    Nodes that slide on flat patches and straight curves get a linear motion: they stay on them exactly, and Newton's
    method converges as it does inside.

    Parameters
    ----------
    mesh : Mesh
    norm : ObjectiveNorm
    sliding : SlidingBoundary, optional
        The boundary of this mesh, if it slides.

    Returns
    -------
    MeshEnergy
    """
    energy = MeshEnergy(mesh, norm) if sliding is None else SlidingEnergy(sliding, norm, flat_is_linear=True)
    return energy if energy.mesh.linear_motion is None else LinearMotionEnergy(energy)


class LinearMotionEnergy(MeshEnergy):
    """Energy as a function of the nodes that move independently: tied nodes follow, others keep planes and lines.

    Parameters
    ----------
    energy : MeshEnergy
        Energy of a mesh with a linear motion, as a function of all its free nodes.

    Attributes
    ----------
    nodes : (j,) int32
        Independent nodes; row i of a gradient belongs to nodes[i] and all that follow it.
    """

    def __init__(self, energy: MeshEnergy):
        super().__init__(energy.mesh, energy.norm, energy.omitted)
        self.unit, self._lengths, self.target = energy.unit, energy._lengths, energy.target
        self._weight = energy._weight
        self.surface = energy.surface
        self.energy, self.reduction = energy, Reduction(energy.mesh)
        self.nodes, self.faceted = self.reduction.nodes, energy.faceted
        self.limits_moves = energy.limits_moves
        self.has_parts = not self.reduction.has_ties

    def on_part(self, part: Mesh, hexes: np.ndarray, nodes: np.ndarray, x: np.ndarray | None = None) -> MeshEnergy:
        if not self.has_parts:
            return super().on_part(part, hexes, nodes, x)
        motion = self.mesh.linear_motion.renumbered(index_of(nodes, self.mesh.n_nodes))
        part = part.with_linear_motion(motion).with_fixed(part.fixed)
        energy = self.energy.on_part(part, hexes, nodes, x)
        if part.linear_motion is None:  # none of its nodes moves in a plane or along a line
            return energy
        return LinearMotionEnergy(energy).with_barrier(energy.barrier)

    def with_objective(self, norm: ObjectiveNorm, omitted: np.ndarray) -> LinearMotionEnergy:
        other = super().with_objective(norm, omitted)
        other.energy = self.energy.with_objective(norm, omitted)
        return other

    def with_barrier(self, barrier: FloorBarrier | HeightBarrier | None) -> LinearMotionEnergy:
        other = super().with_barrier(barrier)
        other.energy = self.energy.with_barrier(barrier)
        return other

    def with_surface(self, surface: Term | None) -> LinearMotionEnergy:
        other = super().with_surface(surface)
        other.energy = self.energy.with_surface(surface)
        other.limits_moves = other.energy.limits_moves
        return other

    def to_mesh_units(self, x: np.ndarray) -> np.ndarray:
        """Points in the mesh's own unit of length, (n, 3), immutable; constraints hold to the last bit."""
        return as_immutable_owned(self.mesh.constrained(super().to_mesh_units(x)))

    def moved(self, x: np.ndarray, step: np.ndarray, alpha: float = 1.0) -> np.ndarray:
        """Return x (n, 3) with the free nodes displaced as alpha times steps (j, 3) of the independent ones."""
        return self.energy.moved(x, self.reduction.expand(step), alpha)

    def gradient(self, x: np.ndarray, delta: float = 0.0) -> np.ndarray:
        return self.reduction.contract(self.energy.gradient(x, delta))

    def hessian(self, x: np.ndarray, delta: float = 0.0) -> LinearMotionHessian:
        return LinearMotionHessian(self, x, delta)

    def directional_derivative(self, x: np.ndarray, delta: float, step: np.ndarray, gradient: np.ndarray) -> float:
        if not self.faceted:
            return dot(step, gradient)
        steps = self.reduction.expand(step)
        slope = self.energy.directional_derivative(x, delta, steps, self.energy.gradient(x, delta))
        stopped = self.energy.nodes[~steps.any(axis=1)]
        step[mask(stopped, len(x))[self.nodes]] = 0.0
        return slope

    def infeasible_nodes(
        self, x: np.ndarray, moved: np.ndarray, changed: np.ndarray | None = None
    ) -> np.ndarray | None:
        marks = self.energy.infeasible_nodes(x, moved, changed)
        return None if marks is None else self.with_masters(marks)

    def with_masters(self, marks: np.ndarray) -> np.ndarray:
        marks, root = marks.copy(), self.reduction.root
        marks[root[marks]] = True
        return marks


class LinearMotionHessian(Hessian):
    """Hessian of a `LinearMotionEnergy`: T^T H T, and the identity in directions that are not admissible."""

    energy: LinearMotionEnergy

    def _product(self, v: np.ndarray) -> np.ndarray:
        energy, v = self.energy, v.reshape(-1, 3)
        of_all = energy.energy.hessian(self.x, self.delta)
        along = of_all.matvec(energy.reduction.expand(v).ravel()).reshape(-1, 3)
        product = energy.reduction.contract(along) + energy.reduction.inadmissible(v)
        return (product + self.shift * v).ravel()

    def assembled(self, dtype: type | None = None, reuse: AssembledHessian | None = None) -> AssembledHessian:
        energy, storage = self.energy, None if reuse is None else reuse.unreduced or reuse
        full = energy.energy.hessian(self.x, self.delta).assembled(dtype or energy.precision, storage)
        matrix = energy.reduction.reduced(full)
        matrix.diagonal += np.ldexp(self.shift, -matrix.exponent) * np.array([1, 0, 0, 1, 0, 1], matrix.diagonal.dtype)
        if matrix is not full:
            matrix.unreduced = full
        return matrix
