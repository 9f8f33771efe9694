"""Where a sliding boundary and its surface are tracker, as nodes move step by step."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from hexmend.boundary import SlidingBoundary
from hexmend.optimise.maxmin.deviation import DeviationTracker
from tests.core.boundary.solids import ball, slid

seeds = st.integers(0, 2**32 - 1)


def wandering(mesh, nodes, seed, steps=4):
    """Points of a mesh, a few of some nodes being moved at a time, and which these are."""
    random, points = np.random.default_rng(seed), mesh.points
    for _ in range(steps):
        moved = random.choice(nodes, 4, replace=False)
        points = points.copy()
        points[moved] += random.normal(size=(4, 3)) * 0.2 * mesh.mean_edge_length
        yield points, moved


@given(seeds)
def test_followed_distances_bound_those_that_are_looked_up_anew(seed):
    mesh = slid(ball(3), 0.2, seed)
    sliding = SlidingBoundary(mesh)
    tracker = DeviationTracker(sliding, mesh.points)
    assert tracker.distances.max() < 1e-9 * mesh.mean_edge_length
    for step, (points, moved) in enumerate(wandering(mesh, sliding.nodes, seed)):
        tracker = tracker.after_move(points, moved)
        anew = DeviationTracker(sliding, points)
        assert (tracker.distances >= anew.distances - 1e-12).all()
        if not step:  # what is closest to a place at first is that place
            went = np.isin(sliding.samples, moved).any(axis=1)
            np.testing.assert_allclose(tracker.distances[went], anew.distances[went], atol=1e-12)


@given(seeds, st.floats(0.01, 0.3))
def test_a_boundary_leaves_its_room_where_something_is_further_than_before(seed, share):
    mesh = slid(ball(3), 0.2, seed)
    sliding, room = SlidingBoundary(mesh), share * mesh.mean_edge_length
    before = DeviationTracker(sliding, mesh.points)
    assert not before.after_move(mesh.points, sliding.nodes).exceeds(before, sliding.nodes, room)
    for points, moved in wandering(mesh, sliding.nodes, seed):
        after = before.after_move(points, moved)
        furthest = max(off.distances.max(initial=0.0) for off in both_ways(sliding, points))
        was = max(off.distances.max(initial=0.0) for off in both_ways(sliding, before.points))
        if was <= room:
            assert after.exceeds(before, moved, room) == (furthest > room)
        before = after


def both_ways(sliding, points):
    return sliding.boundary_deviation(points, np.arange(len(sliding.samples))), sliding.surface_deviation(points)
