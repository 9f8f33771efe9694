"""Coordinates replaced in ExodusII files of all containers, types and layouts."""

import numpy as np
import pytest

from hexmend import io
from hexmend.io import Original, write_as_given
from hexmend.io.formats.exodus.netcdf3 import ClassicReader
from tests.core.grids import displaced
from tests.core.io.formats.exodus.exodus_files import on_hdf5, rich
from tests.core.io.kept import assert_same

h5py = pytest.importorskip("h5py")


def moved(mesh):
    return displaced(mesh, np.s_[::3], 0.01 * np.random.default_rng(3).normal(size=mesh.points[::3].shape))


def replaced(source, target):
    given = io.read(source)
    mesh = moved(given)
    written = write_as_given(target, mesh, Original(source, given))
    assert written.replaced, written.notes
    again = io.read(target)
    assert_same(again.with_points(mesh.points), mesh)
    return mesh, again, written


def test_a_classic_file_keeps_each_byte_that_is_no_coordinate(tmp_path):
    io.write(tmp_path / "a.exo", rich())
    mesh, again, _ = replaced(tmp_path / "a.exo", tmp_path / "b.exo")
    np.testing.assert_array_equal(again.points, mesh.points)
    given, data = (bytearray((tmp_path / name).read_bytes()) for name in ("a.exo", "b.exo"))
    store = ClassicReader(tmp_path / "a.exo")
    for name in ("coordx", "coordy", "coordz"):
        variable = store.variable(name)
        for one in (given, data):
            one[variable.begin : variable.begin + variable.data_size] = bytes(variable.data_size)
    assert given == data


@pytest.mark.parametrize("kind", ["f8", "f4"])
def test_compressed_coordinates_are_written_by_the_library(kind, tmp_path):
    io.write(tmp_path / "a.exo", rich())
    on_hdf5(tmp_path / "a.exo", tmp_path / "b.exo", zlib=True, kind=kind)
    mesh, again, written = replaced(tmp_path / "b.exo", tmp_path / "c.exo")
    np.testing.assert_allclose(again.points, mesh.points, rtol=0, atol=0 if kind == "f8" else 1e-6)
    assert any("32-bit" in note for note in written.notes) == (kind == "f4")
    with h5py.File(tmp_path / "b.exo") as one, h5py.File(tmp_path / "c.exo") as other:
        assert list(one) == list(other)
        assert other["coordx"].dtype == kind
        for name in one:
            if not name.startswith("coord"):
                np.testing.assert_array_equal(one[name][()], other[name][()])
                assert dict(one[name].attrs).keys() == dict(other[name].attrs).keys()
