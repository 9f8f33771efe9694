"""Gmsh's files: written by Gmsh 4.15, and written and read again."""

from pathlib import Path

import numpy as np
import pytest

from hexmend import FileError, io, smooth, summarise
from hexmend.cli.main import main
from hexmend.interop import to_meshio
from hexmend.io import Original, write_as_given
from hexmend.mesh.hexahedron import UNIT_CUBE
from tests.core.grids import displaced, grid, scrambled
from tests.core.io.kept import read_back, read_content

FILES = Path(__file__).parents[2] / "files"


def test_a_mesh_without_ids_is_numbered_from_1(tmp_path):
    mesh = grid(2)
    assert read_back(tmp_path / "a.msh", mesh).node_data["id"].tolist() == list(range(1, 28))


HEAD = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
NODES = "$Nodes\n8\n" + "".join(f"{k + 1} {k & 1} {k >> 1 & 1} {k >> 2}\n" for k in range(8)) + "$EndNodes\n"


def test_a_hex_in_two_groups_is_one_hex_and_claimed_counts_are_checked(tmp_path):
    elements = "$Elements\n2\n1 5 2 1 1 1 2 4 3 5 6 8 7\n2 5 2 2 1 1 2 4 3 5 6 8 7\n$EndElements\n"
    mesh = read_content(tmp_path / "a.msh", HEAD + NODES + elements)
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
    mesh = read_content(tmp_path / "a.msh", HEAD + NODES + elements + data)
    np.testing.assert_array_equal(mesh.node_data["heat"], [2.5, np.nan, 1.5] + [np.nan] * 5)
    assert mesh.hex_data["flow"].tolist() == [[1, 2, 3]]


def test_data_called_fixed_of_some_nodes_fix_these_alone(tmp_path):
    io.write(tmp_path / "a.msh", grid(2), encoding="ascii")
    data = '$NodeData\n1\n"fixed"\n1\n0\n3\n0\n1\n2\n14 1\n3 0\n$EndNodeData\n'
    with open(tmp_path / "a.msh", "a") as file:
        file.write(data)
    mesh = io.read(tmp_path / "a.msh")
    assert np.flatnonzero(mesh.pinned).tolist() == [13]
    assert np.flatnonzero(read_back(tmp_path / "b.vtu", mesh).pinned).tolist() == [13]


@pytest.mark.parametrize("encoding", ["ascii", "binary"])
def test_data_of_other_widths_are_padded_or_left_out_and_that_is_reported(encoding, tmp_path):
    data = {"two": np.ones((8, 2)), "six": np.full((8, 6), 6), "ten": np.ones((8, 10)), "tensor": np.ones((8, 3, 3))}
    mesh = grid(1).replace(node_data={**data}, hex_data={"word": ["x"]})
    assert io.unsupported_data(tmp_path / "a.msh", mesh) == [
        "point data of more than 9 columns, or no numbers (ten)",
        "the width of point data, filled up to 3 or 9 columns (six, two)",
        "cell data of more than 9 columns, or no numbers (word)",
    ]
    back = read_back(tmp_path / "a.msh", mesh, encoding=encoding).node_data
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


# Reading Gmsh's format of version 1.


FIRST_VERSION = """\
$NOD
9
10 0 0 0
20 1 0 0
30 1 1 0
40 0 1 0
50 0 0 1
60 1 0 1
70 1 1 1
80 0 1 1
90 0 0 2
$ENDNOD
$ELM
3
4 3 1 6 4 10 20 30 40
5 4 0 9 4 50 60 80 90
7 5 100 1000 8 10 20 30 40 50 60 70 80
$ENDELM
"""


def test_the_first_version_of_the_format_is_read(tmp_path):
    (tmp_path / "a.msh").write_text(FIRST_VERSION)
    (tmp_path / "b.txt").write_text(FIRST_VERSION)  # recognised by its content
    for name in ("a.msh", "b.txt"):
        mesh = io.read(tmp_path / name)
        assert mesh.hexes.tolist() == [list(range(8))]
        assert mesh.node_data["id"].tolist() == list(range(10, 100, 10))
        assert mesh.hex_data["id"].tolist() == [7]
        assert mesh.hex_sets["physical 100"].tolist() == [0]
        assert {one.kind: dict(one.sets) for one in mesh.cells} == {"quad": {"physical 1": [0]}, "tetra": {}}
        assert summarise(mesh).inverted == 0


