"""Data that are not numbers, which formats leave out and say so before."""

import numpy as np
import pytest

from hexmend import Cells, io
from tests.core.grids import grid


@pytest.mark.parametrize("suffix", [".vtk", ".vtu", ".exo", ".med"])
@pytest.mark.parametrize(
    "values",
    [np.array(["a"] * 8), np.arange(8) * 1j, np.array([None] * 8), np.arange(8).astype("M8[s]")],
    ids=["texts", "complex", "objects", "times"],
)
def test_data_that_are_no_numbers_are_left_out_as_announced(suffix, values, tmp_path):
    top = Cells("quad", np.array([[18, 19, 22, 21]]), {"odd": values[:1], "even": np.ones(1)})
    mesh = grid(2).replace(
        node_data={"odd": np.resize(values, 27), "t": np.arange(27.0)}, hex_data={"odd": values}, cells=(top,)
    )
    assert io.unsupported_data(tmp_path / f"a{suffix}", mesh) == [
        "point data that are not numbers (odd)",
        "cell data that are not numbers (odd)",
    ]
    io.write(tmp_path / f"a{suffix}", mesh)
    back = io.read(tmp_path / f"a{suffix}")
    assert "odd" not in {*back.node_data, *back.hex_data, *back.cells[0].data}
    np.testing.assert_array_equal(back.node_data["t"], np.arange(27))
    assert back.cells[0].data["even"].tolist() == [1]
