"""Bad files: one clear error that names file, place and remedy; whatever is cut or flipped, never another failure."""

import bz2
import gzip
import lzma
import os

import numpy as np
import pytest

from hexmend import io
from hexmend.errors import FileError
from hexmend.io import FORMATS
from hexmend.io.storage.atomic import atomic_write
from tests.core.grids import grid, scrambled

HEAD = "# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n"
CUBE = "POINTS 8 float\n0 0 0 1 0 0 1 1 0 0 1 0\n0 0 1 1 0 1 1 1 1 0 1 1\n"


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("a.vtk", "hello\n", "line 1 is 'hello': expected '# vtk DataFile"),
        ("a.vtk", "# vtk DataFile Version 2.0\nt\nASCII\nDATASET POLYDATA\n", "its dataset is POLYDATA: expected UNSTRUCTURED_GRID"),
        ("a.vtk", HEAD + "POINTS 8 float\n0 0 0 1 0 0\n", "POINTS ends after 2 of 8 rows"),
        ("a.vtk", HEAD + "POINTS 2 float\n0 0 0 1 x 0\n", "POINTS holds 'x' in row 2 of 2 (line 6): expected a number"),
        ("a.vtk", HEAD + CUBE, "has no section CELLS"),
        ("a.vtk", HEAD + CUBE + "CELLS 1 9\n8 0 1 2 3 4 5 6 8\nCELL_TYPES 1\n12\n", "expected numbers from 0 to 7"),
        ("a.vtk", HEAD + CUBE + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n", "holds no hexahedra, but 1 tetra cell"),
        ("a.vtk", HEAD + CUBE + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n9\n", "holds no hexahedra"),
        ("a.mesh", "MeshVersionFormatted 2\nDimension 2\n", "its Dimension is 2: expected 3"),
        ("a.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 0 0 0\nTetrahedra\n1\n1 1 1 1 0\nEnd\n", "holds no hexahedra, but 1 tetra cell"),
        ("a.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 0 0 0\nEnd\n", "holds no hexahedra"),
        ("a.meshb", "words", "does not begin with the number 1"),
        ("a.vtu", "<html/>", "does not begin with <VTKFile"),
        ("a.vtu", '<VTKFile type="UnstructuredGrid"><Unstr', "its XML is broken at line 1"),
        ("a.xyz", "1 2 3", "the suffix '.xyz' is unknown. Hexmend can read"),
        ("a.vtk", "", "is empty"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named(name, text, words, tmp_path):
    (tmp_path / name).write_text(text)
    with pytest.raises(FileError) as error:
        io.read(tmp_path / name)
    assert words in str(error.value)


def test_a_missing_file_is_said_with_its_nearest(tmp_path):
    io.write(tmp_path / "bridge.vtk", grid(1))
    with pytest.raises(FileError, match=r"Did you mean bridge\.vtk"):
        io.read(tmp_path / "brigde.vtk")
    with pytest.raises(FileError, match="is a folder"):
        io.read(tmp_path)


def test_a_write_replaces_the_file_with_the_users_permissions(tmp_path):
    path = tmp_path / "new.vtk"
    with atomic_write(path) as temporary:
        assert temporary.parent == tmp_path
        assert temporary.suffix == ".vtk"
        temporary.write_text("new")
    assert path.read_text() == "new"
    mask = os.umask(0)
    os.umask(mask)
    assert path.stat().st_mode & 0o777 == 0o666 & ~mask


@pytest.mark.parametrize("name", ["no/such/folder/a.vtk", "a.xyz"])
def test_targets_that_cannot_be_written_are_said(name, tmp_path):
    with pytest.raises(FileError):
        io.write(tmp_path / name, grid(1))
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("suffix", [".inp", ".msh", ".mesh", ".bdf", ".su2", ".vtk", ".ovm"])
def test_a_byte_order_mark_is_no_part_of_the_text(suffix, tmp_path):
    path, mesh = tmp_path / f"a{suffix}", scrambled(grid(2), 0.2)
    io.write(path, mesh, encoding="ascii")
    text = path.read_bytes()
    if suffix == ".inp":
        text = text[text.index(b"*NODE") :]  # a heading before it would be lost with the mark, unnoticed
    path.write_bytes(b"\xef\xbb\xbf" + text)
    given = io.read(path)
    assert given.n_hexes == 8
    if FORMATS[io.format_lookup.format_of(path).name].locate is not None:
        io.write(tmp_path / f"b{suffix}", given.with_points(given.points + 1), like=path)
        np.testing.assert_allclose(io.read(tmp_path / f"b{suffix}").points, given.points + 1, rtol=1e-12)


@pytest.mark.parametrize(
    "name", [*(f"a{one.suffixes[0]}" for one in FORMATS.values() if one.write and not one.place), "a.vtk.gz"]
)
def test_compressed_files_are_called_compressed_whatever_their_names(name, tmp_path):
    for compress, program in ((gzip.compress, "gzip"), (bz2.compress, "bzip2"), (lzma.compress, "xz")):
        (tmp_path / name).write_bytes(compress(b"anything"))
        with pytest.raises(FileError, match=f"is compressed by {program}. Decompress it first."):
            io.read(tmp_path / name)