@pytest.mark.parametrize("binary", [False, True])
def test_version_4_0_is_read_and_its_coordinates_replaced(binary, tmp_path):
    meshio, path = pytest.importorskip("meshio"), tmp_path / "a.msh"
    meshio.gmsh.write(path, to_meshio(CUBE), "4.0", binary)
    mesh = io.read(path)
    np.testing.assert_array_equal(mesh.points, CUBE.points)
    np.testing.assert_array_equal(mesh.hexes, CUBE.hexes)
    moved = displaced(mesh, [21], [0.25, 0, 0])
    assert write_as_given(tmp_path / "b.msh", moved, Original(path, mesh)).replaced
    np.testing.assert_array_equal(io.read(tmp_path / "b.msh").points, moved.points)


def test_parametric_nodes_are_read_and_their_coordinates_replaced(tmp_path):
    ends = ["0 1", "1 1 0.5", "2 1 0.25 0.75", "3 1", *["3 1"] * 4]
    nodes = "".join(
        f"{k} {x} {y} {z} {end}\n" for k, ((x, y, z), end) in enumerate(zip(UNIT_CUBE, ends, strict=True), 1)
    )
    text = f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$ParametricNodes\n8\n{nodes}$EndParametricNodes\n"
    text += "$Elements\n1\n1 5 2 1 1 1 2 3 4 5 6 7 8\n$EndElements\n"
    mesh = read_content(tmp_path / "a.msh", text)
    np.testing.assert_array_equal(mesh.points, UNIT_CUBE)
    assert write_as_given(
        tmp_path / "b.msh", displaced(mesh, [2], [0, 0, 0.5]), Original(tmp_path / "a.msh", mesh)
    ).replaced
    assert (tmp_path / "b.msh").read_text() == text.replace("3 1.0 1.0 0.0 2", "3 1.0 1.0 0.5 2")


def test_elements_of_a_higher_order_are_refused_by_their_order(tmp_path):
    nodes = "".join(f"{k} {k} 0 0\n" for k in range(1, 65))
    text = f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n64\n{nodes}$EndNodes\n$Elements\n1\n1 92 0 "
    with pytest.raises(FileError, match=r"1 cell of type HEXA of order 3\. .*gmsh MODEL -3 -order 2"):
        read_content(tmp_path / "a.msh", f"{text}{' '.join(map(str, range(1, 65)))}\n$EndElements\n")


# Periodic surfaces of Gmsh's files.


CUBE = grid(3)
PAIRS = np.column_stack([np.flatnonzero(CUBE.points[:, 0] == 3), np.flatnonzero(CUBE.points[:, 0] == 0)]) + 1


def text_4(pairs):
    """Two links of version 4.1: two points, and two surfaces with a transformation."""
    rows = "".join(f"{one} {other}\n" for one, other in pairs)
    points, matrix = f"0 2 1\n0\n1\n{pairs[0][0]} {pairs[0][1]}\n", "16 1 0 0 3 0 1 0 0 0 0 1 0 0 0 0 1"
    return f"$Periodic\n2\n{points}2 7 5\n{matrix}\n{len(pairs)}\n{rows}$EndPeriodic\n"


def text_2(pairs):
    rows = "".join(f"{one} {other}\n" for one, other in pairs)
    return f"$Periodic\n1\n2 7 5\nAffine 1 0 0 3 0 1 0 0 0 0 1 0 0 0 0 1\n{len(pairs)}\n{rows}$EndPeriodic\n"


def binary(pairs):
    parts = [np.array([1], "<u8"), np.array([2, 7, 5], "<i4"), np.array([0, len(pairs)], "<u8"), pairs.astype("<u8")]
    return b"$Periodic\n" + b"".join(part.tobytes() for part in parts) + b"\n$EndPeriodic\n"


def version_2(mesh):
    nodes = "".join(f"{k} {x} {y} {z}\n" for k, (x, y, z) in enumerate(mesh.points, 1))
    hexes = "".join(f"{k} 5 2 0 1 {' '.join(map(str, row + 1))}\n" for k, row in enumerate(mesh.hexes, 1))
    head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    sections = f"$Nodes\n{mesh.n_nodes}\n{nodes}$EndNodes\n$Elements\n{mesh.n_hexes}\n{hexes}$EndElements\n"
    return head + sections


