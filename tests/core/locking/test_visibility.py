"""Nodes at which the boundary leaves no space for the hexes of a layer."""

import numpy as np
import pytest
from scipy.optimize import linprog

from hexmend.locking.visibility import _sees_inside


@pytest.mark.parametrize("seed", range(60))
def test_a_direction_below_all_faces_is_found_where_there_is_one(seed):
    random = np.random.default_rng(seed)
    normals = random.normal(size=(random.integers(1, 8), 3)) + [0, 0, 0.7]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    below = np.column_stack([normals, np.ones(len(normals))])
    found = linprog([0, 0, 0, -1], A_ub=below, b_ub=np.zeros(len(normals)), bounds=[(-1, 1)] * 3 + [(None, 1)])
    assert _sees_inside(normals) == (-found.fun > 1e-5)


def test_faces_without_area_leave_no_space():
    assert not _sees_inside(np.zeros((1, 3)))
    assert not _sees_inside(np.array([[0, 0, 1.0], [0, 0, -1.0]]))
    assert _sees_inside(np.array([[0, 0, 1.0], [0, 0, 1.0]]))
