"""Part of a mesh around some of its nodes, which alone are moved."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import index_of, mask
from hexmend.energy import MeshEnergy
from hexmend.mesh.mesh import Mesh


class Region:
    """Some free nodes of a mesh and those tied to them, with all hexes at these nodes; other nodes stay.

    Parameters
    ----------
    energy : MeshEnergy
        Of the whole mesh; it has parts.
    moves : (n,) bool
        The nodes; fixed ones stay.
    x : (n, 3) float64, optional
        Positions of all nodes, in mean edge lengths, if the energy has a term of the boundary.

    Attributes
    ----------
    energy : MeshEnergy
        Of the part, at positions in the whole mesh's mean edge length.
    hexes : (j,) int64
        Hexes of the part, ascending.
    nodes : (p,) int64
        Nodes of these hexes, ascending.
    """

    def __init__(self, energy: MeshEnergy, moves: np.ndarray, x: np.ndarray | None = None):
        mesh = energy.mesh
        moves = energy.with_tied(moves & mesh.free) & mesh.free
        attached = np.flatnonzero(moves[mesh.elements].any(axis=1))
        self.hexes = attached = attached if attached.size else np.array([0])  # those that move are other ranks'
        self.nodes = np.flatnonzero(mask(mesh.elements[attached], mesh.n_nodes))
        number = index_of(self.nodes, mesh.n_nodes)
        part = Mesh.of_cells(mesh.points[self.nodes], number[mesh.elements[attached]], ~moves[self.nodes])
        self.energy = energy.on_part(part, attached, self.nodes, x)

    def inside(self, x: np.ndarray) -> np.ndarray:
        """Select the positions of the part's nodes from all positions x (n, 3)."""
        return x[self.nodes]

    def merged(self, x: np.ndarray, part: np.ndarray) -> np.ndarray:
        """Return x (n, 3) with the positions of the part's nodes."""
        merged = x.copy()
        merged[self.nodes] = part
        return merged
