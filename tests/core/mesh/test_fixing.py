"""Nodes pinned by named sets, and regions outside which all nodes are pinned."""

import json

import numpy as np
import pytest

from hexmend import io
from hexmend.cli.main import main
from hexmend.errors import MeshError
from hexmend.mesh.fixing import with_region_free, with_sets_fixed
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.rules.named_sets import nodes_in_set
from tests.core.grids import grid, scrambled

MESH = scrambled(grid(5), 0.4).replace(
    node_sets={"some": np.array([100, 101])}, hex_sets={"part": np.array([62])}, side_sets={"side": np.array([[62, 3]])}
)


def test_sets_of_nodes_hexes_and_sides_are_fixed():
    assert set(nodes_in_set(MESH, "part")) == set(MESH.hexes[62])
    assert set(nodes_in_set(MESH, "side")) == set(MESH.hexes[62][FACES[3]])
    fixed = with_sets_fixed(MESH, "some", "side").fixed
    assert fixed[[100, 101]].all()
    assert fixed[nodes_in_set(MESH, "side")].all()
    with pytest.raises(MeshError, match="there is no set 'sme': there are 'some', 'part', 'side'"):
        with_sets_fixed(MESH, "sme")


@pytest.mark.parametrize("rings", [0, 1, 2])
def test_of_a_region_and_its_rings_alone_nodes_are_free(rings):
    free = with_region_free(MESH, np.array([62]), rings).free
    expected = np.zeros(MESH.n_nodes, dtype=bool)
    expected[MESH.hexes[MESH.topology.hexes_around([62], rings)]] = True
    np.testing.assert_array_equal(free, expected & MESH.free)


def test_the_command_keeps_sets_and_moves_regions(tmp_path, capsys):
    path, out, report = tmp_path / "a.vtu", tmp_path / "b.vtu", tmp_path / "c.json"
    io.write(path, MESH)
    words = ["smooth", str(path), "-o", str(out), "--method", "laplacian", "--json", str(report)]
    main([*words, "--only", "part", "--rings", "0", "--fix", "some"])
    moved = np.flatnonzero((io.read(out).points != MESH.points).any(axis=1))
    assert len(moved) > 0
    assert set(moved) <= set(MESH.hexes[62])
    assert json.loads(report.read_text())["before"]["free_nodes"] == 8
    capsys.readouterr()
    assert main([*words, "--only", "parts"]) == 3
    assert "there is no element set 'parts': there are 'part' and 'inverted'" in capsys.readouterr().err
