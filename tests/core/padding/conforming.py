"""Checks of padded meshes that hold for every layer."""

import numpy as np

from hexmend.doctor import examine
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import MID_EDGES


def sorted_rows(rows: np.ndarray) -> list[tuple[int, ...]]:
    """Rows as a sorted list, each sorted."""
    return sorted(map(tuple, np.sort(rows, axis=1).tolist()))


def check_layer(given: Mesh, padded: Mesh, boundary_kept: bool = True) -> None:
    """Check that a padded mesh is conforming and has the given boundary, node for node and bit for bit."""
    boundary = given.topology.boundary
    np.testing.assert_array_equal(padded.points[: given.n_nodes][boundary], given.points[boundary])
    assert padded.topology.n_nonmanifold_faces == 0
    if boundary_kept:
        assert sorted_rows(padded.topology.boundary_faces) == sorted_rows(given.topology.boundary_faces)
    # A layer is conforming also where it folds at a corner of the boundary so that its hexes overlap wherever they are.
    found = {(finding.kind, finding.count) for finding in examine(padded) if finding.kind != "overlapping-corners"}
    assert found <= {(finding.kind, finding.count) for finding in examine(given)}
    if padded.mid_nodes is not None:
        _check_mid_nodes(padded)


def _check_mid_nodes(mesh: Mesh) -> None:
    """Check that hexes with a common edge or face share its mid-node, and that no other edge or face has it."""
    edges = np.sort(mesh.hexes[:, MID_EDGES].reshape(-1, 2), axis=1)
    faces = np.sort(mesh.hexes[:, FACES].reshape(-1, 4), axis=1)
    for items, mids in (edges, mesh.mid_nodes[:, :12].ravel()), (faces, mesh.mid_nodes[:, 12:18].ravel()):
        pairs = np.unique(np.column_stack([items, mids])[mids >= 0], axis=0)
        assert len(np.unique(pairs[:, -1])) == len(pairs) == len(np.unique(pairs[:, :-1], axis=0))


def area_of_sides(mesh: Mesh, name: str) -> float:
    """Area of the faces of a side set, each as two triangles."""
    rows = mesh.side_sets[name]
    x = mesh.points[mesh.hexes[rows[:, :1], FACES[rows[:, 1]]]]
    one, other = np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 0])
    return float((np.linalg.norm(one, axis=1) + np.linalg.norm(other, axis=1)).sum() / 2)


def sides_where(mesh: Mesh, chosen) -> np.ndarray:
    """Boundary sides of hexes, (k, 2), whose centres a function of points (k, 3) chooses."""
    rows = np.argwhere(mesh.topology.face_neighbours < 0)
    return rows[chosen(mesh.points[mesh.hexes[rows[:, :1], FACES[rows[:, 1]]]].mean(axis=1))]
