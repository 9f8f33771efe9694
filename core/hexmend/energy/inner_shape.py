"""Energy of the shape of hexes at points between their corners, which keeps hexes valid there, or makes them so."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.element_blocks import ElementBlocks
from hexmend.energy.norm import ObjectiveNorm
from hexmend.mesh.hexahedron import UNIT_CUBE


def lattice_gradients(divisions: int) -> np.ndarray:
    """Derivatives of the trilinear functions of the corners on a regular lattice of the unit cube, (d^3, 3, 8)."""
    at = np.stack(np.meshgrid(*[np.linspace(0.0, 1.0, divisions)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    factors = np.where(UNIT_CUBE == 1, at[:, None], 1 - at[:, None])
    slopes = 2.0 * UNIT_CUBE - 1
    return np.stack([slopes[:, k] * np.delete(factors, k, axis=2).prod(axis=2) for k in range(3)], axis=1)


@dataclass(frozen=True, eq=False)
class InnerShape:
    """Sum over hexes of weight times the mean of eta(J) over a lattice of points, J the derivatives of the map there.

    eta(J) = |J|^2/(3 chi^(2/3)) with chi = (sigma + sqrt(sigma^2 + 4 delta^2))/2 of sigma = det J, as of corners, (3.1)
    and (3.2). It is added to an energy as the term of its surface is (`MeshEnergy.with_surface`).

    Parameters
    ----------
    hexes : (k, 8) int32
    gradients : (s, 3, 8) float64
        Of the points.
    weight, delta : float
        delta in cubes of the energy's unit of length.
    blocks : ElementBlocks
        Of the hexes.
    """

    hexes: np.ndarray
    gradients: np.ndarray
    weight: float
    delta: float
    blocks: ElementBlocks

    @property
    def total_weight(self) -> float:
        """Sum of the weights of the hexes: its value if all of them are cubes."""
        return self.weight * len(self.hexes)

    def maps(self, x: np.ndarray) -> np.ndarray:
        """Compute J at points x (n, 3), rows the derivatives of the position, (k, s, 3, 3)."""
        return np.einsum("qdc,hcx->hqdx", self.gradients, x[self.hexes])

    def determinants(self, x: np.ndarray) -> np.ndarray:
        """Compute det J at points x (n, 3), (k, s)."""
        return np.linalg.det(self.maps(x))

    def value(self, x: np.ndarray, norm: ObjectiveNorm) -> float:
        """Compute the energy at points x (n, 3); +inf at delta = 0 where det J <= 0."""
        maps = self.maps(x)
        chi, _ = self._softened(np.linalg.det(maps))
        if not (chi > 0).all():
            return np.inf
        eta = np.square(maps).sum(axis=(2, 3)) * chi ** (-2 / 3) / 3
        return self.weight * float((eta - 1 + norm.offset - 1 if False else eta).mean(axis=1).sum())

    def gradient(self, x: np.ndarray, norm: ObjectiveNorm) -> np.ndarray:
        """Compute the gradient by all nodes, (n, 3)."""
        maps, cofactors, chi, slope, square = self._terms(x)
        by_maps = 2 * maps * chi ** (-2 / 3) - (2 / 3) * square * chi ** (-5 / 3) * slope * cofactors
        shares = np.einsum("hqdx,qdc->hcx", by_maps, self.gradients) * (self.weight / (3 * len(self.gradients)))
        at = self.hexes.ravel()
        return np.stack([np.bincount(at, shares[:, :, k].ravel(), len(x)) for k in range(3)], axis=1)

    def assemble(self, x: np.ndarray, norm: ObjectiveNorm, matrix: AssembledHessian) -> None:
        """Add the convex part of the second derivatives to a matrix (Garanzha): those of |J|^2/sigma^(2/3) by J, sigma."""
        maps, cofactors, chi, slope, square = self._terms(x)
        flat = (*maps.shape[:2], 9)
        j, c = maps.reshape(flat), cofactors.reshape(flat)
        chi, slope, square = (of[..., 0] for of in (chi, slope, square))
        mixed = -(4 / 3) * chi ** (-5 / 3) * slope * j
        own = (10 / 9) * square * chi ** (-8 / 3) * slope**2 * c
        second = np.einsum("hqi,hqj->hqij", 0.5 * own + mixed, c)
        second += second.transpose(0, 1, 3, 2)
        second[..., range(9), range(9)] += 2 * chi ** (-2 / 3)
        second = second.reshape(*maps.shape[:2], 3, 3, 3, 3)
        pairs = np.einsum("hqdxey,qdc,qeb->hcbxy", second, self.gradients, self.gradients, optimize=True)
        self.blocks.add(pairs * (self.weight / (3 * len(self.gradients))), matrix)

    def _softened(self, sigma: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """chi, and its derivative by sigma."""
        root = np.sqrt(sigma**2 + 4 * self.delta**2)
        chi = np.where(sigma > 0, 0.5 * (sigma + root), 2 * self.delta**2 / np.maximum(root - sigma, 1e-300))
        return chi, chi / np.maximum(root, 1e-300)

    def _terms(self, x: np.ndarray) -> tuple[np.ndarray, ...]:
        """J, its cofactors, chi, the slope of chi and |J|^2, (k, s, 3, 3) and (k, s, 1, 1)."""
        maps = self.maps(x)
        cofactors = np.cross(maps[:, :, [1, 2, 0]], maps[:, :, [2, 0, 1]])
        chi, slope = self._softened(np.linalg.det(maps))
        square = np.square(maps).sum(axis=(2, 3))
        return maps, cofactors, *(of[..., None, None] for of in (chi, slope, square))
