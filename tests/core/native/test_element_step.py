"""GETMe's element step of a block of hexes against that of one hex."""

import numpy as np
import pytest

from hexmend.kernels import LANES
from hexmend.kernels.element_step import element_steps
from tests.core.grids import grid, scrambled
from tests.core.native.extension import extension

kernels = extension()


@pytest.mark.parametrize("count", [1, LANES - 1, LANES + 1, 300])
def test_a_block_of_hexes_takes_the_steps_of_each(count):
    mesh = scrambled(grid(7), 0.6, count)
    hexes = mesh.hexes[:count]
    places = np.full((count, 8, 3), np.nan)
    element_steps(mesh.points, hexes, 1.5, 0.6, places)
    for h in range(count):
        np.testing.assert_allclose(
            places[h], kernels.element_step.element_step(mesh.points[hexes[h]], 1.5, 0.6), atol=1e-12
        )
