"""Barrier of the Bernstein coefficients of det J of some hexes, which keeps these hexes valid, or makes them so."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.element_blocks import ElementBlocks
from hexmend.energy.norm import ObjectiveNorm
from hexmend.kernels import validity as kernels
from hexmend.mesh.hexahedron import UNIT_CUBE

#: Places 0, 1/2 and 1 along each axis of the unit cube, (27, 3), x slowest.
_LATTICE = np.stack(np.meshgrid(*[[0.0, 0.5, 1.0]] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
#: Bernstein coefficients of a polynomial of degree 2 by its values there, along one axis, and those of its quarters
#: by its own: the nearer to the values, the less the barrier asks for more than validity.
_ALONG = np.array([[1.0, 0.0, 0.0], [-0.5, 2.0, -0.5], [0.0, 0.0, 1.0]])
_HALVED = np.array([[1.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.25, 0.5, 0.25], [0.0, 0.5, 0.5], [0.0, 0.0, 1.0]])
import os
LEV=int(os.environ.get("LEV","1"))
_PARTS = _HALVED
if LEV==0: _PARTS=np.eye(3)
if LEV==2: _PARTS=np.concatenate([_HALVED@_HALVED[:3], (_HALVED@_HALVED[2:])[1:]])
_OF_PARTS = np.einsum("ai,bj,ck->abcijk", _PARTS, _PARTS, _PARTS).reshape(len(_PARTS)**3, 27)
_COEFFICIENTS = _OF_PARTS @ np.einsum("ai,bj,ck->abcijk", _ALONG, _ALONG, _ALONG).reshape(27, 27)


def _gradients() -> np.ndarray:
    """Derivatives of the trilinear functions of the corners at the lattice, (27, 3, 8)."""
    factors = np.where(UNIT_CUBE == 1, _LATTICE[:, None], 1 - _LATTICE[:, None])
    slopes = 2.0 * UNIT_CUBE - 1
    return np.stack([slopes[:, k] * np.delete(factors, k, axis=2).prod(axis=2) for k in range(3)], axis=1)


_GRADIENTS = _gradients()


def _coefficients(x: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    found = np.empty((len(hexes), 27))
    kernels.jacobian_coefficients(x, hexes, found)
    return found @ _OF_PARTS.T


@dataclass(frozen=True, eq=False)
class ValidityBarrier:
    """Sum of weight b((B - floor)/band) over the Bernstein coefficients B of det J of some hexes, relative to `sizes`.

    b(y) = -log y + (y - 1) - (y - 1)²/2 below y = 1, else 0, as of `FloorBarrier`. A hex is valid where its floor is 0 or
    more. It is added to an energy as the term of its surface is (`MeshEnergy.with_surface`).

    Parameters
    ----------
    hexes : (k, 8) int32
    sizes : (k,) float64
        Values of det J to which coefficients are relative, in cubes of the energy's unit of length.
    floors : (k,) float64
    band, weight : float
    blocks : ElementBlocks
        Of the hexes.
    """

    hexes: np.ndarray
    sizes: np.ndarray
    floors: np.ndarray
    band: float
    weight: float
    blocks: ElementBlocks

    #: It adds nothing to the energy of perfect hexes.
    total_weight = 0.0

    @classmethod
    def of(cls, hexes: np.ndarray, x: np.ndarray, band: float, weight: float) -> ValidityBarrier:
        """Make the barrier of hexes (k, 8) at points x (n, 3): floors are half a band below the least."""
        found = _coefficients(x, hexes)
        sizes = np.abs(found).max(axis=1)
        return cls(hexes, sizes, found.min(axis=1) / sizes - 0.5 * band, band, weight, ElementBlocks(hexes))

    def least(self, x: np.ndarray) -> np.ndarray:
        """Return the least coefficient of each hex at points x (n, 3), relative to `sizes`, (k,)."""
        return self._relative(x).min(axis=1)

    def raised(self, x: np.ndarray, gap: float) -> ValidityBarrier:
        least = self.least(x)
        return replace(self, floors=np.maximum(self.floors, least - gap * np.maximum(-least, 0.02)))

    def value(self, x: np.ndarray, norm: ObjectiveNorm) -> float:
        """Compute the barrier at points x (n, 3); +inf where a coefficient is at its floor or below."""
        y = (self._relative(x) - self.floors[:, None]) / self.band
        if not (y > 0).all():
            return np.inf
        z = np.minimum(y, 1.0) - 1
        return self.weight * float((-np.log1p(z) + z - z**2 / 2).sum())

    def gradient(self, x: np.ndarray, norm: ObjectiveNorm) -> np.ndarray:
        """Compute the gradient by all nodes, (n, 3)."""
        first, _, by_nodes = self._derivatives(x)
        shares, at = np.einsum("hi,hicx->hcx", first, by_nodes), self.hexes.ravel()
        return np.stack([np.bincount(at, shares[:, :, k].ravel(), len(x)) for k in range(3)], axis=1)

    def assemble(self, x: np.ndarray, norm: ObjectiveNorm, matrix: AssembledHessian) -> None:
        """Add the second derivatives to a matrix, without those of the coefficients (Gauss-Newton): semidefinite."""
        _, second, by_nodes = self._derivatives(x)
        self.blocks.add(np.einsum("hi,hicx,hidy->hcdxy", second, by_nodes, by_nodes), matrix)

    def _relative(self, x: np.ndarray) -> np.ndarray:
        """Coefficients at points x (n, 3), (k, 27), relative to `sizes`."""
        return _coefficients(x, self.hexes) / self.sizes[:, None]

    def _derivatives(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """First and second derivatives of the barrier by coefficients, (k, 27), and of these by nodes, (k, 27, 8, 3)."""
        z = np.minimum((self._relative(x) - self.floors[:, None]) / self.band, 1.0)
        first = self.weight / self.band * (2 - z - 1 / z)
        second = self.weight / self.band**2 * (1 / z**2 - 1)
        rows = np.einsum("qdc,hcx->hqdx", _GRADIENTS, x[self.hexes])
        cofactors = np.cross(rows[:, :, [1, 2, 0]], rows[:, :, [2, 0, 1]])
        by_nodes = np.einsum("hqdx,qdc->hqcx", cofactors, _GRADIENTS)
        by_nodes = np.einsum("iq,hqcx->hicx", _COEFFICIENTS, by_nodes) / self.sizes[:, None, None, None]
        return first, second, by_nodes
