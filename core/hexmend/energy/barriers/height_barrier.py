"""Barrier of a floor of the heights of hexes at their corners, which bound the explicit time step.

Heights of single corners over their three faces, and their derivatives.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.terms import ElementBlocks
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


def corner_heights(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Compute the heights of corners (k, 4), the apex and the ends of its edges each, over their faces, (k, 3).

    Height i is that of edge i over the face of the other two; 0 over a face without area.
    """
    return _terms(points, corners)[0]


def height_gradients(points: np.ndarray, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Compute the heights of corners with their derivatives by the four nodes.

    Parameters
    ----------
    points : (n, 3) float64
    corners : (k, 4) int
        Apex and ends of the edges of each corner.

    Returns
    -------
    values : (k, 3)
    derivatives : (k, 3, 4, 3)
        With h = u·n / |n| and n = v x w: dh/du = n/|n|, dh/dv = w x t and dh/dw = t x v, where t = (u - h n/|n|) / |n|;
        of the apex minus their sum. 0 over a face without area.
    """
    heights, edges, normals, areas = _terms(points, corners)
    derivatives = np.zeros((len(corners), 3, 4, 3))
    divisor = np.where(areas > 0, areas, 1.0)[:, :, None]
    unit = normals / divisor
    offset = (edges - heights[:, :, None] * unit) / divisor * (areas > 0)[:, :, None]  # t
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        derivatives[:, i, 1 + i] = unit[:, i]
        derivatives[:, i, 1 + j] = np.cross(edges[:, k], offset[:, i])
        derivatives[:, i, 1 + k] = np.cross(offset[:, i], edges[:, j])
    derivatives[:, :, 0] = -derivatives[:, :, 1:].sum(axis=2)
    return heights, derivatives


def _terms(points: np.ndarray, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Heights (k, 3), edges (k, 3, 3) by rows, normals of the other two (k, 3, 3), the lengths of these (k, 3)."""
    x = points[corners]
    edges = x[:, 1:] - x[:, :1]
    normals = np.cross(np.roll(edges, -1, axis=1), np.roll(edges, -2, axis=1))
    areas = np.linalg.norm(normals, axis=2)
    volume = np.einsum("ki,ki->k", edges[:, 0], normals[:, 0])
    return np.where(areas > 0, volume[:, None] / np.where(areas > 0, areas, 1.0), 0.0), edges, normals, areas
