"""Space for a layer at the nodes of the boundary."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from hexmend.boundary.normals import unit_vectors
from hexmend.mesh.mesh import Mesh

#: Least sine of the angle between a direction and the planes of all faces for which there is space.
_MIN_SINE = 1e-6
#: Bound of the rounding error in the product of two unit vectors.
_ROUNDING = 4 * np.finfo(np.float64).eps


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
    triangle = quads[:, 2] == quads[:, 3]  # with its last node twice
    ahead[triangle, 2], back[triangle, 3] = quads[triangle, 0], quads[triangle, 1]
    normals = unit_vectors(np.cross(x[ahead] - x[quads], x[back] - x[quads])).reshape(-1, 3)
    at = quads.ravel()
    order = np.argsort(at, kind="stable")
    nodes = np.unique(mesh.elements[hexes])
    nodes = nodes[mesh.topology.boundary[nodes]]
    start, end = np.searchsorted(at, nodes, sorter=order), np.searchsorted(at, nodes, "right", sorter=order)
    sines = [inward_direction(normals[order[i:j]])[1] for i, j in zip(start, end, strict=True)]
    return nodes[np.array(sines) <= _MIN_SINE].astype(np.int64)


def inward_direction(normals: np.ndarray) -> tuple[np.ndarray, float]:
    """Find the direction that is furthest below the planes of faces at a node.

    The direction for a few of the faces is that for all of them if it is as far below the others; if not, the face
    that it is least far below joins the few, which stay below a dozen even for thousands of faces.

    Parameters
    ----------
    normals : (k, 3) float64
        Unit normals, outward.

    Returns
    -------
    direction : (3,) float64
        The best one where there is space for a layer.
    sine : float
        Least sine of its angle to a plane; there is space for a layer where it is positive.
    """
    few = [0]
    while True:
        direction, sine = _direction_of_few(normals[few])
        products = normals @ direction
        worst = int(products.argmax())
        if not (sine > 0 and products[worst] + sine > _ROUNDING):
            return direction, -float(products[worst])
        few.append(worst)


def _direction_of_few(normals: np.ndarray) -> tuple[np.ndarray, float]:
    """Find the direction of `inward_direction`: it has equal products with one, two or three of the normals."""
    candidates = [-normals]
    for count in (2, 3):
        rows = np.array(list(combinations(range(len(normals)), count)), dtype=np.int64).reshape(-1, count)
        some = normals[rows]
        if count == 2:
            candidates.append(-some.sum(axis=1))
        else:
            crosses = np.cross(some, np.roll(some, -1, axis=1)).sum(axis=1)
            candidates += [crosses, -crosses]
    directions = unit_vectors(np.concatenate(candidates))
    sines = -(normals @ directions.T).max(axis=0)
    best = int(sines.argmax())
    return directions[best], float(sines[best])
