"""Nodes at which the boundary leaves no space for the hexes of a layer."""

import numpy as np
import pytest
from scipy.optimize import linprog

from hexmend.locking.visibility import inward_direction


@pytest.mark.parametrize("seed", range(60))
def test_a_direction_below_all_faces_is_found_where_there_is_one(seed):
    random = np.random.default_rng(seed)
    normals = random.normal(size=(random.integers(1, 8), 3)) + [0, 0, 0.7]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    below = np.column_stack([normals, np.ones(len(normals))])
    found = linprog([0, 0, 0, -1], A_ub=below, b_ub=np.zeros(len(normals)), bounds=[(-1, 1)] * 3 + [(None, 1)])
    direction, sine = inward_direction(normals)
    assert (sine > 1e-6) == (-found.fun > 1e-6)
    assert (normals @ direction).max() == pytest.approx(-sine)


def test_faces_without_area_leave_no_space():
    assert inward_direction(np.zeros((1, 3)))[1] <= 0
    assert inward_direction(np.array([[0, 0, 1.0], [0, 0, -1.0]]))[1] <= 0
    assert inward_direction(np.array([[0, 0, 1.0], [0, 0, 1.0]]))[1] == 1
