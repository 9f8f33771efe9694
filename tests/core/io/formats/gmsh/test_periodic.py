"""Periodic surfaces of Gmsh's files."""

import numpy as np
import pytest

from hexmend import FileError, io, smooth
from hexmend.cli.main import main
from tests.core.grids import grid, scrambled

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
