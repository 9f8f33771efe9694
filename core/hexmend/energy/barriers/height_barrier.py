"""Barrier of a floor of the heights of hexes at their corners, which bound the explicit time step."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.barriers.corner_heights import corner_heights, height_gradients
from hexmend.energy.element_blocks import ElementBlocks
from hexmend.kernels.target import TargetMatrices
from hexmend.mesh.solid_cells import corner_tetrahedra, rows_by_kind


@dataclass(frozen=True, eq=False)
class HeightBarrier:
    """Barrier as `FloorBarrier`, of the three heights at each corner that counts, in a unit of length.

    Parameters
    ----------
    hexes : (m, 8) int32
    counted : (m, 8) bool
        Corners that have a floor.
    floor, band, weight : float
    unit : float
        Length of a height of 1, in the energy's unit.
    """

    hexes: np.ndarray
    counted: np.ndarray
    floor: float
    band: float
    weight: float
    unit: float

    def on_part(self, hexes: np.ndarray) -> HeightBarrier:
        """Return the barrier of some hexes (k,)."""
        return replace(self, hexes=self.hexes[hexes], counted=self.counted[hexes])

    def hex_values(
        self, x: np.ndarray, hexes: np.ndarray, omitted: np.ndarray, target: TargetMatrices | None
    ) -> np.ndarray:
        """See `FloorBarrier.hex_values`."""
        z = np.minimum(self._positions(x), 1.0) - 1
        with np.errstate(divide="ignore", invalid="ignore"):
            values = np.where(z > -1, -np.log1p(z) + z - z**2 / 2, np.inf)
        return self.weight * np.where(self.counted[:, :, None], values, 0.0).sum(axis=(1, 2))

    def add_gradient(
        self, x: np.ndarray, hexes: np.ndarray, omitted: np.ndarray, shares: np.ndarray, target: TargetMatrices | None
    ) -> None:
        """See `FloorBarrier.add_gradient`."""
        near, first, _, by_nodes = self._derivatives(x)
        shares[near] += np.einsum("hi,hinx->hnx", first, by_nodes)

    def assemble(
        self, x: np.ndarray, omitted: np.ndarray, matrix: AssembledHessian, target: TargetMatrices | None
    ) -> None:
        """Add the Gauss-Newton part of the second derivatives, without derivatives of heights: semidefinite."""
        near, _, second, by_nodes = self._derivatives(x)
        pairs = np.einsum("hi,hinx,himy->hnmxy", second, by_nodes, by_nodes)
        ElementBlocks(self.hexes[near]).add(pairs, matrix)

    def _positions(self, x: np.ndarray, hexes: np.ndarray | slice = slice(None)) -> np.ndarray:
        """Heights above the floor in bands, (k, 8, 3)."""
        corners = corner_tetrahedra(self.hexes[hexes]).reshape(-1, 4)
        return (corner_heights(x, corners).reshape(-1, 8, 3) / self.unit - self.floor) / self.band

    def _derivatives(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Hexes in the band (k,), derivatives by 24 heights (k, 24) twice, and of these by nodes (k, 24, 8, 3)."""
        least = np.where(self.counted[:, :, None], self._positions(x), np.inf)
        near = np.flatnonzero((least < 1).any(axis=(1, 2)))
        z = np.minimum(least[near].reshape(-1, 24), 1.0)
        first, second = self.weight / self.band * (2 - z - 1 / z), self.weight / self.band**2 * (1 / z**2 - 1)
        corners = corner_tetrahedra(self.hexes[near]).reshape(-1, 4)
        slopes = height_gradients(x, corners)[1].reshape(-1, 8, 3, 4, 3) / self.unit
        by_nodes = np.zeros((len(near), 8, 3, 8, 3))
        for kind, rows in rows_by_kind(self.hexes[near]):
            own = by_nodes[rows]
            for corner, nodes in enumerate(kind.corners):
                own[:, corner][:, :, nodes] = slopes[rows, corner]
            by_nodes[rows] = own
        return near, first, second, by_nodes.reshape(-1, 24, 8, 3)
