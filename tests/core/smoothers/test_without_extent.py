"""A mesh all of whose nodes are in one place: no method has anything to go by, and none fails."""

import numpy as np
import pytest

from hexmend import METHODS, StoppingCriteria, smooth
from tests.core.grids import grid


@pytest.mark.parametrize("place", [0.0, 3.0])
@pytest.mark.parametrize("name", METHODS)
def test_every_method_ends_on_a_mesh_without_extent(name, place):
    mesh = grid(2)
    mesh = mesh.with_points(np.full_like(mesh.points, place))
    assert mesh.mean_edge_length == 0
    result = smooth(mesh, name, StoppingCriteria(max_iterations=3))
    assert result.after.inverted == 8
    assert np.isfinite(result.mesh.points).all()
    np.testing.assert_array_equal(result.mesh.points[mesh.fixed], mesh.points[mesh.fixed])
