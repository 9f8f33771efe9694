"""Closest points of moving points: the pieces that are kept of each find exactly what a search of the whole tree does."""

from concurrent.futures import ThreadPoolExecutor
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchmarks.mend.surfaces import refined
from hexmend import Mesh, MeshError, kernels
from hexmend.boundary import ClosestPointTrees, PartitionedSurface, boundary_of
from hexmend.boundary.closest_point import ClosestPointCache
from tests.core.boundary.solids import ball, cylinder
from tests.core.curved_shell import curved_shell
from tests.core.grids import grid


def fine_triangles(mesh, count=3000):
    """The mesh's boundary as a surface file has it: a group of at least so many triangles."""
    points, triangles = refined(mesh.points, mesh.topology.boundary_faces, count)
    return ClosestPointTrees(points, triangles, np.zeros(len(triangles), np.int64))


def curves_and_patches(mesh):
    return PartitionedSurface(mesh.points, boundary_of(mesh)).trees


def concave():
    """A box with a notch: the closest point jumps from one of its walls to the other in the middle."""
    mesh = grid(4)
    middle = mesh.points[mesh.hexes].mean(axis=1)
    return Mesh(mesh.points, mesh.hexes[~((np.abs(middle[:, 0] - 2) < 1) & (middle[:, 2] > 1))])


def fan():
    """Triangles and a segment around one point, with some that are lines and points, and some more than once."""
    angle = np.linspace(0, 2 * np.pi, 13)[:-1]
    points = np.column_stack([np.cos(angle), np.sin(angle), 0.1 * np.cos(3 * angle)])
    points = np.concatenate([points, np.zeros((1, 3))])
    ring = np.arange(12)
    pieces = np.stack([ring, np.roll(ring, -1), np.full(12, 12)], axis=1)
    more = [[0, 0, 0], [1, 12, 12], [2, 12, 2], [12, 12, 3], [4, 5, 12], [4, 5, 12], [0, 6, 6]]
    return ClosestPointTrees(points, np.concatenate([pieces, more]), np.zeros(12 + len(more), np.int64))


_MADE = {
    "smooth": lambda: fine_triangles(ball(5)),
    "creases": lambda: fine_triangles(cylinder(16, 3)),
    "concave": lambda: fine_triangles(concave()),
    "thin": lambda: fine_triangles(curved_shell(around=6, along=3, outer=1.02)),
    "curves and patches": lambda: curves_and_patches(cylinder(16, 3)),
    "coarse": lambda: curves_and_patches(grid(1)),
    "fan": fan,
}


SURFACES = tuple(_MADE)


@cache
def made(name):
    return _MADE[name]()


def assert_same(trees, kept_pieces, x, group, slots=None):
    """What the cache finds is what a search finds, to the last bit, also at equal distances and at distance 0."""
    kept, searched = kept_pieces.closest(x, slots), trees.closest(x, group)
    for field in ("points", "pieces", "weights"):
        np.testing.assert_array_equal(getattr(kept, field), getattr(searched, field))
    corners = trees.points[trees.pieces[kept.pieces]]
    np.testing.assert_allclose(np.einsum("ki,kij->kj", kept.weights, corners), kept.points, atol=1e-12)


@pytest.mark.parametrize("name", SURFACES)
@given(seed=st.integers(0, 2**31), step=st.floats(-5, 0), drift=st.floats(-3, 0))
def test_points_that_move_at_random_find_what_a_search_finds(name, seed, step, drift):
    trees, random = made(name), np.random.default_rng(seed)
    group = random.integers(0, len(trees.roots), 40)
    size = np.ptp(trees.points, axis=0).max()
    x = trees.points[random.integers(0, len(trees.points), 40)]
    drift, kept = size * 10**drift * random.normal(size=x.shape), ClosestPointCache(trees, group)
    for move in range(12):
        if move % 5 == 0:  # onto the surface: at distance 0, on edges and at vertices
            x = trees.closest(x, group).points
        x = x + drift / 12 + size * 10**step * random.normal(size=x.shape)
        x[move % 40] += size * random.normal(size=3)
        assert_same(trees, kept, x, group)


@pytest.mark.parametrize("name", SURFACES)
def test_places_at_equal_distances_of_several_pieces(name):
    # Vertices, midpoints of edges, and what is above them and at the centre of all.
    trees = made(name)
    corners = trees.points[trees.pieces]
    places = np.concatenate([corners[:, 0], corners[:, :2].mean(axis=1), np.tile(trees.points.mean(axis=0), (9, 1))])
    places = places[np.linspace(0, len(places) - 1, 60).astype(int)]
    group = np.arange(60) % len(trees.roots)
    kept, middle = ClosestPointCache(trees, group), trees.points.mean(axis=0)
    for scale in (1.0, 1.0, 1.001, 0.999, 0.5, 1.5, 0.0, 0.0, 1.0):
        assert_same(trees, kept, middle + scale * (places - middle), group)


def test_threads_share_a_cache():
    trees, random = made("creases"), np.random.default_rng(3)
    group, slots = np.zeros(3, np.int64), np.tile(np.arange(3, dtype=np.int32), 2000)
    kept = ClosestPointCache(trees, group)
    x = random.normal(size=(3, 3))[slots] + 0.05 * random.normal(size=(len(slots), 3))

    def query(count):
        kernels.set_threads(count)
        for _ in range(5):
            assert_same(trees, kept, x, group[slots], slots)

    with ThreadPoolExecutor(3) as pool:
        list(pool.map(query, (1, 2, 3)))


def test_a_place_that_is_nowhere_is_refused_and_the_next_is_found():
    trees, group = made("coarse"), np.zeros(2, np.int64)
    kept, x = ClosestPointCache(trees, group), np.array([[0.2, 0.3, 0.4], [0.5, 0.1, 0.2]])
    for _ in range(3):
        assert_same(trees, kept, x, group)
        for wrong in (np.nan, np.inf, 1e200):
            with pytest.raises(MeshError, match="nothing is closest to the point"):
                kept.closest(np.array([x[0], [wrong, 0, 0]]))
    with pytest.raises(MeshError, match="there are 1 places: expected one for each of 2 slots"):
        kept.closest(x[:1])
    assert len(ClosestPointCache(trees, group[:0]).closest(x[:0]).pieces) == 0
