"""Gmsh's files: written by Gmsh 4.15, and written and read again."""

from pathlib import Path

import numpy as np
import pytest

from hexmend import FileError, io
from tests.core.grids import grid

FILES = Path(__file__).parents[2] / "files"


def test_a_mesh_without_ids_is_numbered_from_1(tmp_path):
    mesh = grid(2)
    io.write(tmp_path / "a.msh", mesh)
    assert io.read(tmp_path / "a.msh").node_data["id"].tolist() == list(range(1, 28))


HEAD = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
NODES = "$Nodes\n8\n" + "".join(f"{k + 1} {k & 1} {k >> 1 & 1} {k >> 2}\n" for k in range(8)) + "$EndNodes\n"


def test_a_hex_in_two_groups_is_one_hex_and_claimed_counts_are_checked(tmp_path):
    elements = "$Elements\n2\n1 5 2 1 1 1 2 4 3 5 6 8 7\n2 5 2 2 1 1 2 4 3 5 6 8 7\n$EndElements\n"
    (tmp_path / "a.msh").write_text(HEAD + NODES + elements)
    mesh = io.read(tmp_path / "a.msh")
    assert mesh.n_hexes == 1
    assert set(mesh.hex_sets) == {"physical 1", "physical 2"}
    binary = (FILES / "gmsh-o1-4.1-b.msh").read_bytes()
    at = binary.index(b"$Nodes\n") + 7
    (tmp_path / "b.msh").write_bytes(binary[:at] + (2**62).to_bytes(8, "little") * 2 + binary[at + 16 :])
    with pytest.raises(FileError):
        io.read(tmp_path / "b.msh")


def test_data_of_some_nodes_are_nan_for_the_others(tmp_path):
    elements = "$Elements\n1\n7 5 2 1 1 1 2 4 3 5 6 8 7\n$EndElements\n"
    data = '$NodeData\n1\n"heat"\n1\n0.5\n3\n0\n1\n2\n3 1.5\n1 2.5\n$EndNodeData\n'
    data += '$ElementData\n1\n"flow"\n1\n0.5\n3\n0\n3\n1\n7 1 2 3\n$EndElementData\n'
    (tmp_path / "a.msh").write_text(HEAD + NODES + elements + data)
    mesh = io.read(tmp_path / "a.msh")
    np.testing.assert_array_equal(mesh.node_data["heat"], [2.5, np.nan, 1.5] + [np.nan] * 5)
    assert mesh.hex_data["flow"].tolist() == [[1, 2, 3]]


def test_data_called_fixed_of_some_nodes_fix_these_alone(tmp_path):
    io.write(tmp_path / "a.msh", grid(2), encoding="ascii")
    data = '$NodeData\n1\n"fixed"\n1\n0\n3\n0\n1\n2\n14 1\n3 0\n$EndNodeData\n'
    with open(tmp_path / "a.msh", "a") as file:
        file.write(data)
    mesh = io.read(tmp_path / "a.msh")
    assert np.flatnonzero(mesh.pinned).tolist() == [13]
    io.write(tmp_path / "b.vtu", mesh)
    assert np.flatnonzero(io.read(tmp_path / "b.vtu").pinned).tolist() == [13]


@pytest.mark.parametrize("encoding", ["ascii", "binary"])
def test_data_of_other_widths_are_padded_or_left_out_and_that_is_reported(encoding, tmp_path):
    data = {"two": np.ones((8, 2)), "six": np.full((8, 6), 6), "ten": np.ones((8, 10)), "tensor": np.ones((8, 3, 3))}
    mesh = grid(1).replace(node_data={**data}, hex_data={"word": ["x"]})
    assert io.unsupported_data(tmp_path / "a.msh", mesh) == [
        "point data of more than 9 columns, or no numbers (ten)",
        "the width of point data, filled up to 3 or 9 columns (six, two)",
        "cell data of more than 9 columns, or no numbers (word)",
    ]
    io.write(tmp_path / "a.msh", mesh, encoding=encoding)
    back = io.read(tmp_path / "a.msh").node_data
    assert back["six"][0].tolist() == [6] * 6 + [0] * 3
    assert {name: values.shape for name, values in back.items() if name != "id"} == {
        "two": (8, 3), "six": (8, 9), "tensor": (8, 9)
    }  # fmt: skip


def test_data_that_would_fill_the_memory_are_refused(tmp_path):
    """A thousand values of one node, in many sections."""
    path = tmp_path / "a.msh"
    io.write(path, grid(20), encoding="ascii")
    row = " ".join(["1", *["0"] * 1000])
    with open(path, "a") as file:
        file.writelines(f'$NodeData\n1\n"{k}"\n1\n0\n3\n0\n1000\n1\n{row}\n$EndNodeData\n' for k in range(5))
    with pytest.raises(FileError, match="too many for a file"):
        io.read(path)


def test_rounded_whole_numbers_are_reported(tmp_path):
    mesh = grid(2).replace(hex_data={"exact": np.arange(8) + 2**53 - 8, "key": np.arange(8) + 2**53})
    assert "whole numbers of cell data above 2^53, which are rounded (key)" in io.unsupported_data(
        tmp_path / "a.msh", mesh
    )


def test_skipped_sections_are_noted(tmp_path):
    io.write(tmp_path / "a.msh", grid(2), encoding="ascii")
    with open(tmp_path / "a.msh", "a", encoding="ascii") as file:
        file.write("$GhostElements\n0\n$EndGhostElements\n")
    assert io.read(tmp_path / "a.msh").notes == ("Not read: sections ($GhostElements).",)
