"""Corners of a mesh that can be moved, with the values of a measure."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import BLOCK, mask
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.mesh.linear_motion.constrained_points import with_ties_fixed
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology.components import components
from hexmend.optimise.maxmin.corner_measure import SCALED_JACOBIAN, CornerMeasure
from hexmend.quality.measure import fixed_tetrahedra


def least_movable(mesh: Mesh, points: np.ndarray) -> float:
    """Return the least scaled Jacobian of the corners of a mesh that can be moved, at points (n, 3); +inf without any.

    It is `MovableCorners.active_minimum` without the memory for the values of large meshes.
    """
    least = np.inf
    for first in range(0, mesh.n_hexes, BLOCK):
        hexes = mesh.hexes[first : first + BLOCK]
        values = SCALED_JACOBIAN.values(points, hexes)
        least = min(least, float(values[~fixed_tetrahedra(hexes, ~mesh.free)].min(initial=np.inf)))
    return least


class MovableCorners:
    """Corners with a free node, and the values of a measure as nodes move.

    Parameters
    ----------
    mesh : Mesh
        Its free nodes are moved.
    points : (n, 3) float64
    measure : CornerMeasure, optional
        The scaled Jacobian by default.

    Attributes
    ----------
    mesh : Mesh
    measure : CornerMeasure
    values : (m, 8) float64
        Value of each corner, including those that cannot be moved; `set_values` changes them.
    frozen : (m, 8) bool
        Corners that could be moved, but whose nodes all stay.
    """

    def __init__(self, mesh: Mesh, points: np.ndarray, measure: CornerMeasure = SCALED_JACOBIAN):
        self.measure = measure
        self.values = measure.values(points, mesh.hexes)
        self.frozen = np.zeros(self.values.shape, dtype=bool)
        self._stays = np.zeros(mesh.n_nodes, dtype=bool)
        self.set_mesh(mesh)

    def set_mesh(self, mesh: Mesh) -> None:
        """Take over the fixed marks of a mesh with the same hexes."""
        self.mesh = mesh
        self._locked = fixed_tetrahedra(mesh.hexes, ~mesh.free)
        self._find_active()

    @property
    def active_values(self) -> np.ndarray:
        """The values, +inf for corners that are frozen or cannot be moved, (m, 8) float64; not to be changed."""
        return self._active

    @property
    def active_minimum(self) -> float:
        """The least of the active values; +inf where there is none."""
        return float(self._least_of_hex.min(initial=np.inf))

    @property
    def movable_minimum(self) -> float:
        """The least value of all corners that can be moved, frozen or not; +inf where there is none."""
        return float(np.where(self._locked, np.inf, self.values).min(initial=np.inf))

    def locked_below(self, value: float) -> np.ndarray:
        """Corners, 8 * hex + corner, below a value with all nodes fixed, the lowest first, (k,) int64."""
        values = np.where(self._locked, self.values, np.inf).ravel()
        low = np.flatnonzero(values < value)
        return low[np.argsort(values[low], kind="stable")]

    def freeze(self, corners: np.ndarray) -> None:
        """Fix the nodes of corners (k,), 8 * hex + corner; corners of which no node is left to move are frozen."""
        self._stays[self.nodes_of(corners)] = True
        if self.mesh.linear_motion is not None:
            self._stays = with_ties_fixed(self.mesh.linear_motion, self._stays)
        moves = self.mesh.free & ~self._stays
        self.frozen = ~moves[self.mesh.hexes[:, CORNER_TETRAHEDRA]].any(axis=2) & ~self._locked
        self._find_active()

    def unfreeze(self) -> None:
        """Let all free nodes move again."""
        self.frozen[:] = self._stays[:] = False
        self._find_active()

    def movable(self, nodes: np.ndarray) -> np.ndarray:
        """Select those of some nodes that are free and not frozen, with the nodes that move with them, (k,) int."""
        nodes = nodes[self.mesh.free[nodes] & ~self._stays[nodes]]
        motion = self.mesh.linear_motion
        if motion is None:
            return nodes
        roots = motion.roots(self.mesh.n_nodes)
        return np.flatnonzero(mask(roots[nodes], roots.size)[roots])

    def nodes_of(self, corners: np.ndarray) -> np.ndarray:
        """Apex and ends of the edges of corners, 8 * hex + corner, (k, 4) int32."""
        return np.take_along_axis(self.mesh.hexes[corners // 8], CORNER_TETRAHEDRA[corners % 8], axis=1)

    def groups(self, corners: np.ndarray) -> np.ndarray:
        """Number the connected groups of some corners, 8 * hex + corner, (k,) int from 0.

        Corners of one group have free nodes in common, directly or through others: only these influence each other.
        """
        nodes, count = self.nodes_of(corners), len(corners)
        corner, end = np.nonzero(self.mesh.free[nodes])
        if self.mesh.linear_motion is not None:
            nodes = self.mesh.linear_motion.roots(self.mesh.n_nodes)[nodes]
        slot = np.unique(nodes, return_inverse=True)[1].reshape(nodes.shape)
        links = np.column_stack([corner, count + slot[corner, end]])
        return components(count + nodes.size, links)[:count]

    def hexes_at(self, nodes: np.ndarray) -> np.ndarray:
        """Hexes attached to some nodes, ascending, (k,) int."""
        return np.flatnonzero(mask(self.mesh.topology.node_corners.of(nodes) // 8, self.mesh.n_hexes))

    def update(self, points: np.ndarray, hexes: np.ndarray) -> None:
        """Compute the values of some hexes (k,) at points (n, 3)."""
        self.set_values(hexes, self.measure.values(points, self.mesh.hexes[hexes]))

    def set_values(self, hexes: np.ndarray, values: np.ndarray) -> None:
        """Replace the values of some hexes (k,) by others (k, 8)."""
        self.values[hexes] = values
        active = np.where(self._locked[hexes] | self.frozen[hexes], np.inf, values)
        self._active[hexes], self._least_of_hex[hexes] = active, active.min(axis=1, initial=np.inf)

    def _find_active(self) -> None:
        self._active = np.where(self._locked | self.frozen, np.inf, self.values)
        self._least_of_hex = self._active.min(axis=1, initial=np.inf)
