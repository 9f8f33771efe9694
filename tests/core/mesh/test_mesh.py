"""Mesh: validation, immutability and sharing."""

import json

import numpy as np
import pytest

from hexmend import Mesh, MeshError, fix, fix_outside, io, unfix
from hexmend.cli.main import main
from hexmend.mesh.edge_length import OUTLIER_FACTOR, mean_edge_length
from hexmend.mesh.hexahedron import FACES, UNIT_CUBE
from hexmend.mesh.rules.named_sets import nodes_in_set
from tests.core.grids import grid, scrambled


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


# Nodes fixed by named sets, numbers and marks, and regions outside which all nodes are fixed.


MESH = scrambled(grid(5), 0.4).replace(
    node_sets={"some": np.array([100, 101])}, hex_sets={"part": np.array([62])}, side_sets={"side": np.array([[62, 3]])}
)


def test_sets_of_nodes_hexes_and_sides_are_fixed():
    assert set(nodes_in_set(MESH, "part")) == set(MESH.hexes[62])
    assert set(nodes_in_set(MESH, "side")) == set(MESH.hexes[62][FACES[3]])
    fixed = fix(MESH, "some", "side").fixed
    assert fixed[[100, 101]].all()
    assert fixed[nodes_in_set(MESH, "side")].all()
    with pytest.raises(MeshError, match=r"there is no set 'sme': did you mean some\? there are 'some', 'part', 'side'"):
        fix(MESH, "sme")


def test_nodes_are_fixed_by_number_and_by_marks_and_released_again():
    inner = np.flatnonzero(MESH.free)[:3]
    marks = np.zeros(MESH.n_nodes, dtype=bool)
    marks[inner] = True
    for fixed in (fix(MESH, inner), fix(MESH, inner.tolist()), fix(MESH, marks), fix(MESH, *map(int, inner))):
        np.testing.assert_array_equal(np.flatnonzero(MESH.free & ~fixed.free), inner)
        np.testing.assert_array_equal(fixed.immovable, marks)
    np.testing.assert_array_equal(np.flatnonzero(unfix(fixed, inner[1:]).immovable), inner[:1])
    assert not unfix(fixed).immovable.any()
    assert MESH.pinned is None
    with pytest.raises(MeshError, match="nodes"):
        fix(MESH, [MESH.n_nodes])


def test_fixed_sets_are_those_of_which_no_node_moves():
    assert MESH.fixed_sets == ()
    assert fix(MESH, "some").fixed_sets == ("some",)
    assert fix(MESH, nodes_in_set(MESH, "side")[1:]).fixed_sets == ()
    assert set(fix(MESH, "part").fixed_sets) == {"part", "side"}  # the side is one of its faces
    assert MESH.with_rules(fix="side").fixed_sets == ("side",)
    assert unfix(fix(MESH, "some"), "some").fixed_sets == ()


@pytest.mark.parametrize("rings", [0, 1, 2])
def test_of_a_region_and_its_rings_alone_nodes_are_free(rings):
    free = fix_outside(MESH, np.array([62]), rings).free
    expected = np.zeros(MESH.n_nodes, dtype=bool)
    expected[MESH.hexes[MESH.topology.hexes_around([62], rings)]] = True
    np.testing.assert_array_equal(free, expected & MESH.free)


def test_the_command_keeps_sets_and_moves_regions(tmp_path, capsys, run_command):
    path, out, report = tmp_path / "a.vtu", tmp_path / "b.vtu", tmp_path / "c.json"
    io.write(path, MESH)
    words = ["smooth", str(path), "-o", str(out), "--method", "laplacian", "--json", str(report)]
    main([*words, "--only", "part", "--rings", "0", "--fix", "some"])
    moved = np.flatnonzero((io.read(out).points != MESH.points).any(axis=1))
    assert len(moved) > 0
    assert set(moved) <= set(MESH.hexes[62])
    assert json.loads(report.read_text())["before"]["free_nodes"] == 8
    capsys.readouterr()
    assert (
        "there is no element set 'parts': did you mean part? there are 'part', 'inverted'"
        in run_command(*words, "--only", "parts", status=3).err
    )


# Mean edge length: every edge counts once a hex, and a distant node does not distort it.


def test_each_edge_counts_once_a_hex():
    mesh = grid(3)
    assert mesh.mean_edge_length == mean_edge_length(mesh.points, mesh.hexes) == pytest.approx(1)
    assert mesh.with_points(mesh.points * [1, 2, 3]).mean_edge_length == pytest.approx(2)


@pytest.mark.parametrize("far", [1e6, 1e150])
def test_one_node_far_away_spoils_nothing(far):
    mesh = grid(4)
    points = mesh.points.copy()
    points[np.flatnonzero(mesh.free)[0]] = far
    assert 0.9 < mean_edge_length(points, mesh.hexes) < OUTLIER_FACTOR
