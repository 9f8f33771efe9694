"""Whole numbers at the ends of what 32 bits hold are kept exactly by ExodusII's classic container; ids of 2^63 by none."""

import numpy as np
import pytest

from hexmend import Cells, io
from hexmend.io.formats.exodus.netcdf3_writer import ClassicWriter
from tests.core.grids import grid

ENDS = [-(2**31) - 1, -(2**31), 2**31 - 1, 2**31]


@pytest.mark.parametrize("number", ENDS)
def test_a_number_takes_64_bits_only_where_32_do_not_hold_it(number, tmp_path):
    from scipy.io import netcdf_file

    writer = ClassicWriter({})
    writer.add_variable("one", {"n": 2}, np.array([0, number]))
    if -(2**31) <= number < 2**31:
        writer.write(tmp_path / "a.nc")
        with netcdf_file(tmp_path / "a.nc", mmap=False) as file:
            assert file.variables["one"][:].tolist() == [0, number]
            assert file.variables["one"].typecode() == "i"
    else:
        writer.write(tmp_path / "a.nc")
        assert (tmp_path / "a.nc").read_bytes()[:4] == b"CDF\x05"


@pytest.mark.parametrize("length", [5, 31, 32, 33, 80])
def test_every_text_ends_with_a_zero_byte_as_programs_in_c_expect(length, tmp_path):
    from scipy.io import netcdf_file

    writer = ClassicWriter({})
    writer.add_strings("names", "n", ["a" * length, "b"])
    writer.write(tmp_path / "a.nc")
    with netcdf_file(tmp_path / "a.nc", mmap=False) as file:
        letters = file.variables["names"]
        assert letters.shape == (2, max(33, length + 1))
        assert b"".join(letters[0]) == b"a" * length  # of zero bytes NumPy makes nothing


@pytest.mark.parametrize("where", ["hexes", "quads", "both", "neither"])
def test_there_is_a_time_step_where_any_block_has_results(where, tmp_path):
    from scipy.io import netcdf_file

    mesh = grid(2)
    quads = Cells("quad", mesh.hexes[:1, 4:], {"t": np.array([2.0])} if where in ("quads", "both") else {})
    mesh = mesh.replace(cells=(quads,), hex_data={"u": np.arange(8.0)} if where in ("hexes", "both") else {})
    io.write(tmp_path / "a.exo", mesh)
    with netcdf_file(tmp_path / "a.exo", mmap=False) as file:
        assert file.variables["time_whole"].shape == ((1,) if where != "neither" else (0,))
    assert list(io.read(tmp_path / "a.exo").hex_data) == (["u"] if where in ("hexes", "both") else [])
