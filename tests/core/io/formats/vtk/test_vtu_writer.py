"""Writing VTU: what is written is read again by us and by VTK, and compared before it replaces anything."""

import re
from pathlib import Path

import numpy as np
import pytest

from hexmend import io
from hexmend.errors import FileError
from hexmend.io.formats.vtk import vtu_writer
from tests.core.grids import grid, scrambled

NAMES = ["p & T", "a < b", 'say "x"', "it's", "tab\tand\nline", "ä λ 漢"]


@pytest.mark.parametrize("encoding", ["binary", "ascii"])
def test_every_name_and_type_comes_back(encoding, tmp_path):
    arrays = {name: np.arange(27) + k for k, name in enumerate(NAMES)}
    arrays |= {
        code: np.arange(27).astype(code) for code in ("i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8")
    }
    arrays["most"] = np.full(27, 2**64 - 1, np.uint64)
    arrays["least"] = np.full((27, 2), -(2**63))
    arrays["big"] = np.arange(27, dtype=">f8")
    arrays["not finite"] = np.tile([np.nan, np.inf, -np.inf], (27, 3))
    fields = {
        "title": ["made & elsewhere", "", "ä"],
        "time": np.array([0.1, 1e-300]),
        "codes": np.arange(6).reshape(2, 3),
    }
    path = tmp_path / "a.vtu"
    io.write(path, grid(2).replace(node_data=arrays, field_data=fields), encoding=encoding)
    back = io.read(path)
    assert list(back.node_data) == list(arrays)
    for name, values in arrays.items():
        np.testing.assert_array_equal(back.node_data[name], values)
        assert back.node_data[name].dtype == values.dtype.newbyteorder("=")
    assert back.field_data["title"] == fields["title"]
    np.testing.assert_array_equal(back.field_data["time"], fields["time"])
    np.testing.assert_array_equal(back.field_data["codes"], fields["codes"])
    again = tmp_path / "b.vtu"
    io.write(again, back.replace(name="a"), encoding=encoding)
    assert again.read_bytes() == path.read_bytes()


@pytest.mark.parametrize("encoding", ["binary", "ascii"])
def test_vtk_reads_it_alike(encoding, tmp_path):
    pyvista = pytest.importorskip("pyvista")
    mesh = scrambled(grid(6), 0.3)
    data = {name: np.arange(mesh.n_nodes) / (3 + k) for k, name in enumerate(NAMES[:4])}
    io.write(tmp_path / "a.vtu", mesh.replace(node_data=data, field_data={"title": ["x"]}), encoding=encoding)
    other = pyvista.read(tmp_path / "a.vtu")
    np.testing.assert_array_equal(other.points, mesh.points)
    np.testing.assert_array_equal(other.cells_dict[12], mesh.hexes)
    for name, values in data.items():
        np.testing.assert_array_equal(other.point_data[name], values)


def test_vtk_reads_arrays_of_many_blocks_and_of_none(tmp_path, monkeypatch):
    pyvista = pytest.importorskip("pyvista")
    monkeypatch.setattr(vtu_writer, "_BLOCK", 1000)
    mesh = scrambled(grid(6), 0.3)
    fields = {"none": np.zeros(0), "no rows": np.zeros((0, 3)), "one": np.ones(1)}
    io.write(tmp_path / "a.vtu", mesh.replace(field_data=fields))
    other = pyvista.read(tmp_path / "a.vtu")
    np.testing.assert_array_equal(other.points, mesh.points)
    np.testing.assert_array_equal(other.cells_dict[12], mesh.hexes)
    np.testing.assert_array_equal(other.field_data["one"], 1)
    for encoding in ("binary", "ascii"):
        io.write(tmp_path / "b.vtu", mesh.replace(field_data=fields), encoding=encoding)
        assert not np.size(io.read(tmp_path / "b.vtu").field_data["none"])


def test_what_vtk_cannot_hold_is_refused(tmp_path):
    with pytest.raises(FileError, match="the array 'z' holds float16, which VTK cannot"):
        io.write(tmp_path / "a.vtu", grid(1).replace(node_data={"z": np.zeros(8, np.float16)}))
    assert not list(tmp_path.iterdir())


def test_a_file_that_is_not_read_again_as_it_was_written_replaces_nothing(tmp_path, monkeypatch):
    """As on a disk that loses bytes: the old file stays."""
    path = tmp_path / "a.vtu"
    path.write_text("old")
    true = vtu_writer.Document

    def damaging(place: Path, kind: str):
        content = bytearray(place.read_bytes())
        offsets = [match.span(1) for match in re.finditer(rb'offset="(\d+)"', content)]
        (first, end), (begin, stop) = offsets[0], offsets[-1]  # the data "a" begin where the points do
        content[begin:stop] = content[first:end].ljust(stop - begin, b"0")
        place.write_bytes(content)
        return true(place, kind)

    monkeypatch.setattr(vtu_writer, "Document", damaging)
    with pytest.raises(FileError, match="the array 'a' is not read again as it was written") as error:
        io.write(path, grid(2).replace(node_data={"a": np.zeros((27, 3))}))
    assert str(error.value).startswith("a.vtu: ")
    assert path.read_text() == "old"
    assert [one.name for one in tmp_path.iterdir()] == ["a.vtu"]
