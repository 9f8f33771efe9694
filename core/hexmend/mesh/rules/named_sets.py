"""Nodes and faces of the named sets of a mesh."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend.arrays import mask
from hexmend.errors import MeshError
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
