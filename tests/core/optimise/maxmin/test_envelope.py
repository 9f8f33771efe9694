"""A boundary stays in the envelope of its surface, but for nodes that are lifted."""

import numpy as np
import pytest

from hexmend.boundary import SlidingBoundary
from hexmend.optimise.maxmin.envelope import Envelope
from tests.core.boundary.solids import ball, slid


@pytest.fixture
def sliding():
    return SlidingBoundary(slid(ball(3), 0.2, 1))


def pushed(sliding, nodes, share):
    """Points with some nodes pushed out by a share of the mean edge length."""
    points = sliding.mesh.points.copy()
    points[nodes] *= 1 + share * sliding.mesh.mean_edge_length / np.linalg.norm(points[nodes], axis=1, keepdims=True)
    return points


def test_sliding_nodes_are_put_back_and_lifted_ones_are_not(sliding):
    envelope, nodes = Envelope(sliding.mesh.n_nodes, sliding), sliding.nodes
    lifted = nodes[:1]
    envelope.release(lifted)
    assert (envelope.slides(nodes) == ~np.isin(nodes, lifted)).all()
    outside = pushed(sliding, nodes, 0.05)
    points = envelope.project(sliding.mesh.points, outside.copy(), nodes)
    np.testing.assert_array_equal(points[lifted], outside[lifted])
    others = nodes[1:]
    np.testing.assert_allclose(sliding.project(points[others], others), points[others], atol=1e-9)
    assert sliding.flipped_quads(sliding.mesh.points, points).size == 0


def test_the_boundary_leaves_its_room_where_it_is_further_than_that(sliding):
    mesh, node = sliding.mesh, sliding.nodes[:1]
    envelope, edge = Envelope(mesh.n_nodes, sliding), mesh.mean_edge_length
    points = pushed(sliding, node, 0.3)
    assert not envelope.leaves_band(mesh.points, points, node)  # where there is no end of room
    far = envelope.largest_deviation(points)
    assert 0.2 * edge < far <= 0.3 * edge * (1 + 1e-9)
    envelope.limit_to(0.99 * far)
    assert envelope.leaves_band(mesh.points, points, node)
    assert node[0] in envelope.nodes_outside_band(points)
    envelope.limit_to(1.01 * far)
    assert not envelope.leaves_band(mesh.points, points, node)
    assert envelope.nodes_outside_band(points).size == 0


def test_what_is_followed_bounds_as_what_is_looked_at_anew(sliding):
    mesh, node = sliding.mesh, sliding.nodes[:1]
    followed, anew = (Envelope(mesh.n_nodes, sliding) for _ in range(2))
    for envelope in (followed, anew):
        envelope.limit_to(0.2 * mesh.mean_edge_length)
    points, moves = pushed(sliding, node, 0.1), np.zeros(mesh.n_nodes)
    moves[sliding.nodes] = 0.2 * mesh.mean_edge_length
    followed.track(mesh.points, points, node)
    one, other = (envelope.bounds(points, moves) for envelope in (followed, anew))
    assert one.slack.size
    assert (one.has_gain == 0).all()
    assert one.slack.min() == pytest.approx(other.slack.min())


@pytest.mark.parametrize("share", [0.05, 0.3])
def test_the_largest_deviation_is_exact_where_it_exceeds_a_limit_and_else_0(sliding, share):
    envelope, points = Envelope(sliding.mesh.n_nodes, sliding), pushed(sliding, sliding.nodes[:2], share)
    exact = envelope.largest_deviation(points)
    assert exact > 0
    for above in (1e-9 * exact, 0.5 * exact, 0.999 * exact):
        assert envelope.largest_deviation(points, above) == pytest.approx(exact, rel=1e-12)
    for above in (1.001 * exact, 10 * exact):
        assert envelope.largest_deviation(points, above) == 0
