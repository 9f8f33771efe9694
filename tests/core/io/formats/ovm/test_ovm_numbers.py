"""Whole numbers up to the greatest of 64 bits with a sign are kept by OpenVolumeMesh; greater ones are said to be lost."""

import numpy as np
import pytest

from hexmend import io
from tests.core.grids import grid

MOST = 2**63 - 1


@pytest.mark.parametrize("most", [2**31 - 1, 2**31, MOST])
def test_whole_numbers_are_kept_up_to_the_greatest(most, tmp_path):
    values = np.array([0, 1, 2, 3, 4, 5, 6, most], np.uint64)
    mesh = grid(2).replace(hex_data={"key": values})
    assert io.unsupported_data(tmp_path / "a.ovm", mesh) == []
    io.write(tmp_path / "a.ovm", mesh)
    assert io.read(tmp_path / "a.ovm").hex_data["key"].tolist() == values.tolist()


@pytest.mark.parametrize("least", [0, MOST + 1])
def test_a_greater_one_is_said_to_be_lost(least, tmp_path):
    values = np.array([least] * 7 + [MOST + 1], np.uint64)
    assert io.unsupported_data(tmp_path / "a.ovm", grid(2).replace(hex_data={"key": values})) != []


@pytest.mark.parametrize("least", [-(2**31), -(2**31) - 1, -(2**63)])
def test_whole_numbers_are_kept_down_to_the_least(least, tmp_path):
    values = np.array([least, 0, 0, 0, 0, 0, 0, 5], np.int64)
    io.write(tmp_path / "a.ovm", grid(2).replace(hex_data={"key": values}))
    kind = "int" if least >= -(2**31) else "long"
    assert f'CProp {kind} "key"' in (tmp_path / "a.ovm").read_text()
    assert io.read(tmp_path / "a.ovm").hex_data["key"].tolist() == values.tolist()
