"""PVTU: the pieces in its folder, merged without ghost cells, and written again."""

import os
import re
from pathlib import Path

import numpy as np
import pytest

from hexmend import FileError, Mesh, io
from hexmend.cli.main import main
from hexmend.io.files import remove
from hexmend.io.formats.vtk.grid import Grid, from_mesh
from hexmend.io.formats.vtk.pvtu_writer import PieceFiles, numbered
from tests.core.grids import grid
from tests.core.io.kept import assert_same, read_back, with_everything


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
    assert back.n_nodes == 12
    np.testing.assert_array_equal(back.points[back.hexes], mesh.points[mesh.hexes])
    np.testing.assert_array_equal(back.hex_data["part"], [0, 1])
    assert back.field_data["title"] == ["x"]
    assert ("4 nodes are merged with others at the same place" in back.notes[0]) is not numbered
    assert any("2 ghost cells" in note for note in back.notes) is ghosts


WRONG_PIECES = [
    ("", "lists no pieces"),
    ('<Piece Source="none.vtu"/>', r"whole\.pvtu: its piece none\.vtu: there is no such file"),
    ('<Piece Source="half_0.vtu"/><Piece Source="half_0.vtu"/>', "lists a piece twice"),
    ('<Piece Source="/etc/passwd"/>', "expected a file in its folder or below"),
    ('<Piece Source="../half_0.vtu"/>', "expected a file in its folder or below"),
    ('<Piece Source="."/>', "is a folder"),
    ('<Piece Source="whole.pvtu"/>', r"its piece whole\.pvtu: is a VTKFile of the type 'PUnstructuredGrid'"),
]


@pytest.mark.parametrize(("pieces", "words"), WRONG_PIECES)
def test_what_is_wrong_is_named(pieces, words, tmp_path):
    halves(tmp_path)
    with pytest.raises(FileError, match=words):
        io.read(pvtu(tmp_path, pieces))


def test_nodes_of_one_piece_at_the_same_place_stay_apart(tmp_path):
    mesh = grid(2, 1, 1)
    apart = Mesh(mesh.points[mesh.hexes].reshape(-1, 3), np.arange(16).reshape(2, 8))
    io.write(tmp_path / "both.vtu", apart)
    assert io.read(pvtu(tmp_path, '<Piece Source="both.vtu"/>')).n_nodes == 16
    io.write(tmp_path / "one.vtu", Mesh(mesh.points + [0, 0, 1], mesh.hexes))
    back = io.read(pvtu(tmp_path, '<Piece Source="both.vtu"/><Piece Source="one.vtu"/>'))
    assert back.n_nodes == 16 + 12 - 4  # of the six places where they meet, two have two nodes of the first piece


def rich():
    """A mesh with data, sets, fixed nodes and other cells, as a file has it."""
    mesh, rng = with_everything(), np.random.default_rng(5)
    data = {**mesh.hex_data, "w": rng.random(mesh.n_hexes).astype(np.float32)}
    return mesh.replace(
        node_data={**mesh.node_data, "t": rng.random((mesh.n_nodes, 3))},
        hex_data=data,
        side_sets={},
        cells=mesh.cells[:1],
        pinned=np.arange(mesh.n_nodes) % 5 == 0,
        field_data={"title": ["x"]},
    )


def check_same(a, b):
    assert_same(a, b)
    np.testing.assert_array_equal(a.pinned, b.pinned)
    np.testing.assert_array_equal(a.node_data["t"], b.node_data["t"])
    np.testing.assert_array_equal(a.hex_data["w"], b.hex_data["w"])
    assert a.hex_data["w"].dtype == b.hex_data["w"].dtype
    assert dict(a.field_data) == dict(b.field_data)


