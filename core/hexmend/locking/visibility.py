"""Space for a layer at the nodes of the boundary."""

from __future__ import annotations

import numpy as np
from scipy.optimize import linprog

from hexmend.boundary.normals import unit_vectors
from hexmend.mesh.mesh import Mesh

#: Least sine of the angle between a direction and the planes of all faces for which there is space.
_MIN_SINE = 1e-6


def nodes_without_space(mesh: Mesh, hexes: np.ndarray) -> np.ndarray:
    """Find boundary nodes at which no direction leads below all faces of the boundary around them.

    Every hex of a layer has an edge from such a node to the copy of it. Wherever the copy is, one of these hexes is
    inverted, as long as the boundary stays.

    Parameters
    ----------
    mesh : Mesh
    hexes : (k,) int
        Only their nodes are examined.

    Returns
    -------
    (c,) int64
        Numbers of nodes, ascending.
    """
    x, quads = mesh.points, mesh.topology.boundary_faces
    ahead, back = np.roll(quads, -1, axis=1), np.roll(quads, 1, axis=1)
    normals = unit_vectors(np.cross(x[ahead] - x[quads], x[back] - x[quads]))
    nodes = np.unique(mesh.hexes[hexes])
    nodes = nodes[mesh.topology.boundary[nodes]]
    return np.array([node for node in nodes if not _sees_inside(normals[quads == node])], dtype=np.int64)


def _sees_inside(normals: np.ndarray) -> bool:
    """Return True if a direction has a negative product with each of some unit normals (k, 3)."""
    below = np.column_stack([normals, np.ones(len(normals))])
    found = linprog([0, 0, 0, -1], A_ub=below, b_ub=np.zeros(len(normals)), bounds=[(-1, 1)] * 3 + [(None, 1)])
    return bool(found.status == 0 and -found.fun > _MIN_SINE)
