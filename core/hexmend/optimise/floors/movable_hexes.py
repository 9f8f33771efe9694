"""Minimum scaled Jacobians and qualities of the hexes of a mesh that can be improved, as nodes move."""

from __future__ import annotations

import numpy as np

from hexmend.energy import MeshEnergy
from hexmend.energy.barriers.floor_barrier import FloorBarrier
from hexmend.energy.barriers.height_barrier import HeightBarrier, corner_heights
from hexmend.energy.hex_energy import pack_corners
from hexmend.kernels import elements
from hexmend.kernels import floor_barrier as kernels
from hexmend.mesh.solid_cells import corner_tetrahedra, has_corner
from hexmend.quality import measure
from hexmend.quality.measure import fixed_tetrahedra


class MovableHexes:
    """Values of hexes with a free node; corners with four fixed nodes do not count.

    Parameters
    ----------
    energy : MeshEnergy

    Attributes
    ----------
    energy : MeshEnergy
    ignored : (m,) uint8
        Bit t set: the four nodes of corner t are fixed.
    """

    def __init__(self, energy: MeshEnergy):
        mesh = energy.mesh
        self.energy = energy
        locked = fixed_tetrahedra(mesh.elements, ~mesh.free)
        self.ignored, self._movable = pack_corners(locked), has_corner(mesh.elements) & ~locked
        self._partly = np.flatnonzero(locked.any(axis=1))
        self._locked = locked[self._partly]
        self._moves = mesh.free[mesh.elements].any(axis=1)
        self._judged = self._moves & (energy.omitted == 0)

    def jacobians(self, x: np.ndarray) -> np.ndarray:
        """Compute the minimum scaled Jacobian of each hex's movable corners at points x (n, 3), (m,); inf: none."""
        hexes = self.energy.mesh.elements
        least = measure(x, hexes).scaled_jacobian.copy()
        corners = scaled_jacobians(x, hexes[self._partly])
        least[self._partly] = np.where(self._locked, np.inf, corners).min(axis=1, initial=np.inf)
        return least

    def jacobians_of(self, x: np.ndarray, among: np.ndarray) -> np.ndarray:
        """Compute the minimum scaled Jacobians of some hexes (k,) int, (k,), as `jacobians`."""
        return self.corners_in_place(x, among).min(axis=1)

    def corners(self, x: np.ndarray) -> np.ndarray:
        """Compute the scaled Jacobians of the corners that can be moved at points x (n, 3), (c,)."""
        return self._corners(x)[self._movable]

    def corners_in_place(self, x: np.ndarray, among: np.ndarray | slice = slice(None)) -> np.ndarray:
        """Compute the scaled Jacobians of all corners at points x (n, 3), (m, 8); inf if it cannot be moved."""
        return np.where(self._movable[among], self._corners(x, among), np.inf)

    def locked_below(self, x: np.ndarray, least: float) -> np.ndarray:
        """Find the hexes with a lower corner that cannot be moved at points x (n, 3), (l,) int64, the lowest first."""
        values = np.full(self._movable.shape, np.inf)
        values[self._partly] = np.where(self._locked, self._corners(x, self._partly), np.inf)
        values = values.min(axis=1)
        below = np.flatnonzero(values < least)
        return below[np.argsort(values[below], kind="stable")]

    def _corners(self, x: np.ndarray, among: np.ndarray | slice = slice(None)) -> np.ndarray:
        return scaled_jacobians(x, self.energy.mesh.elements[among])

    def qualities(self, x: np.ndarray) -> np.ndarray:
        """Compute q(H) at points x (n, 3), with a target that of S W^-1, (m,); inf for a hex that cannot move.

        Hexes with corners that the energy omits have no value either, but inf.
        """
        values = np.empty(self.energy.mesh.n_elements)
        kernels.qualities(x, self.energy.mesh.elements, self.energy.omitted, values, self.energy.target)
        return np.where(self._judged, values, np.inf)

    def barrier(
        self, jacobian: float, quality: float, jacobian_band: float, quality_band: float, weight: float
    ) -> FloorBarrier | HeightBarrier:
        """Make the barrier of floors of all hexes: of their scaled Jacobians and of q(H); -inf: none."""
        jacobians = np.where(self._moves, jacobian, -np.inf)
        qualities = np.where(self._judged, quality, -np.inf)
        return FloorBarrier(jacobians, qualities, self.ignored, jacobian_band, quality_band, weight)


class MovableHeights(MovableHexes):
    """Heights at corners in a unit of length, in place of scaled Jacobians: they bound the time step.

    Parameters
    ----------
    energy : MeshEnergy
    unit : float
        In the energy's unit of length.
    """

    def __init__(self, energy: MeshEnergy, unit: float):
        super().__init__(energy)
        self._unit = unit

    def jacobians(self, x: np.ndarray) -> np.ndarray:
        """Compute the least height of each hex's movable corners at points x (n, 3), (m,); inf: none."""
        return self.corners_in_place(x).min(axis=1)

    def _corners(self, x: np.ndarray, among: np.ndarray | slice = slice(None)) -> np.ndarray:
        corners = corner_tetrahedra(self.energy.mesh.elements[among]).reshape(-1, 4)
        return corner_heights(x, corners).min(axis=1).reshape(-1, 8) / self._unit

    def corners(self, x: np.ndarray) -> np.ndarray:
        """Compute the three heights of the corners that can be moved at points x (n, 3), (c,)."""
        corners = corner_tetrahedra(self.energy.mesh.elements)[self._movable]
        return corner_heights(x, corners).ravel() / self._unit

    def barrier(
        self, jacobian: float, quality: float, jacobian_band: float, quality_band: float, weight: float
    ) -> HeightBarrier:
        """Make the barrier of a floor of all heights; there is none of q(H)."""
        return HeightBarrier(self.energy.mesh.elements, self._movable, jacobian, jacobian_band, weight, self._unit)


def scaled_jacobians(points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Compute the scaled Jacobian of each corner of hexes, (k, 8) in [-1, 1]; -1 where an edge has no length.

    Parameters
    ----------
    points : (n, 3) float64
        Contiguous, as all arrays here.
    hexes : (k, 8) int32

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> scaled_jacobians(UNIT_CUBE, np.arange(8, dtype=np.int32)[None])
    array([[1., 1., 1., 1., 1., 1., 1., 1.]])
    """
    values = np.empty((len(hexes), 8))
    elements.corner_jacobians(points, hexes, values)
    return values
