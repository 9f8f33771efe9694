"""Part of a mesh around some of its hexes, whose nodes alone are moved."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import index_of, mask
from hexmend.energy import MeshEnergy
from hexmend.mesh.mesh import Mesh


class Region:
    """The free nodes of some hexes, with all hexes at these nodes; other nodes stay.

    Parameters
    ----------
    energy : MeshEnergy
        Of the whole mesh; it has parts.
    hexes : (k,) int
        Hexes whose free nodes move.
    x : (n, 3) float64
        Positions of all nodes, in mean edge lengths.

    Attributes
    ----------
    energy : MeshEnergy
        Of the part, at positions in the whole mesh's mean edge length.
    hexes : (j,) int64
        Hexes of the part, ascending.
    """

    def __init__(self, energy: MeshEnergy, hexes: np.ndarray, x: np.ndarray):
        mesh = energy.mesh
        moves = energy.ranks.complete(mask(mesh.hexes[hexes], mesh.n_nodes) & mesh.free)
        attached = np.flatnonzero(moves[mesh.hexes].any(axis=1))
        self.hexes = attached = attached if attached.size else np.array([0])  # those that move are other ranks'
        self._nodes = np.flatnonzero(mask(mesh.hexes[attached], mesh.n_nodes))
        number = index_of(self._nodes, mesh.n_nodes)
        part = Mesh(mesh.points[self._nodes], number[mesh.hexes[attached]]).with_fixed(~moves[self._nodes])
        self.energy = energy.on_part(part, attached, self._nodes, x)

    def inside(self, x: np.ndarray) -> np.ndarray:
        """Select the positions of the part's nodes from all positions x (n, 3)."""
        return x[self._nodes]

    def merged(self, x: np.ndarray, part: np.ndarray) -> np.ndarray:
        """Return x (n, 3) with the positions of the part's nodes."""
        merged = x.copy()
        merged[self._nodes] = part
        return merged
