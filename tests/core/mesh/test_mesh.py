"""Mesh: validation, immutability and sharing."""

import numpy as np
import pytest

from hexmend import Mesh, MeshError
from hexmend.mesh.hexahedron import UNIT_CUBE
from tests.core.grids import grid


def test_with_points_shares_topology_and_leaves_the_original():
    mesh = grid(3)
    _ = mesh.topology.face_neighbours, mesh.free
    moved = mesh.with_points(mesh.points + 1)
    assert moved.topology is mesh.topology
    assert moved.hexes is mesh.hexes
    assert moved.free is mesh.free
    assert mesh.points[0, 0] == 0
    assert moved.points[0, 0] == 1


@pytest.mark.parametrize(
    ("points", "hexes", "words"),
    [
        (UNIT_CUBE[:, :2], [range(8)], r"points have shape \(8, 2\): expected"),
        (UNIT_CUBE, [range(7)], r"hexes have shape \(1, 7\): expected"),
        (UNIT_CUBE, np.empty((0, 8), int), "at least one hex"),
        (UNIT_CUBE, [[0, 1, 2, 3, 4, 5, 6, 8]], "hex 0 .* expected numbers from 0 to 7"),
        (UNIT_CUBE, [[0, 1, 2, 3, 4, 5, 6, -1]], "hex 0 .* expected numbers from 0 to 7"),
        (np.where(UNIT_CUBE > 0, np.nan, 0), [range(8)], "node 1 .* expected finite"),
    ],
)
def test_what_is_no_mesh_is_said(points, hexes, words):
    with pytest.raises(MeshError, match=words):
        Mesh(points, hexes)


def test_fixed_are_boundary_pinned_and_unused():
    mesh = grid(4)
    inner = int(np.flatnonzero(mesh.free)[0])
    pinned = np.zeros(mesh.n_nodes + 1, dtype=bool)
    pinned[inner] = True
    more = Mesh(np.vstack([mesh.points, [[9, 9, 9]]]), mesh.hexes, pinned=pinned)
    assert mesh.free.sum() == 27
    assert more.free.sum() == 26
    assert more.fixed[inner]
    assert more.fixed[-1]


def test_a_replaced_mesh_shares_what_is_not_replaced_and_checks_what_is():
    mesh = grid(2)
    tagged = mesh.replace(hex_sets={"some": np.array([1, 2])})
    assert tagged.points is mesh.points
    assert tagged.hexes is mesh.hexes
    assert mesh.hex_sets == {}
    with pytest.raises(MeshError, match="pinned has shape"):
        mesh.replace(pinned=[True])
    with pytest.raises(TypeError, match="has no colour"):
        mesh.replace(colour="red")
