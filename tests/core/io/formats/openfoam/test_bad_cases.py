"""Damaged cases give one clear error that names the file, whatever is cut or changed."""

import gzip
import shutil

import numpy as np
import pytest

from hexmend import FileError, io
from tests.core.grids import grid
from tests.core.io.formats.openfoam.foam_cases import header, write_cube
from tests.core.io.kept import assert_refused

PARTS = ("points", "faces", "owner", "neighbour", "boundary")


def spoil(mesh, name, *changes):
    """Replace texts in a file of a case."""
    data = (mesh / name).read_bytes()
    for old, new in changes:
        assert old in data
        data = data.replace(old, new, 1)
    (mesh / name).write_bytes(data)


@pytest.mark.parametrize(("name", "old", "new", "words"), [
    ("points", b"(1.0 0.0 0.0)", b"(1.0 x 0.0)", "points: points holds 'x' in row 2 of 8 (line 18): expected a number"),
    ("points", b"(1.0 0.0 0.0)\n", b"", "points ends after 7 of 8 rows"),
    ("points", b"8\n(", b"7\n(", "more points than the 7"),
    ("points", b"8\n(", b"eight\n(", "the number of points is 'eight'"),
    ("points", b"(1.0 0.0 0.0)", b"(nan 0.0 0.0)", "finite"),
    ("points", b"FoamFile", b"Foam", "does not begin with the header FoamFile"),
    ("points", b"format ascii", b"format cipher", "its format is 'cipher': expected ascii or binary"),
    ("points", b"format ascii;", b"format ascii", "the entry 'format' of the header FoamFile is not a word"),
    ("faces", b"4(0 4 6 2)", b"4(0 4 6 9)", "a face refers to point 9: expected 0 to 7"),
    ("faces", b"4(0 4 6 2)", b"3(0 4 6 2)", "faces holds"),
    ("faces", b"4(0 4 6 2)", b"4(0 4 6)", "faces holds"),
    ("owner", b"\n0\n", b"\n7\n", "owner: refers to cells from 0 to 7: expected 0 to 5"),
    ("owner", b"\n0\n", b"\n-1\n", "refers to cells from -1 to 0"),
    ("owner", b"6\n(", b"5\n(", "owner holds more than the 5 items"),
    ("owner", b"6\n(\n0\n", b"5\n(\n", "owner holds 5 numbers: expected 6"),
    ("neighbour", b"0\n(", b"9\n(", "neighbour ends after 0 of 9 rows"),
    ("boundary", b"type wall;", b"", "patch 'walls' has no entry 'type'"),
    ("boundary", b"nFaces 4;", b"nFaces four;", "nFaces of patch 'walls' is 'four': expected a natural number"),
    ("boundary", b"nFaces 4;", b"nFaces 40;", "patch 'walls' has the faces 0 to 39: expected faces of the boundary, 0 to 5"),
    ("boundary", b"nFaces 4;", b"nFaces 4", "the entry 'nFaces' of patch 'walls' is not a word"),
    ("boundary", b"type patch;", b"type cyclic; neighbourPatch gone;", "the neighbourPatch 'gone', which does not exist"),
    ("boundary", b"    ends", b'#include "gone"\n    ends', "includes 'gone', which does not exist"),
    ("boundary", b"    ends", b'#include "boundary"\n    ends', "Check that no file includes itself."),
])  # fmt: skip
def test_what_is_wrong_is_named(name, old, new, words, tmp_path):
    mesh = write_cube(tmp_path / "cube")
    spoil(mesh, name, (old, new))
    assert_refused(tmp_path / "cube", words)


@pytest.mark.parametrize("name", PARTS)
def test_a_missing_file_is_named(name, tmp_path):
    mesh = write_cube(tmp_path / "cube")
    (mesh / name).unlink()
    with pytest.raises(
        FileError, match="is a folder: expected" if name == "faces" else f"polyMesh: has no file {name}"
    ):
        io.read(tmp_path / "cube")


def test_binary_files_of_other_widths_are_refused(tmp_path):
    mesh = write_cube(tmp_path / "cube", binary=(32, 64))
    spoil(mesh, "owner", (b"label=32", b"label=64"))
    with pytest.raises(FileError, match=r"owner: owner (of 6 items does not end at byte|ends after)"):
        io.read(tmp_path / "cube")


def test_old_binary_faces_are_refused_with_the_program_that_converts_them(tmp_path):
    mesh = write_cube(tmp_path / "cube", binary=(32, 64))
    spoil(mesh, "faces", (b"faceCompactList", b"faceList"))
    with pytest.raises(FileError, match="foamFormatConvert"):
        io.read(tmp_path / "cube")


def test_a_damaged_archive_is_named(tmp_path):
    mesh = write_cube(tmp_path / "cube", compressed=True)
    (mesh / "points.gz").write_bytes((mesh / "points.gz").read_bytes()[:-30])
    with pytest.raises(FileError, match=r"points.gz: is a damaged gzip file"):
        io.read(tmp_path / "cube")


def test_huge_numbers_take_no_memory(tmp_path):
    mesh = write_cube(tmp_path / "cube")
    for text in (b"99999999999{0}", b"99999999999999999999{0}", b"99999999999(0)", b"9999999999999(" + b"(" * 9 + b")"):
        (mesh / "owner").write_bytes(header("labelList", "owner") + text)
        with pytest.raises(FileError, match="owner"):
            io.read(tmp_path / "cube")
    spoil(mesh, "boundary", (b"ends", b"{" * 5000))
    with pytest.raises(FileError):
        io.read(tmp_path / "cube")


@pytest.fixture(scope="module")
def cases(tmp_path_factory):
    """A case with zones as text, binary and gzip."""
    folder, mesh = tmp_path_factory.mktemp("cases"), grid(2)
    sides = {"wall": np.array([[0, 0], [2, 0]]), "lid": np.array([[1, 1]])}
    mesh = mesh.replace(side_sets=sides, hex_sets={"half": np.arange(4)}, node_sets={"some": np.array([1, 5])})
    for encoding in ("ascii", "binary"):
        io.write(folder / encoding / "case.foam", mesh, encoding=encoding)
    shutil.copytree(folder / "binary", folder / "gzip")
    for path in (folder / "gzip/constant/polyMesh").iterdir():
        if path.name != "boundary":
            path.with_name(f"{path.name}.gz").write_bytes(gzip.compress(path.read_bytes()))
            path.unlink()
    return folder
