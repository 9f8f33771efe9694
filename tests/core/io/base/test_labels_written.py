"""Labels and types in the forms that callers may give them."""

import numpy as np
import pytest

from hexmend import io
from tests.core.grids import grid

WORDS = ["inlet", "", "Ωall & <more>"]


@pytest.mark.parametrize("form", [list, tuple, np.array])
def test_texts_are_written_to_vtu_whatever_holds_them(form, tmp_path):
    mesh = grid(2).replace(field_data={"words": form(WORDS), "one": form(WORDS[2:])})
    io.write(tmp_path / "a.vtu", mesh)
    back = io.read(tmp_path / "a.vtu").field_data
    assert list(np.atleast_1d(back["words"])) == WORDS
    assert list(np.atleast_1d(back["one"])) == WORDS[2:]


@pytest.mark.parametrize("values", [np.full(8, 0.5), np.arange(16).reshape(8, 2), np.full(8, 99), np.full(8, -3)])
def test_numbers_that_name_no_type_of_abaqus_give_the_usual_one(values, tmp_path):
    io.write(tmp_path / "a.inp", grid(2))
    usual = [line for line in (tmp_path / "a.inp").read_text().splitlines() if line.startswith("*ELEMENT,")]
    io.write(tmp_path / "b.inp", grid(2).replace(hex_data={"abaqus:type": values}))
    assert [line for line in (tmp_path / "b.inp").read_text().splitlines() if line.startswith("*ELEMENT,")] == usual
