"""Hexes that no position of the nodes makes valid: corners on one side of two faces with the same two edges."""

from itertools import product

import numpy as np
import pytest

from hexmend import Mesh, measure, smooth
from hexmend.doctor import PROBLEMS
from hexmend.locking import hexes_without_valid_position, nodes_without_valid_position
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.orientation import mirror_hexes
from tests.core.grids import grid


def around_two_faces(*hexes):
    """Make hexes above and below two faces with the edges 0-1 and 0-3 in common: pairs of face, 0 or 1, and side."""
    points = [[0, 0, 0], [1, 0, 0], [0.8, 0.8, 0], [0, 1, 0], [1, 1, 0.1]]
    faces, rows = ([0, 1, 2, 3], [0, 1, 4, 3]), []
    for face, side in hexes:
        corners = np.array(points)[faces[face]]
        others = list(range(len(points), len(points) + 4))
        points += (corners + [0, 0, side * (1 + 0.2 * face)]).tolist()
        lower, upper = (faces[face], others) if side > 0 else (others, faces[face])
        rows.append([*lower, *upper])
    return Mesh(np.array(points), rows)


def brute_force(mesh):
    """Find nodes and hexes from a table of the faces at each node."""
    table = {}
    for h, face, p in product(range(mesh.n_hexes), FACES, range(4)):
        node, after, across, before = mesh.hexes[h, np.roll(face, -p)].tolist()
        if len({node, after, before}) == 3:
            table.setdefault((node, after, before), []).append((across, h))
    several = {key: rows for key, rows in table.items() if len({across for across, _ in rows}) > 1}
    return sorted({key[0] for key in several}), sorted({h for rows in several.values() for _, h in rows})


def test_hexes_on_one_side_of_two_faces_with_the_same_edges_are_found_and_named():
    mesh = around_two_faces((0, 1), (0, -1), (1, 1), (1, -1))
    assert (mesh.topology.face_neighbours >= 0).sum() == 4
    assert hexes_without_valid_position(mesh).tolist() == [0, 1, 2, 3]
    assert nodes_without_valid_position(mesh).tolist() == [0]
    finding = PROBLEMS["overlapping-corners"].find(mesh)
    assert "hexes 0, 1, 2, 3" in finding.message
    assert "node 0" in finding.message
    assert finding.nodes.tolist() == [0]
    assert not finding.mendable


@pytest.mark.parametrize("hexes", [[(0, 1), (0, -1)], [(0, 1), (1, -1)], [(1, 1), (0, -1)]])
def test_hexes_on_both_sides_of_one_face_or_of_a_gap_between_two_are_none(hexes):
    assert not hexes_without_valid_position(around_two_faces(*hexes)).size


def test_a_lattice_has_none_however_its_hexes_are_numbered_and_moved():
    mesh, random = grid(3), np.random.default_rng(1)
    wrong = mirror_hexes(mesh, random.random(27) < 0.5)
    tangled = mesh.with_points(random.random(mesh.points.shape))
    twice = Mesh(mesh.points, np.concatenate([mesh.hexes, mesh.hexes[:3]]))
    for one in (mesh, wrong, tangled, twice):
        assert not hexes_without_valid_position(one).size


@pytest.mark.parametrize("seed", range(5))
def test_the_pass_over_corners_finds_what_a_table_of_faces_finds(seed):
    random = np.random.default_rng(seed)
    mesh = grid(4, 3, 3)
    same = np.arange(mesh.n_nodes)
    chosen = random.choice(mesh.n_nodes, 12, replace=False)
    same[chosen[:6]] = chosen[6:]  # collapses hexes and joins distant ones
    mesh = Mesh(mesh.points, same[mesh.hexes])
    nodes, hexes = brute_force(mesh)
    assert hexes
    assert nodes_without_valid_position(mesh).tolist() == nodes
    assert hexes_without_valid_position(mesh).tolist() == hexes


def test_a_run_that_leaves_such_hexes_inverted_says_that_no_position_makes_them_valid():
    mesh = around_two_faces((0, 1), (0, -1), (1, 1), (1, -1))
    points = mesh.points.copy()
    points[mesh.hexes[2, 4:]] *= [1, 1, -0.5]  # the third hex lies below its face
    mesh = mesh.with_points(points)
    assert measure(mesh.points, mesh.hexes).n_inverted > 0
    assert (
        "No position of the nodes makes all of 4 hexes valid without overlap: hexes 0, 1, 2, 3." in smooth(mesh).message
    )
