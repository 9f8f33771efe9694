"""Barrier of floors that the scaled Jacobians and the qualities of hexes must not fall below."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.kernels import floor_barrier as kernels
from hexmend.kernels import threads
from hexmend.kernels.target import TargetMatrices


@dataclass(frozen=True, eq=False)
class FloorBarrier:
    """Barrier that is added to the energy of a mesh: infinite at the floors of its hexes, 0 a band above them.

    With y = (value - floor)/band for the scaled Jacobian of a corner, and for q(H), each contributes weight (-log y +
    (y - 1) - (y - 1)²/2) where y < 1. It has two continuous derivatives, and what is far above its floor takes no part.

    Parameters
    ----------
    jacobians : (m,) float64
        Floors of the scaled Jacobians of each hex's corners; -inf: none.
    qualities : (m,) float64
        Floors of q(H), with a target that of S W^-1; -inf: none.
    ignored : (m,) uint8
        Bit t set: corner t has no floor.
    jacobian_band, quality_band : float
        Widths of the bands.
    weight : float
    """

    jacobians: np.ndarray
    qualities: np.ndarray
    ignored: np.ndarray
    jacobian_band: float
    quality_band: float
    weight: float

    @cached_property
    def _floors(self) -> kernels.Floors:
        arrays = self.jacobians, self.qualities, self.ignored
        return kernels.Floors(*arrays, self.jacobian_band, self.quality_band, self.weight)

    def on_part(self, hexes: np.ndarray) -> FloorBarrier:
        """Return the barrier of some hexes (k,)."""
        arrays = (floors.take(hexes, axis=0) for floors in (self.jacobians, self.qualities, self.ignored))
        return FloorBarrier(*arrays, self.jacobian_band, self.quality_band, self.weight)

    def hex_values(
        self, x: np.ndarray, hexes: np.ndarray, omitted: np.ndarray, target: TargetMatrices | None
    ) -> np.ndarray:
        """Compute the barrier of each hex, (m,) float64; +inf for a hex at or below a floor.

        Parameters
        ----------
        x : (n, 3) float64
            Points in the unit of the energy.
        hexes : (m, 8) int32
        omitted : (m,) uint8
            Corners that count as perfect in eta; see `MeshEnergy`.
        target : TargetMatrices, optional
        """
        values = np.empty(len(hexes))
        kernels.values(x, hexes, self._floors, omitted, values, target)
        return values

    def add_gradient(
        self, x: np.ndarray, hexes: np.ndarray, omitted: np.ndarray, shares: np.ndarray, target: TargetMatrices | None
    ) -> None:
        """Add its gradient to the contributions of each hex at its corners, shares (m, 8, 3); see `hex_values`."""
        kernels.add_gradient(x, hexes, self._floors, omitted, shares, target)

    def assemble(
        self, x: np.ndarray, omitted: np.ndarray, matrix: AssembledHessian, target: TargetMatrices | None
    ) -> None:
        """Add its Hessian to a matrix; see `hex_values`."""
        shares = matrix.sparsity.shares(threads())
        kernels.assemble(x, self._floors, omitted, shares, matrix.off_diagonal, matrix.diagonal, target)
