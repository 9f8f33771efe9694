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
