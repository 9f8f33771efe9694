"""Points of lattice cells with the largest and the least value, compared with a search cell by cell."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.boundary import cell_extremes
from hexmend.boundary.cell_extremes import extremes_in_cells


@pytest.mark.parametrize("most", [1e9, 0])
@given(st.integers(0, 2**32 - 1), st.integers(0, 200), st.floats(0.01, 3))
def test_each_cell_keeps_its_two_extremes(most, seed, count, cell):
    random = np.random.default_rng(seed)
    x, values = random.normal(size=(count, 3)), random.random(count)
    cells = {}
    for number, place in enumerate(np.floor((x - x.min(axis=0, initial=np.inf)) / cell).astype(int).tolist()):
        cells.setdefault(tuple(place), []).append(number)
    expected = {choose(own, key=values.__getitem__) for own in cells.values() for choose in (min, max)}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cell_extremes, "_MAX_CELLS", most)
        assert extremes_in_cells(x, values, cell).tolist() == sorted(expected)
