"""Periodic sets: pairs of faces whose nodes move as one, by a translation or a rotation found from their nodes.

Nodes and faces of the named sets of a mesh.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from hexmend.arrays import mask
from hexmend.errors import MeshError
from hexmend.mesh.edge_length import shortest_edges
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import solid_blocks
from hexmend.parameters import suggestion


def set_names(mesh: Mesh) -> list[str]:
    """List the names of all sets of nodes, hexes, sides and other cells, each once."""
    cells = (name for cells in mesh.cells for name in cells.sets)
    return list(dict.fromkeys([*mesh.node_sets, *mesh.hex_sets, *mesh.side_sets, *cells]))


def nodes_in_set(mesh: Mesh, name: str) -> np.ndarray:
    """Find the nodes of a set: of nodes, hexes, sides, or other cells such as the quads of a surface.

    Parameters
    ----------
    mesh : Mesh
    name : str

    Returns
    -------
    (k,) int
        Ascending, except of a node set, which is returned as it is.

    Raises
    ------
    MeshError
        For a set that does not exist; the message lists the sets.
    """
    if name in mesh.node_sets:
        return np.asarray(mesh.node_sets[name])
    if name in mesh.hex_sets:
        of_hexes = mesh.hexes[mesh.hex_sets[name]].ravel()
        others = [cells.nodes[cells.sets[name]].ravel() for cells in solid_blocks(mesh.cells) if name in cells.sets]
        return np.unique(np.concatenate([of_hexes, *others]))
    if name in mesh.side_sets:
        rows = np.asarray(mesh.side_sets[name])
        return np.unique(mesh.hexes[rows[:, :1], FACES[rows[:, 1]]])
    found = [cells.nodes[cells.sets[name]].ravel() for cells in mesh.cells if name in cells.sets]
    if found:
        return np.unique(np.concatenate(found))
    raise unknown_set(name, set_names(mesh))


def unknown_set(name: str, names: Sequence[str], kind: str = "set") -> MeshError:
    """Return the error for a set that does not exist; the message suggests the nearest name, and lists all.

    >>> print(unknown_set("wal", ["wall", "inlet"]))
    there is no set 'wal': did you mean wall? there are 'wall', 'inlet'
    """
    known = ", ".join(map(repr, names)) or "none"
    return MeshError(f"there is no {kind} {name!r}: {suggestion(name, names)}there are {known}")


def boundary_faces_in_sets(mesh: Mesh) -> dict[str, np.ndarray]:
    """Mark the boundary faces of each side set, set of quads or triangles, and node set that holds a face's nodes.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    dict of str to (k,) bool
        For the faces of `Topology.boundary_faces`; sets without a face, and with all faces, are left out.
    """
    faces, found = mesh.topology.boundary_faces, {}
    if mesh.side_sets:
        hexes, sides = np.nonzero(mesh.topology.face_neighbours < 0)
        number = np.full((mesh.n_elements, 6), len(faces))
        number[hexes, sides] = np.arange(len(faces))
        for name, rows in mesh.side_sets.items():
            marks = np.zeros(len(faces) + 1, dtype=bool)
            marks[number[rows[:, 0], rows[:, 1]]] = True
            found[f"side set {name}"] = marks[:-1]
    weights = np.random.default_rng(0).integers(1, 2**62, mesh.n_nodes if mesh.cells else 0)
    for cells in mesh.cells:
        if cells.kind in ("quad", "triangle") and cells.sets:
            nodes = cells.nodes if cells.kind == "quad" else cells.nodes[:, [0, 1, 2, 2]]
            keys, own = (_keys(weights, of) for of in (faces, nodes))
            for name, rows in cells.sets.items():
                found[f"quads {name}"] = np.isin(keys, own[rows])
    for name, nodes in mesh.node_sets.items():
        found[f"node set {name}"] = mask(nodes, mesh.n_nodes)[faces].all(axis=1)
    return {name: marks for name, marks in found.items() if marks.any() and not marks.all()}


def _keys(weights: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Sums of the weights (n,) of the nodes of faces (k, 4), the last of which a triangle repeats, (k,) int64."""
    of_nodes = weights[faces]  # overflow does no harm
    return of_nodes[:, :3].sum(axis=1) + np.where(faces[:, 2] == faces[:, 3], 0, of_nodes[:, 3])


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