@pytest.fixture(params=["4.1 text", "4.1 binary", "2.2"])
def path(request, tmp_path):
    path, mesh = tmp_path / "cell.msh", scrambled(CUBE, 0.3)
    if request.param == "2.2":
        path.write_text(version_2(mesh) + text_2(PAIRS))
        return path
    is_text = request.param == "4.1 text"
    io.write(path, mesh, encoding="ascii" if is_text else "binary")
    with open(path, "ab") as file:
        file.write(text_4(PAIRS.tolist()).encode() if is_text else binary(PAIRS))
    return path


def test_periodic_surfaces_are_a_pair_of_node_sets(path):
    mesh = io.read(path)
    assert mesh.periodic_pairs == (("surface 5", "surface 7"),)
    assert (mesh.points[mesh.node_sets["surface 5"], 0] == 0).all()
    assert (mesh.points[mesh.node_sets["surface 7"], 0] == 3).all()
    assert len(mesh.node_sets["surface 5"]) == len(mesh.node_sets["surface 7"]) == 16
    assert not mesh.notes


def test_they_move_as_one_by_their_names(path):
    mesh = io.read(path)
    after = smooth(mesh, periodic=mesh.periodic_pairs).mesh.points
    low, high = (mesh.node_sets[f"surface {tag}"] for tag in (5, 7))
    np.testing.assert_array_equal(after[high] - after[low], np.tile([3.0, 0, 0], (16, 1)))


@pytest.mark.parametrize("rows", ["1 2\n", "1 x\n", "-1 2\n3 4\n", "1 99\n3 4\n"])
@pytest.mark.parametrize("version", [2, 4])
def test_a_damaged_section_is_an_error(rows, version, tmp_path):
    path = tmp_path / "cell.msh"
    io.write(path, CUBE, encoding="ascii")
    text = path.read_text() if version == 4 else version_2(CUBE)
    affine = "0\n" if version == 4 else ""
    links = f"$Periodic\n1\n2 7 5\n{affine}2\n{rows}$EndPeriodic\n"
    path.write_text(text + links)
    with pytest.raises(FileError, match=r"cell\.msh"):
        io.read(path)


def test_a_file_written_anew_lacks_the_pairs_and_it_is_said(path, tmp_path, capsys):
    mesh, out = io.read(path), tmp_path / "out.msh"
    assert "periodic pairs (surface 5 with surface 7)" in io.unsupported_data(out, mesh)
    words = ["smooth", str(path), "-o", str(out), "--method", "laplacian", "--max-iterations", "1"]
    main([*words, "--rewrite"])
    assert "cannot hold periodic pairs (surface 5 with surface 7), which is left out" in capsys.readouterr().err
    assert not io.read(out).periodic_pairs
    main(words)
    assert "left out" not in capsys.readouterr().err
    assert io.read(out).periodic_pairs == mesh.periodic_pairs


def test_repair_does_not_drop_the_pairs_of_its_own_file(tmp_path, run_command):
    path = tmp_path / "cell.msh"
    text = (version_2(CUBE) + text_2(PAIRS)).replace("$Nodes\n64\n", "$Nodes\n65\n999 0 0 77\n")
    path.write_text(text)
    assert (
        "would lose data other than the mesh: periodic pairs." in run_command("repair", path, "-o", path, status=3).err
    )
    assert path.read_text() == text


# Partitioned meshes of Gmsh.


