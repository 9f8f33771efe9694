"""The corners of a mesh that can be moved, with their scaled Jacobians."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.components import components
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.maxmin.corner_values import scaled_jacobians
from hexmend.quality.measure import fixed_tetrahedra


class MovableCorners:
    """The corners that have a free node, and their scaled Jacobians as nodes move.

    Parameters
    ----------
    mesh : Mesh
        Whose free nodes are moved.
    points : (n, 3) float64
        Where its nodes are.

    Attributes
    ----------
    mesh : Mesh
    values : (m, 8) float64
        The scaled Jacobian of each corner, those that cannot be moved too.
    frozen : (m, 8) bool
        Corners that could be moved, but none of whose nodes moves any more.
    """

    def __init__(self, mesh: Mesh, points: np.ndarray):
        self.values = scaled_jacobians(points, mesh.hexes)
        self.frozen = np.zeros(self.values.shape, dtype=bool)
        self._stays = np.zeros(mesh.n_nodes, dtype=bool)
        self.set_mesh(mesh)

    def set_mesh(self, mesh: Mesh) -> None:
        """Take a mesh of which other nodes are fixed."""
        self.mesh = mesh
        self._locked = fixed_tetrahedra(mesh.hexes, ~mesh.free)

    def active_values(self) -> np.ndarray:
        """The values, +inf of corners that cannot be moved or are settled, (m, 8) float64."""
        return np.where(self._locked | self.frozen, np.inf, self.values)

    @property
    def least(self) -> float:
        """The least value of the corners that are raised; +inf where there is none."""
        return float(self.active_values().min(initial=np.inf))

    @property
    def least_of_all(self) -> float:
        """The least value of all corners that can be moved, settled or not; +inf where there is none."""
        return float(np.where(self._locked, np.inf, self.values).min(initial=np.inf))

    def locked_below(self, value: float) -> np.ndarray:
        """Corners, 8 * hex + corner, lower than a value, all of whose nodes are fixed, the lowest first, (k,) int64."""
        values = np.where(self._locked, self.values, np.inf).ravel()
        low = np.flatnonzero(values < value)
        return low[np.argsort(values[low], kind="stable")]

    def freeze(self, corners: np.ndarray) -> None:
        """Let corners, 8 * hex + corner, be, (k,), and their nodes stay; others with no node left are settled too."""
        self._stays[self.nodes_of(corners)] = True
        moves = self.mesh.free & ~self._stays
        self.frozen = ~moves[self.mesh.hexes[:, CORNER_TETRAHEDRA]].any(axis=2) & ~self._locked

    def unfreeze(self) -> None:
        """Let everything be moved again that is free."""
        self.frozen[:] = self._stays[:] = False

    def movable(self, nodes: np.ndarray) -> np.ndarray:
        """Those of some nodes that are free and need not stay, (k,) int."""
        return nodes[self.mesh.free[nodes] & ~self._stays[nodes]]

    def nodes_of(self, corners: np.ndarray) -> np.ndarray:
        """Apex and ends of corners, 8 * hex + corner, (k, 4) int32."""
        return np.take_along_axis(self.mesh.hexes[corners // 8], CORNER_TETRAHEDRA[corners % 8], axis=1)

    def groups(self, corners: np.ndarray) -> np.ndarray:
        """The group that each of some corners, 8 * hex + corner, belongs to, (k,) int from 0.

        Corners of one group have free nodes in common, directly or by others of them: only those bear on each other.
        """
        nodes, count = self.nodes_of(corners), len(corners)
        corner, end = np.nonzero(self.mesh.free[nodes])
        slot = np.unique(nodes, return_inverse=True)[1].reshape(nodes.shape)
        links = np.column_stack([corner, count + slot[corner, end]])
        return components(count + nodes.size, links)[:count]

    def hexes_at(self, nodes: np.ndarray) -> np.ndarray:
        """Hexes that have one of some nodes, ascending, (k,) int."""
        return np.unique(self.mesh.topology.node_corners.of(nodes) // 8)

    def update(self, points: np.ndarray, hexes: np.ndarray) -> None:
        """Take anew the values of some hexes, nodes being at points (n, 3)."""
        self.values[hexes] = scaled_jacobians(points, self.mesh.hexes[hexes])
