"""Medit has cells of first order: those of second order come with their corners, and nothing else."""

import struct

import numpy as np
import pytest

from hexmend import Cells, Mesh, io
from hexmend.cli.main import main
from hexmend.mesh.second_order import MID_NODE_POSITIONS
from tests.core.grids import grid
from tests.core.io.kept import read_back


@pytest.mark.parametrize("suffix", [".mesh", ".meshb"])
def test_cells_of_second_order_are_written_with_their_corners(suffix, tmp_path):
    bare = grid(2, 1, 1)
    mids = np.full((2, 19), -1)
    mids[0, :12] = np.arange(12, 24)
    points = np.vstack([bare.points, bare.points[bare.hexes[0]].mean(axis=0) + MID_NODE_POSITIONS[:12] - 0.5])
    face = np.array([[*bare.hexes[0, [0, 1, 2, 3]], 12, 13, 14, 15]])
    mesh = Mesh(
        points,
        bare.hexes,
        mid_nodes=mids,
        cells=(Cells("quad8", face, {"medit:ref": np.array([5])}),),
        node_data={"medit:ref": np.arange(24)},
        hex_data={"medit:ref": np.array([7, 8])},
        node_sets={"corners": np.array([11, 23])},
    )
    assert io.unsupported_data(tmp_path / f"a{suffix}", mesh) == ["nodes of second order"]
    back = read_back(tmp_path / f"a{suffix}", mesh)
    np.testing.assert_array_equal(back.points, bare.points)
    np.testing.assert_array_equal(back.hexes, bare.hexes)
    assert back.hex_data["medit:ref"].tolist() == [7, 8]
    assert back.node_data["medit:ref"].tolist() == list(range(12))
    assert back.node_sets["corners"].tolist() == [11]
    (quads,) = back.cells
    assert (quads.kind, quads.nodes.tolist()) == ("quad", face[:, :4].tolist())
    assert quads.data["medit:ref"].tolist() == [5]


def test_sections_that_are_not_read_are_named_and_not_lost_in_place(tmp_path):
    path, loose = tmp_path / "a.mesh", np.vstack([grid(1).points, [[9.0, 9.0, 9.0]]])
    assert read_back(path, Mesh(loose, grid(1).hexes)).notes == ()
    path.write_text(path.read_text().replace("End", "Normals\n1\n0 0 1\nTangents 0\nAngleOfCornerBound\n60\nEnd"))
    assert io.read(path).notes == ("Not read: sections (Normals, AngleOfCornerBound).",)
    before = path.read_bytes()
    assert main(["repair", str(path), "-o", str(path)]) == 3  # a node goes, so that the file is to be written anew
    assert path.read_bytes() == before


@pytest.mark.parametrize("count", [0, 1])
def test_binary_sections_that_are_not_read_are_named_by_their_numbers(count, tmp_path):
    path = tmp_path / "a.meshb"
    io.write(path, grid(1))
    data, end = path.read_bytes(), struct.pack("<ii", 54, 0)
    assert data.endswith(end)
    section = struct.pack("<i", count) + count * struct.pack("<ddd", 0, 0, 1)
    head = struct.pack("<ii", 60, len(data) - len(end) + 8 + len(section))
    path.write_bytes(data.removesuffix(end) + head + section + end)
    assert io.read(path).notes == (("Not read: sections (number 60).",) if count else ())
