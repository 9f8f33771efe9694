"""Hessian of the energy of a mesh: products with vectors, and the matrix of blocks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import numpy as np

from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.linear_operator import SymmetricOperator
from hexmend.kernels import assembly, conjugate_gradients, threads
from hexmend.kernels import objective as kernels

if TYPE_CHECKING:
    from hexmend.energy.barriers.floor_barrier import FloorBarrier
    from hexmend.energy.barriers.height_barrier import HeightBarrier
    from hexmend.energy.motion import HessianReduction, Motion
    from hexmend.energy.norm import ObjectiveNorm
    from hexmend.energy.ranks import Ranks
    from hexmend.energy.sparsity import BlockSparsity
    from hexmend.energy.terms import Term
    from hexmend.kernels.target import TargetMatrices
    from hexmend.mesh.mesh import Mesh


#: Share of nodes with stretched diagonal blocks above which blocks are not packed.
_MOST_STRETCHED = 0.01


class EnergyOfHexes(Protocol):
    """Data and methods of a `MeshEnergy` that its Hessian uses."""

    mesh: Mesh
    norm: ObjectiveNorm
    omitted: np.ndarray
    motion: Motion
    reduction: HessianReduction
    slots: np.ndarray
    target: TargetMatrices | None
    barrier: FloorBarrier | HeightBarrier | None
    surface: Term | None
    sparsity: BlockSparsity
    ranks: Ranks
    precision: type
    corner_buffer: np.ndarray

    def as_points(self, x: np.ndarray) -> np.ndarray:
        """Check positions of all nodes, (n, 3) float64."""

    def sum_at_nodes(self) -> np.ndarray:
        """Sum the contributions of the hexes at each free node, (k, 3)."""


class Hessian(SymmetricOperator):
    """Hessian of a `MeshEnergy` at given node positions, (3 j, 3 j), plus `shift` times the identity.

    Unknowns are x, y, z of the first node that moves independently, then of the second, and so on. In directions in
    which these cannot move it is a multiple of the identity.
    """

    def __init__(self, energy: EnergyOfHexes, x: np.ndarray, delta: float, shift: float = 0.0):
        super().__init__(3 * energy.motion.nodes.size)
        self.energy, self.x, self.delta, self.shift = energy, energy.as_points(x), float(delta), float(shift)

    def shifted(self, shift: float) -> Hessian:
        """Return H + shift I."""
        return type(self)(self.energy, self.x, self.delta, self.shift + shift)

    def _product(self, v: np.ndarray) -> np.ndarray:
        motion, v = self.energy.motion, v.reshape(-1, 3)
        product = motion.contract(self.x, self._product_in_space(motion.expand(self.x, v)))
        if not motion.is_free:
            product += motion.inadmissible(self.x, v)
        if self.shift:
            product += self.shift * v
        return product.ravel()

    def _product_in_space(self, v: np.ndarray) -> np.ndarray:
        """The product of the Hessian of all free nodes with vectors v (k, 3), (k, 3)."""
        energy = self.energy
        if energy.barrier is not None or energy.surface is not None:
            return (self._in_space(np.float64) @ v.ravel()).reshape(-1, 3)
        kernels.hessian_product(
            self.x,
            energy.mesh.elements,
            energy.slots,
            v,
            self.delta,
            energy.norm,
            energy.omitted,
            energy.corner_buffer,
            energy.target,
        )
        return energy.sum_at_nodes()

    def assembled(self, dtype: type | None = None, reuse: AssembledHessian | None = None) -> AssembledHessian:
        """Assemble the matrix, for many products or for a linear system.

        Parameters
        ----------
        dtype : numpy.float32 or numpy.float64, optional
            Precision of the blocks; `MeshEnergy.precision` by default, and then those above the diagonal of a large
            matrix in single precision are packed. A matrix too small for single precision (near the optimum of a high
            p) is assembled in double precision and scaled before it is rounded.
        reuse : AssembledHessian, optional
            Matrix that is no longer needed: its storage is used if pattern and precision agree, as memory that has
            been touched before is faster.

        Returns
        -------
        AssembledHessian
        """
        matrix = self.energy.reduction.reduced(self._in_space(dtype, reuse), self.x)
        if self.shift:
            shift = np.ldexp(self.shift, -matrix.exponent)
            matrix.diagonal += shift * np.array([1, 0, 0, 1, 0, 1], matrix.diagonal.dtype)
        return matrix

    def _in_space(self, dtype: type | None = None, reuse: AssembledHessian | None = None) -> AssembledHessian:
        """Assemble the matrix of all free nodes, without the shift; see `assembled`."""
        energy = self.energy
        sparsity, packed = energy.sparsity, dtype is None and self._is_packed
        dtype = dtype or energy.precision
        fits = reuse is not None and (reuse.sparsity, reuse.dtype, reuse.packed) == (sparsity, dtype, packed)
        matrix = reuse.reset() if fits else AssembledHessian.zero(sparsity, dtype, packed)
        stretched = self._assemble(matrix)
        if packed and energy.ranks.any(stretched > _MOST_STRETCHED * sparsity.order.size):
            del matrix
            sparsity.packs = False
            return self._in_space()
        if dtype == np.float32 and matrix.underflows():
            wide = AssembledHessian.zero(sparsity, np.float64)
            self._assemble(wide)
            return wide.normalised(dtype)
        return matrix

    @property
    def _is_packed(self) -> bool:
        energy = self.energy
        whole = energy.barrier is None and energy.surface is None and energy.motion.is_free  # blocks stay as they are
        return whole and energy.precision is np.float32 and energy.sparsity.packs

    def _assemble(self, matrix: AssembledHessian) -> int:
        """Add this Hessian to a matrix of zeros; returns the number of nodes for which packed blocks are too coarse."""
        stretched = 0
        energy, shares = self.energy, self.energy.sparsity.shares(threads())
        blocks = matrix.off_diagonal, matrix.diagonal
        given = self.x, self.delta, energy.norm, energy.omitted, shares
        if matrix.packed:
            assembly.assemble_packed(*given, energy.sparsity.first_separator, *blocks, energy.target)
            stretched = conjugate_gradients.complete_diagonal(energy.sparsity.pattern, *blocks)
        else:
            assembly.assemble(*given, *blocks, energy.target)
        if energy.barrier is not None:
            energy.barrier.assemble(self.x, energy.omitted, matrix, energy.target)
        if energy.surface is not None:
            energy.surface.assemble(self.x, energy.norm, matrix)
        return stretched
