"""Minimum scaled Jacobians and qualities of the hexes of a mesh that can be improved, as nodes move."""

from __future__ import annotations

import numpy as np

from hexmend.energy import MeshEnergy
from hexmend.energy.floor_barrier import FloorBarrier
from hexmend.energy.hex_energy import pack_corners
from hexmend.kernels import floor_barrier as kernels
from hexmend.optimise.maxmin.corner_values import scaled_jacobians
from hexmend.quality import measure
from hexmend.quality.measure import fixed_tetrahedra


class MovableHexes:
    """Values of hexes of which a node is free; corners with four fixed nodes do not count.

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
        locked = fixed_tetrahedra(mesh.hexes, ~mesh.free)
        self.ignored = pack_corners(locked)
        self._partly = np.flatnonzero(locked.any(axis=1))
        self._locked = locked[self._partly]
        self._moves = mesh.free[mesh.hexes].any(axis=1)
        self._judged = self._moves & (energy.omitted == 0)

    def jacobians(self, x: np.ndarray) -> np.ndarray:
        """Compute the minimum scaled Jacobian of each hex's movable corners at points x (n, 3), (m,); inf: none."""
        hexes = self.energy.mesh.hexes
        least = measure(x, hexes).scaled_jacobian.copy()
        corners = scaled_jacobians(x, hexes[self._partly])
        least[self._partly] = np.where(self._locked, np.inf, corners).min(axis=1, initial=np.inf)
        return least

    def qualities(self, x: np.ndarray) -> np.ndarray:
        """Compute q(H) at points x (n, 3), with a target that of S W^-1, (m,); inf for a hex that cannot move.

        Hexes with corners that the energy omits have no value either, but inf.
        """
        values = np.empty(self.energy.mesh.n_hexes)
        kernels.qualities(x, self.energy.mesh.hexes, self.energy.omitted, values, self.energy.target)
        return np.where(self._judged, values, np.inf)

    def barrier(
        self, jacobian: float, quality: float, jacobian_band: float, quality_band: float, weight: float
    ) -> FloorBarrier:
        """Make the barrier of floors of all hexes: of their scaled Jacobians and of q(H); -inf: none."""
        jacobians = np.where(self._moves, jacobian, -np.inf)
        qualities = np.where(self._judged, quality, -np.inf)
        return FloorBarrier(jacobians, qualities, self.ignored, jacobian_band, quality_band, weight)
