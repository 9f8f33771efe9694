"""Writing VTU: what is written is read again by us and by VTK."""

import numpy as np
import pytest

from hexmend import io
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
