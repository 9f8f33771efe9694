"""Distances of boundaries against brute force and known values."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from benchmarks.mend.surfaces import refined
from hexmend import Cells, Mesh, MeshError, kernels
from hexmend.boundary import (
    ClosestPointTrees,
    PartitionedSurface,
    SkinSurface,
    boundary_of,
    mutual_distances,
    surface_change,
)
from hexmend.boundary.closest_point import ClosestPointCache
from tests.core.boundary.solids import ball, cylinder, wavy
from tests.core.boundary.test_surface import brute
from tests.core.curved_shell import curved_shell
from tests.core.grids import grid


def skin(mesh):
    return SkinSurface(mesh.points, mesh.topology.boundary_faces)


@settings(max_examples=5)
@given(st.integers(0, 999), st.floats(0, 0.4))
def test_distances_are_those_of_brute_force(seed, height):
    before = grid(1)
    after = wavy(before, height, seed)
    old, new = skin(before), skin(after)
    for one, other, found in zip((old, new), (new, old), mutual_distances(old, new), strict=True):
        quads = other.points[other.faces]
        pieces = [[a, b, quad.mean(axis=0)] for quad in quads for a, b in zip(quad, np.roll(quad, -1, 0), strict=True)]
        samples = one.samples()
        assert len(samples) == 8 + 12 + 6
        expected = [min(np.linalg.norm(brute(piece, x) - x) for piece in pieces) for x in samples]
        np.testing.assert_allclose(found, expected, atol=1e-12)


def test_nothing_has_changed_where_nothing_moved():
    mesh = wavy(grid(4), 0.2)
    change = surface_change(mesh, mesh)
    assert change.max < 1e-14
    assert change.moved == 0
    assert change.volume_change == 0
    assert change.features == change.features_kept > 0
    inside = surface_change(mesh, mesh.with_points(mesh.points + 0.1 * mesh.free[:, None]))
    assert inside.to_dict() == change.to_dict()
    edges = f"; {change.features} of {change.features} sharp edges are kept."
    assert change.sentence == f"The boundary could slide, but none of its nodes moved: it has kept its shape{edges}"
    smooth = replace(change, features=0, moved=3, max_distance=1e-15, volume_change=-1e-16)
    assert smooth.sentence == "The boundary slid: 3 of its nodes moved; it has kept its shape."
    assert replace(smooth, reference="new.stl").sentence.endswith("moved; it is on new.stl.")
    assert replace(smooth, volume_change=-0.01).sentence.endswith("; its volume changed by -1 %.")
    assert replace(smooth, volume_change=1.0).sentence.endswith("; its volume changed by +100 %.")


@given(st.floats(0.01, 0.4))
def test_a_box_that_is_shifted_along_an_axis_is_as_far_away(shift):
    mesh = grid(3)
    change = surface_change(mesh, mesh.with_points(mesh.points + [shift, 0, 0]))
    assert change.max_distance == pytest.approx(shift, rel=1e-12)
    assert 0 < change.mean_distance < shift
    assert change.max == pytest.approx(shift / mesh.mean_edge_length)
    assert change.max_percent_of_diagonal == pytest.approx(100 * shift / np.sqrt(27))
    assert change.volume_change == pytest.approx(0, abs=1e-12)
    assert change.moved == 56


def test_features_that_are_gone_are_not_counted_as_kept():
    mesh = cylinder(32, 5)
    change = surface_change(mesh, mesh.with_points(mesh.points * [1, 1, 0.4] + [0, 0, 1]))
    assert change.features == change.features_kept == 64
    dome = mesh.points.copy()
    radius = np.linalg.norm(dome[:, :2], axis=1)
    dome[:, 2] *= np.sqrt(np.maximum(1 - radius**2, 0)) * 0.9 + 0.1
    gone = surface_change(mesh, mesh.with_points(dome))
    assert 32 <= gone.features_kept < gone.features == 64


@pytest.mark.parametrize("name", ["block", "cap", "hanger_stresstest"])
def test_published_pairs_are_as_far_apart_as_published(name, real_mesh):
    from hexmend.io import read

    published = {"block": 0.41, "cap": 1.06, "hanger_stresstest": 0.24}
    change = surface_change(*(read(real_mesh(f"{name}_{which}.mesh")) for which in ("in", "out")))
    assert change.max_percent_of_diagonal == pytest.approx(published[name], rel=0.08)


def test_different_meshes_are_refused():
    with pytest.raises(MeshError, match="8 and 27 hexes"):
        surface_change(grid(2), grid(3))


def test_a_ridge_that_a_file_marks_on_a_flat_face_is_no_feature_that_could_be_lost():
    mesh = grid(3)
    flat = np.flatnonzero((mesh.points[:, 2] == 3) & (mesh.points[:, 1] == 1))
    line = Cells("line", np.stack([flat[:-1], flat[1:]], axis=1), {"medit:ridge": np.ones(3, np.int64)})
    marked = mesh.replace(cells=(line,))
    assert len(boundary_of(marked).segments) == len(boundary_of(mesh).segments) + 3
    assert surface_change(marked, marked).features == surface_change(mesh, mesh).features == 36


def test_an_edge_at_the_very_angle_is_no_feature_though_a_file_marks_it():
    mesh = grid(3)
    edge = np.flatnonzero((mesh.points[:, 2] == 3) & (mesh.points[:, 1] == 0))
    line = Cells("line", np.stack([edge[:-1], edge[1:]], axis=1), {"medit:ridge": np.ones(3, np.int64)})
    marked = mesh.replace(cells=(line,))
    assert len(boundary_of(marked, 90.0).segments) == 3
    assert surface_change(marked, marked, 90.0).features == 0
    assert surface_change(marked, marked, 89.999).features == 36


# Closest points of moving points: the pieces that are kept of each find exactly what a search of the whole tree does.


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
