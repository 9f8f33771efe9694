"""Nodes at which the boundary leaves no space for the hexes of a layer."""

import tracemalloc

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


def test_memory_for_a_node_of_many_faces_does_not_grow_with_their_triples():
    angle = np.linspace(0, 2 * np.pi, 120, endpoint=False)
    shares = np.where(np.arange(120) % 2, np.random.default_rng(0).random(120), 1.0)
    normals = np.column_stack([shares * np.cos(angle), shares * np.sin(angle), np.full(120, 0.5)])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    tracemalloc.start()
    direction, sine = inward_direction(normals)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    np.testing.assert_allclose(direction, [0, 0, -1], atol=1e-12)
    assert sine == pytest.approx(0.5 / np.hypot(1, 0.5))
    assert peak < 1e7  # 280,840 triples of normals take 200 MB


def test_faces_without_area_leave_no_space():
    assert inward_direction(np.zeros((1, 3)))[1] <= 0
    assert inward_direction(np.array([[0, 0, 1.0], [0, 0, -1.0]]))[1] <= 0
    assert inward_direction(np.array([[0, 0, 1.0], [0, 0, 1.0]]))[1] == 1
