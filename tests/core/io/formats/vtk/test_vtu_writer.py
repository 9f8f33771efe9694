"""Writing VTU: what is written is read again by us and by VTK, and compared before it replaces anything."""

import re
from pathlib import Path

import numpy as np
import pytest

from hexmend import io
from hexmend.errors import FileError
from hexmend.io.formats.vtk import vtu_writer
from tests.core.grids import grid, scrambled


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
