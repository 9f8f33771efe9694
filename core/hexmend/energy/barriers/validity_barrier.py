"""Barrier of the Bernstein coefficients of det J of some hexes, which keeps these hexes valid, or makes them so."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.norm import ObjectiveNorm
from hexmend.energy.terms import ElementBlocks, Term
from hexmend.kernels import validity as kernels
from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.solid_cells import kinds_of

#: Places 0, 1/2 and 1 along each axis of the unit cube, (27, 3), x slowest.
_LATTICE = np.stack(np.meshgrid(*[[0.0, 0.5, 1.0]] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
#: Bernstein coefficients of a polynomial of degree 2 by its values at 0, 1/2 and 1.
_BY_VALUES = np.array([[1.0, 0.0, 0.0], [-0.5, 2.0, -0.5], [0.0, 0.0, 1.0]])
#: Coefficients of its halves by its own: nearer to the values, so that the barrier asks for little more than validity.
_OF_HALVES = np.array([[1.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.25, 0.5, 0.25], [0.0, 0.5, 0.5], [0.0, 0.0, 1.0]])


def _along_three_axes(matrix: np.ndarray) -> np.ndarray:
    """The matrix of polynomials of three variables by that of one."""
    width, given = matrix.shape
    return np.einsum("ai,bj,ck->abcijk", matrix, matrix, matrix).reshape(width**3, given**3)


def _gradients() -> np.ndarray:
    """Matrices by which the nodes of each kind give the matrices whose determinants are the values at the lattice.

    These are J of hexes, and of other kinds what `native/mesh/validity.cpp` certifies, (kinds, 27, 3, 8).
    """
    factors = np.where(UNIT_CUBE == 1, _LATTICE[:, None], 1 - _LATTICE[:, None])
    slopes = 2.0 * UNIT_CUBE - 1
    hexes = np.stack([slopes[:, k] * np.delete(factors, k, axis=2).prod(axis=2) for k in range(3)], axis=1)
    (u, v, w), one = _LATTICE.T, np.ones(len(_LATTICE))
    u0, v0, w0 = 1 - _LATTICE.T
    first, second, third = v0 * u0 + v * u, v0 * u, v * u0  # of the triangle's corners, at a point of the square
    wedges, pyramids, tetrahedra = np.zeros((3, len(_LATTICE), 3, 8))
    wedges[:, 0, [0, 1, 3, 4]] = np.stack([-w0, w0, -w, w], axis=1)
    wedges[:, 1, [0, 2, 3, 5]] = np.stack([-w0, w0, -w, w], axis=1)
    wedges[:, 2, :6] = np.stack([-first, -second, -third, first, second, third], axis=1)
    pyramids[:, 0, :4] = np.stack([-v0, v0, v, -v], axis=1)
    pyramids[:, 1, :4] = np.stack([-u0, -u, u, u0], axis=1)
    pyramids[:, 2, :5] = np.stack([-u0 * v0, -u * v0, -u * v, -u0 * v, one], axis=1)
    tetrahedra[:, :, 0], tetrahedra[:, range(3), range(1, 4)] = -1, 1
    return np.stack([hexes, wedges, pyramids, tetrahedra])


_GRADIENTS = _gradients()
_HALVED = _along_three_axes(_OF_HALVES)
_COEFFICIENTS = _HALVED @ _along_three_axes(_BY_VALUES)


@dataclass(frozen=True, eq=False)
class ValidityBarrier(Term):
    """Sum of weight b((B - floor)/band) over the Bernstein coefficients B of det J of the eighths of some hexes.

    b(y) = -log y + (y - 1) - (y - 1)²/2 below y = 1, else 0, as of `FloorBarrier`. Coefficients are relative to
    `sizes`; a hex is valid where its floor is 0 or more. The barrier is added to an energy as the term of its surface
    is (`MeshEnergy.with_surface`).

    Parameters
    ----------
    hexes : (k, 8) int32
        Cells of any kinds.
    sizes : (k,) float64
        Greatest coefficient of each hex at first, in cubes of the energy's unit of length.
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

    @classmethod
    def of(cls, hexes: np.ndarray, x: np.ndarray, band: float, weight: float) -> ValidityBarrier:
        """Make the barrier of hexes (k, 8) at points x (n, 3): floors half a band below the least coefficients."""
        found = _coefficients(hexes, x)
        sizes = np.abs(found).max(axis=1)
        return cls(hexes, sizes, found.min(axis=1) / sizes - 0.5 * band, band, weight, ElementBlocks(hexes))

    def with_higher_floors(self, x: np.ndarray, gap: float) -> ValidityBarrier:
        """Return the barrier with floors raised towards the least coefficients at points x (n, 3).

        Parameters
        ----------
        x : (n, 3) float64
        gap : float
            Distance that is left, as a share of the coefficient, or of a fifth of the band where that is larger.
        """
        least = self._relative(x).min(axis=1)
        return replace(self, floors=np.maximum(self.floors, least - gap * np.maximum(-least, 0.2 * self.band)))

    @property
    def deficit(self) -> float:
        """Sum of the floors below 0, positive."""
        return float(-np.minimum(self.floors, 0.0).sum())

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
        """Add the Gauss-Newton part of the second derivatives, without derivatives of coefficients: semidefinite."""
        _, second, by_nodes = self._derivatives(x)
        self.blocks.add(np.einsum("hi,hicx,hidy->hcdxy", second, by_nodes, by_nodes), matrix)

    def _relative(self, x: np.ndarray) -> np.ndarray:
        """Coefficients at points x (n, 3), (k, 125), relative to `sizes`."""
        return _coefficients(self.hexes, x) / self.sizes[:, None]

    def _derivatives(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Derivatives of the barrier by coefficients, (k, 125) twice, and of these by nodes, (k, 125, 8, 3)."""
        z = np.minimum((self._relative(x) - self.floors[:, None]) / self.band, 1.0)
        first = self.weight / self.band * (2 - z - 1 / z)
        second = self.weight / self.band**2 * (1 / z**2 - 1)
        gradients = _GRADIENTS[kinds_of(self.hexes)]
        maps = np.einsum("hqdc,hcx->hqdx", gradients, x[self.hexes])
        cofactors = np.cross(maps[:, :, [1, 2, 0]], maps[:, :, [2, 0, 1]])
        of_values = np.einsum("hqdx,hqdc->hqcx", cofactors, gradients)
        by_nodes = np.einsum("iq,hqcx->hicx", _COEFFICIENTS, of_values) / self.sizes[:, None, None, None]
        return first, second, by_nodes


def _coefficients(hexes: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Bernstein coefficients of det J of the eighths of hexes (k, 8) at points x (n, 3), (k, 125)."""
    found = np.empty((len(hexes), 27))
    kernels.jacobian_coefficients(x, hexes, found)
    return found @ _HALVED.T
