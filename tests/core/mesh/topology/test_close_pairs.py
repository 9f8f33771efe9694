"""Pairs of points at one position, against all distances and against a tree."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from hexmend.mesh.topology.close_pairs import close_pairs


def as_set(pairs):
    return {tuple(pair) for pair in pairs.tolist()}


@pytest.mark.parametrize(("seed", "scale"), [(0, 1e-3), (1, 1.0), (2, 1e6)])
def test_pairs_are_those_of_a_tree(seed, scale):
    rng = np.random.default_rng(seed)
    lattice = np.stack(np.meshgrid(*3 * [np.arange(8.0)], indexing="ij"), axis=-1).reshape(-1, 3)
    near = lattice[rng.permutation(len(lattice))[:40]] + rng.uniform(-1, 1, (40, 3)) * 1e-6
    points = scale * np.concatenate([lattice, near, near[:5]])
    found = close_pairs(points, scale * 1e-6)
    assert as_set(found) == as_set(cKDTree(points).query_pairs(scale * 1e-6, output_type="ndarray"))
    assert len(found) > 5


@pytest.mark.parametrize("count", [0, 1, 2, 100])
def test_points_that_are_all_at_one_position_are_all_pairs(count):
    assert len(as_set(close_pairs(np.ones((count, 3)), 0.0))) == count * (count - 1) // 2


def test_points_beside_each_other_along_a_plane_are_no_pairs():
    rng = np.random.default_rng(0)
    assert close_pairs(rng.uniform(size=(10_000, 3)), 1e-9).shape == (0, 2)