def write_in_pieces(path, mesh, count, seed=0):
    """Deal the cells of a mesh to pieces at random; returns the numbers of cells of each."""
    whole, files = from_mesh(mesh), PieceFiles.new(path)
    rng = np.random.default_rng(seed)
    of_cell, of_node = rng.integers(0, count, len(whole.types)), rng.integers(0, count, len(whole.points))
    files.make_folder()
    for k in range(count):
        cells = np.flatnonzero(of_cell == k)
        rows = [whole.nodes[whole.start[cell] : whole.start[cell + 1]] for cell in cells]
        nodes = np.union1d(np.flatnonzero(of_node == k), np.concatenate([np.empty(0, int), *rows])).astype(int)
        piece = Grid(
            whole.points[nodes],
            whole.types[cells],
            np.concatenate([[0], np.cumsum([len(row) for row in rows])]).astype(int),
            np.searchsorted(nodes, np.concatenate([np.empty(0, int), *rows])),
            {name: np.asarray(values)[nodes] for name, values in whole.node_data.items()},
            {name: np.asarray(values)[cells] for name, values in whole.cell_data.items()},
            whole.field_data if k == 0 else {},
        )
        piece = numbered(piece, nodes, cells)
        files.write_piece(k, piece)
    files.finish(count, piece)
    return of_cell


@pytest.mark.parametrize("encoding", ["binary", "ascii"])
def test_a_mesh_is_written_in_one_piece(tmp_path, encoding):
    mesh = rich()
    back = read_back(tmp_path / "a.pvtu", mesh, encoding=encoding)
    check_same(back, mesh)
    assert back.notes == ()
    assert [file.name for file in (tmp_path / "a").iterdir()] == ["a_0.vtu"]


def test_many_pieces_are_the_mesh_again_bit_for_bit(tmp_path):
    mesh = rich()
    write_in_pieces(tmp_path / "a.pvtu", mesh, 4)
    check_same(io.read(tmp_path / "a.pvtu"), mesh)


def test_vtk_reads_the_pieces(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    mesh = rich()
    of_cell = write_in_pieces(tmp_path / "a.pvtu", mesh, 3)
    found = pyvista.read(tmp_path / "a.pvtu")
    assert type(pyvista.get_reader(tmp_path / "a.pvtu").reader).__name__ == "vtkXMLPUnstructuredGridReader"
    assert found.n_cells == len(of_cell)
    order = np.argsort(found.cell_data["GlobalElementId"])
    np.testing.assert_array_equal(found.cell_data["w"][order][:12], mesh.hex_data["w"])
    places = {int(k): tuple(x) for k, x in zip(found.point_data["GlobalNodeId"], found.points, strict=True)}
    np.testing.assert_array_equal([places[k] for k in range(mesh.n_nodes)], mesh.points)


@pytest.mark.parametrize("problem", [KeyboardInterrupt, FileError("a.pvtu", "cannot be written", "Free the place.")])
def test_a_new_file_leaves_the_pieces_of_the_old_one_until_it_is_whole(tmp_path, monkeypatch, problem):
    path, old, new = tmp_path / "a.pvtu", grid(2), grid(3)
    io.write(path, old)
    before = sorted(tmp_path.rglob("*"))
    monkeypatch.setattr(PieceFiles, "finish", lambda *_: (_ for _ in ()).throw(problem))
    with pytest.raises((KeyboardInterrupt, FileError)):
        io.write(path, new)
    monkeypatch.undo()
    assert sorted(tmp_path.rglob("*")) == before
    assert io.read(path).n_hexes == old.n_hexes
    for mesh in (new, old):
        assert read_back(path, mesh).n_hexes == mesh.n_hexes
        assert len(list((tmp_path / "a").iterdir())) == 1


def test_files_of_others_in_the_folder_of_the_pieces_stay(tmp_path):
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "notes.txt").write_text("x")
    write_in_pieces(tmp_path / "a.pvtu", grid(2), 3)
    io.write(tmp_path / "a.pvtu", grid(2))
    assert sorted(file.name for file in (tmp_path / "a").iterdir()) == ["a-2_0.vtu", "notes.txt"]
    remove(tmp_path / "a.pvtu")
    assert [file.name for file in tmp_path.rglob("*")] == ["a", "notes.txt"]
    (tmp_path / "a" / "notes.txt").unlink()
    write_in_pieces(tmp_path / "a.pvtu", grid(2), 2)
    remove(tmp_path / "a.pvtu")
    assert list(tmp_path.iterdir()) == []