def partitioned(version, binary):
    """Three cubes in a row, each in a partition of its own, with a face on top of each; the last is in two groups."""
    mesh = grid(3, 1, 1)
    named = '$PhysicalNames\n3\n2 8 "in"\n3 7 "vol"\n3 9 "end"\n$EndPhysicalNames\n'
    if version == 2:
        nodes = "".join(f"{k} {x} {y} {z}\n" for k, (x, y, z) in enumerate(mesh.points.tolist(), 1))
        rows = [f"{k + 1} 3 4 8 1 1 {k + 1}" for k in range(3)], [f"{k + 4} 5 4 7 1 1 {k + 1}" for k in range(3)]
        rows[1][2] = "6 5 5 7 1 2 3 -1"
        cells = [*zip(rows[0], mesh.hexes[:, 4:], strict=True), *zip(rows[1], mesh.hexes, strict=True)]
        lines = "".join(f"{head} {' '.join(str(n + 1) for n in own)}\n" for head, own in cells)
        text = f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{named}$Nodes\n16\n{nodes}$EndNodes\n$Elements\n6\n{lines}$EndElements\n"
        return text.encode()

    def put(code, *values):
        return np.array(values, f"<{code}").tobytes() if binary else " ".join(map(str, values)).encode() + b"\n"

    box = put("f8", 0, 0, 0, 3, 1, 1)
    volume = put("i4", 1) + box + put("u8", 1) + put("i4", 7) + put("u8", 0)
    surface = put("i4", 1) + box + put("u8", 1) + put("i4", 8) + put("u8", 0)
    entities = put("u8", 0, 0, 1, 1) + surface + volume
    parts = put("u8", 3) + put("u8", 1) + put("i4", 99, 2) + put("u8", 0, 0, 4, 3)
    for dimension, groups in ((2, ((), (), ())), (3, ((), (7,), (7, 9)))):  # those without have their parent's
        for k, own in enumerate(groups):
            parts += put("i4", 11 + k, dimension, 1) + put("u8", 1) + put("i4", k + 1) + box
            parts += put("u8", len(own)) + (put("i4", *own) if own else b"") + put("u8", 1) + put("i4", 5)
        if dimension == 2:  # where two parts of the volume meet
            parts += put("i4", 14, 3, 1) + put("u8", 2) + put("i4", 1, 2) + box + put("u8", 0) + put("u8", 0)
    nodes = put("u8", 1, 16, 1, 16) + put("i4", 3, 11, 0) + put("u8", 16) + put("u8", *range(1, 17))
    nodes += put("f8", *mesh.points.ravel().tolist())
    cells = put("u8", 6, 6, 1, 6)
    for k in range(3):
        cells += put("i4", 2, 11 + k, 3) + put("u8", 1) + put("u8", k + 1, *(mesh.hexes[k, 4:] + 1).tolist())
    for k in range(3):
        cells += put("i4", 3, 11 + k, 5) + put("u8", 1) + put("u8", k + 4, *(mesh.hexes[k] + 1).tolist())
    one = np.array([1], "<i4").tobytes() + b"\n" if binary else b""
    answer = b"$MeshFormat\n4.1 %d 8\n%s$EndMeshFormat\n" % (binary, one) + named.encode()
    sections = {b"Entities": entities, b"PartitionedEntities": parts, b"Nodes": nodes, b"Elements": cells}
    for name, content in sections.items():
        answer += b"$%s\n%s%s$End%s\n" % (name, content, b"\n" if binary else b"", name)
    return answer


@pytest.mark.parametrize(("version", "binary"), [(2, False), (4, False), (4, True)])
def test_a_partitioned_mesh_keeps_its_groups_and_the_partition_of_each_cell(version, binary, tmp_path):
    mesh = read_content(tmp_path / "a.msh", partitioned(version, binary))
    (quads,) = mesh.cells
    assert mesh.hex_sets["vol"].tolist() == [0, 1, 2]
    assert quads.sets["in"].tolist() == [0, 1, 2]
    assert version == 2 or mesh.hex_sets["end"].tolist() == [2]
    assert mesh.hex_data["partition"].tolist() == [1, 2, 3]
    assert quads.data["partition"].tolist() == [1, 2, 3]
    assert any("The mesh is partitioned" in note for note in mesh.notes)
    again = read_back(tmp_path / "b.msh", mesh)
    assert again.hex_data["partition"].tolist() == [1, 2, 3]
    assert again.hex_sets.keys() == mesh.hex_sets.keys()


@pytest.mark.parametrize("own", [[], [b"partition_2"]], ids=["partition", "both"])
def test_data_named_partition_are_kept_together_with_the_partition_numbers(own, tmp_path):
    data = b"".join(
        b'$ElementData\n1\n"%s"\n1\n0\n3\n0\n1\n3\n4 42\n5 43\n6 44\n$EndElementData\n' % name
        for name in [b"partition", *own]
    )
    mesh = read_content(tmp_path / "a.msh", partitioned(2, False) + data)
    title = "partition_3" if own else "partition_2"
    assert mesh.hex_data["partition"].tolist() == [42, 43, 44]
    assert mesh.hex_data[title].tolist() == [1, 2, 3]
    assert any(f"the cell data {title!r} hold" in note for note in mesh.notes)
    assert read_back(tmp_path / "b.msh", mesh).hex_data[title].tolist() == [1, 2, 3]
