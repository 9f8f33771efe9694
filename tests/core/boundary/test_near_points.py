"""Samples that are further than a limit from a surface, by points that were near them before."""

import numpy as np

from hexmend.boundary.closest_point import ClosestPointTrees
from hexmend.boundary.near_points import NearPoints
from hexmend.kernels import closest_point

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


def test_a_sample_that_was_nowhere_is_near_nothing_at_the_origin():
    trees, near = plane(PLANE + [0, 0, 5]), NearPoints(np.zeros(1, np.int32))
    samples, every, limit = np.zeros((1, 4), dtype=np.int32), np.ones(1, dtype=bool), np.ones(1)
    for x in [0, 0, 5.0], [np.nan, 0, 0], [0, 0, 0]:
        beyond = near.means_beyond(trees, np.array([x], dtype=float), samples, every, limit)
        assert beyond.tolist() == [x != [0, 0, 5.0]]


def test_samples_are_beyond_a_plane_that_has_moved_by_their_distance_from_where_it_is_now():
    rng, trees, near = np.random.default_rng(9), plane(), NearPoints(np.zeros(2000, np.int32))
    x, limits = places(rng, 2000), rng.uniform(0.1, 1.0, 2000)
    for height in 0.0, 0.3, -0.2, 0.0:
        examined = rng.random(2000) < 0.6
        beyond = near.beyond_moving(trees, PLANE + [0, 0, height], x, examined, limits)
        np.testing.assert_array_equal(beyond, np.flatnonzero(examined & (np.abs(x[:, 2] - height) > limits)))
        assert 0 < beyond.size < examined.sum()


def test_each_sample_is_compared_with_the_tree_of_its_root():
    both = np.concatenate([PLANE, PLANE + [0, 0, 1]])
    triangles = np.concatenate([TRIANGLES, TRIANGLES + len(PLANE)])
    trees = ClosestPointTrees(both, triangles, np.repeat([0, 1], len(TRIANGLES)))
    x = np.array([[0, 0, 0.1], [0, 0, 0.1], [1, 2, 1.1], [1, 2, 1.1]])
    near = NearPoints(trees.roots[[0, 1, 0, 1]])
    every, limits, expected = np.ones(4, bool), np.full(4, 0.5), [False, True, True, False]
    samples = np.repeat(np.arange(4, dtype=np.int32), 4).reshape(-1, 4)
    for _ in range(2):  # as found at first, and as known then
        assert near.means_beyond(trees, x, samples, every, limits).tolist() == expected
        assert near.beyond(trees, trees.points, x, limits).tolist() == expected
        np.testing.assert_array_equal(near.beyond_moving(trees, both, x, every, limits), [1, 2])
        assert near.beyond_moving(trees, both - [0, 0, 1], x, every, limits).tolist() == [0, 2, 3]


def test_samples_are_marked_that_were_before_or_move_with_a_node():
    rng, n = np.random.default_rng(10), 400
    earlier, samples = rng.normal(size=(n, 3)), rng.integers(0, n, (900, 4)).astype(np.int32)
    faces, face_of_piece = rng.integers(0, n, (80, 4)).astype(np.int32), rng.integers(0, 80, 200)
    pieces = rng.integers(-1, 200, 1500).astype(np.int32)
    before = rng.random(900) < 0.1, rng.random(1500) < 0.1
    points, moved = earlier.copy(), rng.random(n) < 0.1
    points[moved, rng.integers(0, 3)] += 1e-9
    found = np.empty(900, bool), np.empty(1500, bool)
    closest_point.moved_samples(points, earlier, samples, faces, face_of_piece, pieces, *before, *found)
    np.testing.assert_array_equal(found[0], before[0] | moved[samples].any(axis=1))
    of_faces = moved[faces[face_of_piece[pieces]]].any(axis=1)
    np.testing.assert_array_equal(found[1], before[1] | of_faces | (pieces < 0))
    assert 0 < found[0].sum() < 900
    assert 0 < found[1].sum() < 1500
