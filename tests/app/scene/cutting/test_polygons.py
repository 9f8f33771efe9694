"""Clipping of polygons by planes, checked by areas."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from hexmend_app.scene.cutting.polygons import Polygons

HEXAGON = np.array([[np.cos(t), np.sin(t), 0] for t in np.arange(6) * np.pi / 3])


def polygons(shift):
    """Return a triangle, a square and a hexagon, each shifted in its plane."""
    parts = [HEXAGON[::2], HEXAGON[[0, 1, 3, 4]], HEXAGON]
    points = np.concatenate([part + [*move, 0] for part, move in zip(parts, shift, strict=True)])
    return Polygons(points, np.array([0, 3, 7, 13]), np.arange(13), np.array([7, 3, 5]))


def areas(of):
    """Return the area of each polygon by its owner."""
    area_of = {}
    for i, owner in enumerate(of.owner):
        x, y, _ = of.points[of.places[of.start[i] : of.start[i + 1]]].T
        area_of[int(owner)] = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
    return area_of


@given(st.integers(0, 2**32 - 1), st.integers(1, 3))
def test_parts_in_front_of_and_beyond_planes_add_up_to_the_whole(seed, planes):
    random = np.random.default_rng(seed)
    whole = polygons(random.uniform(-1, 1, (3, 2)))
    normals, offsets = random.normal(size=(planes, 3)), random.uniform(-1, 1, planes)
    sums = dict.fromkeys((7, 3, 5), 0.0)
    for k in range(planes):  # before the first k planes, and beyond the next
        sign = np.where(np.arange(k + 1) == k, -1.0, 1.0)
        for owner, area in areas(whole.before(normals[: k + 1] * sign[:, None], offsets[: k + 1] * sign)).items():
            sums[owner] += area
    left = whole.before(normals, offsets)
    for owner, area in areas(left).items():
        assert area >= -1e-14
        sums[owner] += area
    expected = areas(whole)
    np.testing.assert_allclose([sums[k] for k in expected], list(expected.values()), atol=1e-12)
    assert (left.points @ normals.T <= offsets + 1e-12).all()
    assert left.start[0] == 0
    assert left.start[-1] == len(left.points) == len(left.places)


def test_a_plane_through_corners_leaves_the_part_in_front():
    square = Polygons(
        np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]]), np.array([0, 4]), np.arange(4), np.array([2])
    )
    half = square.before(np.array([[1.0, -1, 0]]), np.zeros(1))
    assert areas(half) == {2: 0.5}
    assert {tuple(point) for point in half.points} == {(0, 0, 0), (1, 1, 0), (0, 1, 0)}
    outside = square.before(np.array([[1.0, 0, 0]]), np.array([-2.0]))
    assert len(outside) == len(outside.points) == 0
    assert outside.start.tolist() == [0]