def test_meshes_of_others_with_the_names_of_pieces_stay(tmp_path):
    (tmp_path / "a").mkdir()
    series = [tmp_path / "a" / f"a_{k}.vtu" for k in range(3)]
    for k, path in enumerate(series):
        io.write(path, grid(k + 1))
    for n in (4, 5):
        assert read_back(tmp_path / "a.pvtu", grid(n)).n_hexes == n**3
    remove(tmp_path / "a.pvtu")
    assert sorted((tmp_path / "a").iterdir()) == series
    assert [io.read(path).n_hexes for path in series] == [1, 8, 27]


def rename(path):
    path.rename(path.with_name("b.pvtu"))


def lose_the_mark(path):
    path.write_text(re.sub("<!--.*-->", "", path.read_text()))  # as another program writes it


def name_by(source):
    def name(path):
        (path.parent / "link").symlink_to("a", target_is_directory=True)
        pvtu(path.parent, f'<Piece Source="{source}"/>')

    return name


OTHERS = [rename, lose_the_mark, *map(name_by, ["a\\a_0.vtu", "x/../a/a_0.vtu", "link/a_0.vtu"])]


@pytest.mark.parametrize("change", OTHERS)
def test_pieces_of_other_files_stay(tmp_path, change):
    io.write(tmp_path / "a.pvtu", grid(2))
    change(tmp_path / "a.pvtu")
    for _ in range(2):
        io.write(tmp_path / "a.pvtu", grid(3))
    assert io.read(tmp_path / "a" / "a_0.vtu").n_hexes == 8
    assert io.read(tmp_path / "a.pvtu").n_hexes == 27
    assert len(list((tmp_path / "a").iterdir())) == 2


def test_a_link_that_leads_back_to_itself_in_the_folder_does_no_harm(tmp_path):
    for name in ("loop.pvtu", "loop.vtu"):
        (tmp_path / name).symlink_to(name)
    for n in (2, 3):
        io.write(tmp_path / "a.pvtu", grid(n))
    assert len(list((tmp_path / "a").iterdir())) == 1
    whole = pvtu(tmp_path, '<Piece Source="loop.vtu"/>')
    io.write(tmp_path / "b.vtu", grid(2))
    assert main(["smooth", str(tmp_path / "b.vtu"), "-o", str(whole), "--max-iterations", "1"]) == 0
    assert io.read(whole).n_hexes == 8


def test_a_piece_is_no_place_for_the_result_of_its_file_and_the_file_none_for_that_of_its_piece(tmp_path, run_command):
    io.write(tmp_path / "a.pvtu", grid(2))
    whole, piece = str(tmp_path / "a.pvtu"), str(tmp_path / "a" / "a_0.vtu")
    before = [Path(path).read_bytes() for path in (whole, piece)]
    printed = run_command("smooth", piece, "-o", whole, status=3).err
    assert "a.pvtu: includes a_0.vtu, the given mesh. Choose another name." in printed
    printed = run_command("smooth", whole, "-o", piece, status=3).err
    assert "a_0.vtu: is included by a.pvtu. Choose another name." in printed
    assert [Path(path).read_bytes() for path in (whole, piece)] == before
    assert main(["smooth", whole, "-o", whole, "--max-iterations", "1"]) == 0
    assert io.read(whole).n_hexes == 8


@pytest.mark.parametrize("name", ["caf\udce9.pvtu", "a\x01b.pvtu", "a:b.pvtu", 'a b&"<ö.pvtu'])
def test_names_of_files_that_xml_cannot_hold(tmp_path, name):
    if os.name == "nt":
        pytest.skip("Windows has no files of these names")
    assert read_back(tmp_path / name, grid(2)).n_hexes == 8


def test_other_numbers_of_nodes_do_not_count_where_those_of_the_file_are_there(tmp_path):
    mesh = rich()
    ids = np.arange(mesh.n_nodes) // 2  # as a file may have them, of no meaning for its pieces
    mesh = mesh.replace(node_data={"GlobalNodeIds": ids, **mesh.node_data})
    write_in_pieces(tmp_path / "a.pvtu", mesh, 3)
    check_same(io.read(tmp_path / "a.pvtu"), mesh)
