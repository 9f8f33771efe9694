"""Term of an energy that the quads of a sliding boundary add: value, gradient, and blocks of the Hessian."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.arrays import index_of
from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.norm import ObjectiveNorm
from hexmend.energy.quads.quad_energy import QuadCorners, power_derivatives
from hexmend.energy.sparsity import BlockSparsity
from hexmend.kernels import sliding_surface

#: Places of xx xy xz yy yz zz in a matrix of 3 rows.
_UPPER = [0, 1, 2, 4, 5, 8]


class QuadBlocks:
    """Places of pairs of a quad's nodes in assembled Hessians; they are found once for each sparsity pattern.

    Parameters
    ----------
    quads : (f, 4) int32
    """

    def __init__(self, quads: np.ndarray):
        self._quads, self._known = quads, None

    def of(self, sparsity: BlockSparsity) -> tuple[np.ndarray, ...]:
        """Find the places in matrices of a sparsity pattern.

        Returns
        -------
        quad, corner, slot : (d,) int
            Corners with a free node, and its slot.
        quad, row, column, block : (b,) int
            Pairs of corners with free nodes, and the block above the diagonal to which their second derivatives belong:
            that of the corner `row` comes first.
        """
        known = self._known
        if known is not None and known[0] is sparsity:
            return known[1]
        slots = index_of(sparsity.nodes, int(max(sparsity.nodes.max(initial=-1), self._quads.max(initial=-1))) + 1)
        slots = slots[self._quads].astype(np.int64)
        count = sparsity.nodes.size
        rows = np.repeat(np.arange(len(sparsity.row_start) - 1, dtype=np.int64), np.diff(sparsity.row_start))
        keys = rows * count + sparsity.columns  # ascending
        row, column = (corner.ravel() for corner in np.indices((4, 4)))
        first, second = slots[:, row], slots[:, column]
        quad, pair = np.nonzero((first >= 0) & (first < second))
        block = np.searchsorted(keys, first[quad, pair] * count + second[quad, pair])
        free = np.nonzero(slots >= 0)
        places = (*free, slots[free], quad, row[pair], column[pair], block)
        self._known = sparsity, places
        return places


@dataclass(frozen=True, eq=False)
class SurfaceTerm:
    """Sum of weight eta(Q)^p over the quads of a boundary, with normals and delta that are held for a step.

    Parameters
    ----------
    quads : (f, 4) int32
        Nodes, counter-clockwise from outside.
    counted : (f, 4) bool
        False for corners that count as perfect.
    normals : (f, 3) float64
        Outward unit normals of the surface at the quads.
    scales : (2, f, 4) float64
        Inverse lengths, in the energy's unit, that the edges to the next and the previous corner are to have; 1 without
        a target.
    weight : float
    delta : float
        Softens the barrier: in squares of the energy's unit of length.
    blocks : QuadBlocks
        Of the quads.
    has_lengths : bool
        True if the edges are to have lengths of their own, with a target.
    """

    quads: np.ndarray
    counted: np.ndarray
    normals: np.ndarray
    scales: np.ndarray
    weight: float
    delta: float
    blocks: QuadBlocks
    has_lengths: bool = False

    @property
    def total_weight(self) -> float:
        """Sum of the weights of the quads: the term has so many times the value of a hex if all of them are squares."""
        return self.weight * len(self.quads)

    def value(self, x: np.ndarray, norm: ObjectiveNorm) -> float:
        """Compute the term at points x (n, 3) in the energy's unit; +inf at delta = 0 with a flipped corner."""
        with np.errstate(over="ignore"):
            energy = np.maximum(self.corners(x).energies(norm.offset), 0.0)
            return self.weight * float(np.power(energy, norm.p).sum())

    def gradient(self, x: np.ndarray, norm: ObjectiveNorm) -> np.ndarray:
        """Compute the gradient by all nodes, (n, 3); see `value`."""
        corners = self.corners(x)
        first, _ = power_derivatives(corners.energies(norm.offset), norm.p)
        shares = (self.weight * first)[:, None, None] * corners.gradients()
        at = self.quads.ravel()
        return np.stack([np.bincount(at, shares[:, :, k].ravel(), len(x)) for k in range(3)], axis=1)

    def assemble(self, x: np.ndarray, norm: ObjectiveNorm, matrix: AssembledHessian) -> None:
        """Add the second derivatives to a matrix; see `value`."""
        corners = self.corners(x)
        first, second = power_derivatives(corners.energies(norm.offset), norm.p)
        gradients = corners.gradients()
        outer = np.einsum("fai,fbj->fabij", gradients, gradients)
        pairs = first[:, None, None, None, None] * corners.hessians() + second[:, None, None, None, None] * outer
        pairs *= self.weight
        own_quad, corner, slot, quad, row, column, block = self.blocks.of(matrix.sparsity)
        diagonal = pairs[own_quad, corner, corner].reshape(-1, 9)[:, _UPPER]
        np.add.at(matrix.diagonal, slot, diagonal.astype(matrix.diagonal.dtype))
        above = pairs[quad, row, column].reshape(-1, 9)
        np.add.at(matrix.off_diagonal, block, above.astype(matrix.dtype))

    def corners(self, x: np.ndarray) -> QuadCorners:
        """Compute the corners of the quads at points x (n, 3) in the energy's unit."""
        return QuadCorners.of(x[self.quads], self.normals, self.scales, self.counted, self.delta)

    def sigma(self, x: np.ndarray) -> np.ndarray:
        """Compute the least sigma of the counted corners of each quad, (f,): in squares of the energy's unit."""
        sigma = self.corners(x).sigma
        return np.where(self.counted, sigma, np.inf).min(axis=1, initial=np.inf)

    def of_kernels(self, unit: float) -> sliding_surface.SurfaceTerm:
        """Return the term as the kernels of local methods take it, with `delta` in units of a node's patch.

        Parameters
        ----------
        unit : float
            The energy's unit of length in the unit of the points that the kernels are given.
        """
        scales = None
        if self.has_lengths:
            scales = np.ascontiguousarray(self.scales.transpose(1, 2, 0)).reshape(-1, 8) / unit
        counted = self.counted.view(np.uint8)
        return sliding_surface.SurfaceTerm(counted, self.normals, scales, self.weight, self.delta)
