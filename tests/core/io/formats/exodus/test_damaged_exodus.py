"""Truncated or inconsistent ExodusII files, and other NetCDF files, give one clear error each."""

import struct

import pytest

from hexmend import FileError, io
from tests.core.grids import grid


def test_counts_larger_than_the_file_are_refused_before_anything_is_allocated(tmp_path):
    io.write(tmp_path / "good.exo", grid(2))
    data = (tmp_path / "good.exo").read_bytes()
    place = data.index(b"num_nodes") + 12
    (tmp_path / "bad.exo").write_bytes(data[:place] + struct.pack(">i", 2**31 - 1) + data[place + 4 :])
    with pytest.raises(FileError, match="the file ends at byte"):
        io.read(tmp_path / "bad.exo")


@pytest.mark.parametrize("huge", ["num_nodes", "num_el_blk", "num_el_in_blk1"])
def test_huge_dimensions_on_hdf5_without_values_are_refused(huge, tmp_path):
    """HDF5 allocates no space for an array without values, whatever its size."""
    netCDF4 = pytest.importorskip("netCDF4")
    with netCDF4.Dataset(tmp_path / "a.exo", "w") as file:
        lengths = {"num_nodes": 8, "num_nod_per_el1": 8, "num_dim": 3}
        lengths |= dict.fromkeys(("num_elem", "num_el_blk", "num_el_in_blk1"), 1) | {huge: 2**40}
        for one, length in lengths.items():
            file.createDimension(one, length)
        for axis in "xyz":
            file.createVariable(f"coord{axis}", "f8", ("num_nodes",))
        file.createVariable("connect1", "i4", ("num_el_in_blk1", "num_nod_per_el1")).elem_type = "HEX8"
    with pytest.raises(FileError, match=r"a\.exo: .*(more than a file of its size holds|of \d+ variables)"):
        io.read(tmp_path / "a.exo")


def test_netcdf_that_is_no_exodus_is_not_called_damaged(tmp_path):
    from scipy.io import netcdf_file

    with netcdf_file(tmp_path / "weather.exo", "w") as file:
        file.createDimension("lat", 3)
        file.createVariable("t", "d", ("lat",))[:] = [1, 2, 3]
    with pytest.raises(FileError, match="no dimension num_nodes") as caught:
        io.read(tmp_path / "weather.exo")
    assert "damaged" not in str(caught.value)
