"""Nodes fixed by named sets, numbers and marks, and regions outside which all nodes are fixed."""

import json

import numpy as np
import pytest

from hexmend import MeshError, fix, fix_outside, io, unfix
from hexmend.cli.main import main
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.rules.named_sets import nodes_in_set
from tests.core.grids import grid, scrambled

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
