"""Periodic sets: pairs of faces whose nodes move as one, by a translation or a rotation found from their nodes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hexmend.arrays import mask
from hexmend.errors import MeshError
from hexmend.mesh.edge_length import shortest_edges
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.named_sets import nodes_in_set

#: Largest distance of a node from its partner's image, in lengths of the shortest edge at the node.
MATCH_TOLERANCE = 1e-3
#: Least cosine of the angle between the inward area of a set and the image of the outward area of its partner.
_MIN_COSINE = 0.9


class PeriodicPair(NamedTuple):
    """Nodes of a set with their partners in another, and the rotation between them.

    Parameters
    ----------
    nodes, partners : (k,) int64
    rotation : (3, 3) float64
        Takes displacements of the nodes to those of their partners.
    """

    nodes: np.ndarray
    partners: np.ndarray
    rotation: np.ndarray


def match_periodic(mesh: Mesh, one: str, other: str) -> PeriodicPair:
    """Find the partners of the nodes of a set in another, which is a translated or rotated copy.

    Parameters
    ----------
    mesh : Mesh
    one, other : str
        Names of sets of nodes, sides or quads.

    Returns
    -------
    PeriodicPair

    Raises
    ------
    MeshError
        For a set that does not exist, sets of different size, and a node without a partner; the message says how far
        the nearest is.
    """
    from scipy.spatial import cKDTree

    nodes, others = (np.unique(nodes_in_set(mesh, name)) for name in (one, other))
    if nodes.size != others.size:
        raise MeshError(
            f"{one!r} and {other!r} are not periodic: they have {nodes.size} and {others.size} nodes; expected as many"
        )
    if not nodes.size or np.array_equal(nodes, others):
        raise MeshError(f"{one!r} and {other!r} are not periodic: they have the same nodes, or none")
    x, y = mesh.points[nodes], mesh.points[others]
    fits, tree = [], cKDTree(y)
    normals = _outward_area(mesh, nodes), _outward_area(mesh, others)
    for rotation, shift in _candidates(x, y, *normals):
        distance, partner = tree.query(x @ rotation.T + shift)
        fits.append((rotation, partner, distance))
        if distance.max() <= MATCH_TOLERANCE * mesh.mean_edge_length:
            break
    rotation, partner, distance = min(fits, key=lambda fit: fit[2].max())
    near = shortest_edges(mesh.points, mesh.elements)[nodes]
    far = distance - MATCH_TOLERANCE * np.where(np.isfinite(near), near, mesh.mean_edge_length)
    if far.max() > 0 or np.unique(partner).size < partner.size:
        at = int(far.argmax()) if far.max() > 0 else int(np.flatnonzero(np.bincount(partner)[partner] > 1)[0])
        raise MeshError(
            f"{one!r} and {other!r} are not periodic: node {nodes[at]} (counted from 0) has no partner; the nearest, "
            f"node {others[partner[at]]}, is {distance[at] / (mesh.mean_edge_length or 1.0):.3g} mean edge lengths "
            "from its image under the translation or rotation that fits best"
        )
    return PeriodicPair(nodes, others[partner], rotation)


def _candidates(
    x: np.ndarray, y: np.ndarray, outward: np.ndarray, other_outward: np.ndarray
) -> list[tuple[np.ndarray, np.ndarray]]:
    """Rotations and translations that may take points x (k, 3) to y (k, 3), the likeliest first.

    They are a translation, the smallest rotation that takes the outward area of the one set, (3,), to the inward area
    of the other, and those that take principal axes to principal axes. Of these only such remain as take the inside of
    the mesh at the one set to the outside at the other: a square matches its image in other ways too.
    """
    middle, end = x.mean(axis=0), y.mean(axis=0)
    frames = [np.linalg.eigh((z - z.mean(axis=0)).T @ (z - z.mean(axis=0)))[1] for z in (x, y)]
    sizes = np.linalg.norm(outward), np.linalg.norm(other_outward)
    oriented = min(sizes) > 0
    one, other = (outward / sizes[0], -other_outward / sizes[1]) if oriented else (frame[:, 0] for frame in frames)
    rotations = [np.eye(3), smallest_rotation(one, other)]
    for signs in np.ndindex(2, 2, 2):
        rotation = frames[1] @ np.diag(1.0 - 2.0 * np.array(signs)) @ frames[0].T
        rotations += [rotation] if np.linalg.det(rotation) > 0 else []
    fitting = [turn for turn in rotations if not oriented or (turn @ one) @ other > _MIN_COSINE]
    return [(rotation, end - rotation @ middle) for rotation in fitting or rotations]


def _outward_area(mesh: Mesh, nodes: np.ndarray) -> np.ndarray:
    """Sum of the outward area vectors of the boundary faces whose nodes are all in a set (k,), (3,); 0 for none."""
    faces = mesh.topology.boundary_faces
    a, b, c, d = (mesh.points[column] for column in faces[mask(nodes, mesh.n_nodes)[faces].all(axis=1)].T)
    return np.cross(c - a, d - b).sum(axis=0) / 2


def smallest_rotation(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Rotation about the normal of two unit vectors that takes one to the other, (3, 3); for opposed ones none."""
    axis, cosine = np.cross(one, other), float(one @ other)
    if cosine < -1 + 1e-12:
        return np.eye(3)
    cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + cross + cross @ cross / (1 + cosine)
