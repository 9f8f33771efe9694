"""Samples that are further than a limit from a surface, by points that were near them before."""

import numpy as np

from hexmend.boundary.closest_point import ClosestPointTrees
from hexmend.boundary.near_points import NearPoints

#: Nodes of a plane at z = 0 in nine squares, each of two triangles.
PLANE = np.array([[x, y, 0.0] for x in (-9, -3, 3, 9) for y in (-9, -3, 3, 9)])
TRIANGLES = np.array(
    [[4 * i + j, 4 * i + j + 1, 4 * i + j + 5] for i in range(3) for j in range(3)]
    + [[4 * i + j, 4 * i + j + 5, 4 * i + j + 4] for i in range(3) for j in range(3)],
    dtype=np.int32,
)


def plane(points=PLANE):
    return ClosestPointTrees(points, TRIANGLES, np.zeros(len(TRIANGLES), dtype=np.int64))


def places(rng, count):
    """Make points above and below the plane, whose distance from it is that of their height."""
    return rng.uniform([-8, -8, -2], [8, 8, 2], (count, 3))


def test_the_mean_of_four_points_is_beyond_its_limit_by_its_height_whatever_was_near_before():
    rng, trees, near = np.random.default_rng(7), plane(), NearPoints(np.zeros(3000, np.int32))
    samples = rng.integers(0, 500, (3000, 4)).astype(np.int32)
    limits = rng.uniform(0.1, 1.0, 3000)
    for _ in range(4):
        points = places(rng, 500)
        examined = rng.random(3000) < 0.7
        height = np.abs(points[samples].mean(axis=1)[:, 2])
        beyond = near.means_beyond(trees, points, samples, examined, limits)
        np.testing.assert_array_equal(beyond, examined & (height > limits))
        assert 0 < beyond.sum() < examined.sum()


def test_samples_are_beyond_a_plane_that_has_moved_by_their_distance_from_where_it_is_now():
    rng, trees, near = np.random.default_rng(9), plane(), NearPoints(np.zeros(2000, np.int32))
    x, limits = places(rng, 2000), rng.uniform(0.1, 1.0, 2000)
    for height in 0.0, 0.3, -0.2, 0.0:
        examined = rng.random(2000) < 0.6
        beyond = near.beyond_moving(trees, PLANE + [0, 0, height], x, examined, limits)
        np.testing.assert_array_equal(beyond, np.flatnonzero(examined & (np.abs(x[:, 2] - height) > limits)))
        assert 0 < beyond.size < examined.sum()
