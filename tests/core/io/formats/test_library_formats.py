"""Formats that meshlane reads and writes: meshes of meshio are read, and what is written is read by meshio.

SU2's files: one that Gmsh 4.15 wrote, zones, markers, and what is written and read again.
"""

import numpy as np
import pytest

from hexmend import FileError, io
from hexmend.interop import from_meshio, to_meshio
from tests.core.grids import grid, scrambled
from tests.core.io.kept import read_back, read_content, with_everything

meshio = pytest.importorskip("meshio")

MESH = scrambled(grid(3), 0.2).replace(node_data={"t": np.arange(64.0)}, hex_data={"k": np.arange(27)})
#: Suffixes by meshio's names.
WRITTEN = {"xdmf": ".xdmf", "avsucd": ".avs", "tecplot": ".tec"}
READ = WRITTEN | {"mdpa": ".mdpa", "netgen": ".vol"}


@pytest.mark.parametrize("name", READ)
def test_hexes_that_meshio_writes_are_read(name, tmp_path):
    options = {"data_format": "XML"} if name == "xdmf" else {}
    given = to_meshio(MESH.replace(node_data={}, hex_data={}))
    meshio.write(tmp_path / f"a{READ[name]}", given, file_format=name, **options)
    mesh = io.read(tmp_path / f"a{READ[name]}")
    np.testing.assert_allclose(mesh.points, MESH.points, atol=1e-14)
    assert {frozenset(row) for row in mesh.hexes.tolist()} == {frozenset(row) for row in MESH.hexes.tolist()}


@pytest.mark.parametrize("name", WRITTEN)
def test_hexes_that_are_written_are_read_by_meshio(name, tmp_path):
    io.write(tmp_path / f"a{WRITTEN[name]}", MESH)
    back = from_meshio(meshio.read(tmp_path / f"a{WRITTEN[name]}", file_format=name))
    np.testing.assert_array_equal(back.points, MESH.points)
    assert {frozenset(row) for row in back.hexes.tolist()} == {frozenset(row) for row in MESH.hexes.tolist()}


def test_the_content_tells_a_format_from_others_of_its_suffix(tmp_path):
    for own, other in ((".tec", ".dat"), (".avs", ".inp")):
        io.write(tmp_path / f"a{own}", MESH)
        assert read_content(tmp_path / f"b{other}", (tmp_path / f"a{own}").read_bytes()).n_hexes == 27


def test_nodes_of_kratos_have_numbers_of_their_own(tmp_path):
    nodes = "".join(f" {30 - k} {k & 1} {k >> 1 & 1} {k >> 2}\n" for k in range(8))
    text = f"Begin Nodes\n{nodes}End Nodes\nBegin Elements SmallDisplacementElement3D8N\n 1 0 30 29 27 28 26 25 23 24\nEnd Elements\n"
    mesh = read_content(tmp_path / "a.mdpa", text)
    assert mesh.hexes.tolist() == [[0, 1, 3, 2, 4, 5, 7, 6]]
    for old, words in (("End Elements", "a block without its End"), (" 30 29", " 99 29")):
        with pytest.raises(FileError, match=words if "End" in words else "node 99 is used"):
            read_content(tmp_path / "b.mdpa", text.replace(old, words if "End" not in words else ""))


@pytest.mark.parametrize(("name", "head", "words"), [
    ("a.e", "version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "a pointer of Git LFS, .* git lfs pull"),
    ("a.mesh", "MFEM mesh v1.0\n\ndimension\n3\n", "a mesh of MFEM. .*mesh-explorer"),
    ("a.msh", '(0 "GAMBIT to Fluent File")\n(2 3)\n', "a mesh of Fluent. .*fluent3DMeshToFoam"),
    ("a.mphtxt", "# Created by COMSOL Multiphysics\n", "a mesh of COMSOL. .*NASTRAN"),
])  # fmt: skip
def test_files_of_other_programs_are_refused_with_a_way_out(name, head, words, tmp_path):
    with pytest.raises(FileError, match=f"is {words}") as error:
        read_content(tmp_path / name, head)
    assert "correct its suffix" not in str(error.value)


POINTS = "".join(f"{x} {y} {z}\n" for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
ZONE = f"NDIME= 3\nNELEM= 1\n12 0 1 2 3 4 5 6 7 0\nNPOIN= 8 8\n{POINTS}NMARK= 1\nMARKER_TAG= low\nMARKER_ELEMS= 1\n9 0 3 2 1\n"


def read(text, tmp_path):
    return read_content(tmp_path / "a.su2", text)


def test_all_zones_are_read_each_with_its_own_nodes(tmp_path):
    second = ZONE.replace("low", "high").replace("0 0 0\n", "0.5 0 0\n")
    mesh = read(f"% two\nNZONE= 2\nIZONE= 1\n{ZONE}IZONE= 2\n{second}", tmp_path)
    assert mesh.hexes.tolist() == [list(range(8)), list(range(8, 16))]
    assert {name: members.tolist() for name, members in mesh.hex_sets.items()} == {"zone 1": [0], "zone 2": [1]}
    assert mesh.cells[0].nodes.tolist() == [[0, 3, 2, 1], [8, 11, 10, 9]]
    assert {name: members.tolist() for name, members in mesh.cells[0].sets.items()} == {"low": [0], "high": [1]}
    assert mesh.points[8].tolist() == [0.5, 0, 0]
    assert "2 zones" in mesh.notes[0]


def test_markers_are_written(tmp_path):
    (quads,) = (one for one in read_back(tmp_path / "a.su2", with_everything()).cells if one.kind == "quad")
    np.testing.assert_array_equal(quads.nodes, with_everything().cells[0].nodes[[1, 3]])
    assert quads.sets["lid"].tolist() == [0, 1]
