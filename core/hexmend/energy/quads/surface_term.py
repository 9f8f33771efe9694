"""Term of an energy that the quads of a sliding boundary add: value, gradient, and blocks of the Hessian."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.element_blocks import ElementBlocks
from hexmend.energy.norm import ObjectiveNorm
from hexmend.energy.quads.quad_energy import QuadCorners, power_derivatives
from hexmend.kernels import sliding_surface


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
    blocks : ElementBlocks
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
    blocks: ElementBlocks
    has_lengths: bool = False

    limits_moves = False

    @property
    def total_weight(self) -> float:
        """Sum of the weights of the quads: the term has so many times the value of a hex if all of them are squares."""
        return self.weight * len(self.quads)

    def value(self, x: np.ndarray, norm: ObjectiveNorm) -> float:
        """Compute the term at points x (n, 3) in the energy's unit; +inf at delta = 0 with a flipped corner."""
        with np.errstate(over="ignore"):
            energy = np.maximum(self.corners(x).energies(norm.offset), 0.0)
            return self.weight * float(np.power(energy, norm.p).sum())

    def beyond(self, x: np.ndarray, there: np.ndarray) -> None:
        """Return None: it limits no moves; see `hexmend.energy.terms.Term`."""

    def on_part(self, nodes: np.ndarray, moves: np.ndarray, x: np.ndarray) -> Self:
        """Raise `NotImplementedError`: it is made for what moves."""
        raise NotImplementedError

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
        self.blocks.add(pairs, matrix)

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
