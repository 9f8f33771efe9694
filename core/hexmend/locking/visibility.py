"""Space for a layer at the nodes of the boundary."""

from __future__ import annotations

from itertools import combinations

import numpy as np

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
    return np.array(
        [node for node in nodes if inward_direction(normals[quads == node])[1] <= _MIN_SINE], dtype=np.int64
    )


def inward_direction(normals: np.ndarray) -> tuple[np.ndarray, float]:
    """Find the direction that is furthest below the planes of faces at a node.

    It has the same product with one, two or three of the normals: all such directions are tried.

    Parameters
    ----------
    normals : (k, 3) float64
        Unit normals, outward.

    Returns
    -------
    direction : (3,) float64
    sine : float
        Least sine of its angle to a plane; there is space for a layer where it is positive.
    """
    candidates = [-normals]
    for count in (2, 3):
        rows = np.array(list(combinations(range(len(normals)), count)), dtype=np.int64).reshape(-1, count)
        some = normals[rows]
        if count == 2:
            candidates.append(-some.sum(axis=1))
        else:
            crosses = np.cross(some, np.roll(some, -1, axis=1)).sum(axis=1)  # equal products with all three
            candidates += [crosses, -crosses]
    directions = unit_vectors(np.concatenate(candidates))
    sines = -(normals @ directions.T).max(axis=0)
    best = int(sines.argmax())
    return directions[best], float(sines[best])
