"""PVTU: the pieces in its folder, merged without ghost cells."""

import numpy as np
import pytest

from hexmend import io
from hexmend.errors import FileError
from hexmend.mesh.mesh import Mesh
from tests.core.grids import grid


def halves(folder, numbered=False, ghosts=False):
    """Two files of a hex each (of two, one a ghost, where asked for), and one that names them."""
    mesh = grid(2, 1, 1)
    for k in range(2):
        hexes = mesh.hexes if ghosts else mesh.hexes[k : k + 1]
        used, nodes = np.unique(hexes, return_inverse=True)
        data = {"GlobalNodeIds": used} if numbered else {}
        hex_data = {"part": np.full(len(hexes), k)}
        if ghosts:
            hex_data["vtkGhostType"] = (np.arange(2) != k).astype(np.uint8)
        piece = Mesh(mesh.points[used], nodes.reshape(-1, 8), node_data=data, hex_data=hex_data)
        io.write(folder / f"half_{k}.vtu", piece.replace(field_data={"title": ["x"]}))
    sources = "".join(f'<Piece Source="half_{k}.vtu"/>' for k in range(2))
    return pvtu(folder, sources), mesh


def pvtu(folder, pieces):
    path = folder / "whole.pvtu"
    path.write_text(f'<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid>{pieces}</PUnstructuredGrid></VTKFile>')
    return path


@pytest.mark.parametrize("numbered", [False, True])
@pytest.mark.parametrize("ghosts", [False, True])
def test_pieces_are_merged(numbered, ghosts, tmp_path):
    path, mesh = halves(tmp_path, numbered, ghosts)
    back = io.read(path)
    assert back.n_nodes == (12 if numbered else 16)
    np.testing.assert_array_equal(back.points[back.hexes], mesh.points[mesh.hexes])
    np.testing.assert_array_equal(back.hex_data["part"], [0, 1])
    assert back.field_data["title"] == ["x"]
    assert ("duplicate nodes" in back.notes[0]) is not numbered
    assert any("2 ghost cells" in note for note in back.notes) is ghosts


def test_what_vtk_writes_in_parallel_is_read(tmp_path):
    vtk = pytest.importorskip("vtk")
    pyvista = pytest.importorskip("pyvista")
    mesh = grid(3)
    content = pyvista.UnstructuredGrid({12: mesh.hexes.astype(np.int64)}, mesh.points)
    writer = vtk.vtkXMLPUnstructuredGridWriter()
    writer.SetInputData(content)
    writer.SetFileName(str(tmp_path / "a.pvtu"))
    writer.SetUseSubdirectory(True)
    assert writer.Write()
    np.testing.assert_array_equal(io.read(tmp_path / "a.pvtu").hexes, mesh.hexes)


@pytest.mark.parametrize(
    ("pieces", "words"),
    [
        ("", "names no pieces"),
        ('<Piece Source="none.vtu"/>', r"whole\.pvtu: its piece none\.vtu: there is no such file"),
        ('<Piece Source="half_0.vtu"/><Piece Source="half_0.vtu"/>', "names a piece twice"),
        ('<Piece Source="/etc/passwd"/>', "expected a file in its folder or below"),
        ('<Piece Source="../half_0.vtu"/>', "expected a file in its folder or below"),
        ('<Piece Source="."/>', "is a folder"),
        ('<Piece Source="whole.pvtu"/>', r"its piece whole\.pvtu: is a VTKFile of the type 'PUnstructuredGrid'"),
    ],
)
def test_what_is_wrong_is_named(pieces, words, tmp_path):
    halves(tmp_path)
    with pytest.raises(FileError, match=words):
        io.read(pvtu(tmp_path, pieces))
