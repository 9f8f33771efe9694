"""Directions in which nodes of curves and patches may move: at right angles to the normal, along the tangent."""

import numpy as np
import pytest

from hexmend.boundary import NodeClass, SlidingBoundary
from hexmend.gallery import make


@pytest.fixture(scope="module", params=["five-side", "bridge-sharp"])
def sliding(request):
    return SlidingBoundary(make(request.param))


def places(sliding, seed):
    """Places on the surface of all sliding nodes: a third of them as they were, on vertices of the surface."""
    random = np.random.default_rng(seed)
    x = sliding.points[sliding.nodes]
    shift = 0.3 * sliding.mesh.mean_edge_length * random.normal(size=x.shape)
    return sliding.project(x + shift * (random.uniform(size=len(x)) < 0.67)[:, None])


def expected_basis(direction, of_curve):
    """One node's directions, by the formula: the first is at right angles to the axis most across the normal."""
    if of_curve:
        return np.column_stack([direction, np.zeros((3, 2))])
    first = np.cross(direction, np.eye(3)[np.abs(direction).argmin()])
    first /= np.linalg.norm(first)
    return np.column_stack([first, np.cross(direction, first), np.zeros(3)])


@pytest.mark.slow
def test_directions_are_those_of_the_normals_and_tangents(sliding):
    x, of_curve = places(sliding, 0), sliding.node_class[sliding.nodes] == NodeClass.CURVE
    found = sliding.surface.trees.closest(x, sliding.surface.group_of(sliding.nodes))
    flat, smooth = (sliding.surface.directions(found, smooth=smooth) for smooth in (False, True))
    used = np.where(of_curve[:, None], found.weights[:, :2].min(axis=1)[:, None], found.weights.min(axis=1)[:, None])
    inside = used > 1e-3
    assert inside.any()
    assert not inside.all()
    bases = sliding.tangent_bases(x)
    for row, direction in enumerate(np.where(inside, flat, smooth)):
        np.testing.assert_allclose(bases[row], expected_basis(direction, of_curve[row]), atol=1e-12)
    gram = bases.transpose(0, 2, 1) @ bases
    assert of_curve.any()
    np.testing.assert_allclose(gram[of_curve], np.broadcast_to(np.diag([1.0, 0, 0]), gram[of_curve].shape), atol=1e-12)
    np.testing.assert_allclose(
        gram[~of_curve], np.broadcast_to(np.diag([1.0, 1, 0]), gram[~of_curve].shape), atol=1e-12
    )
    some = np.arange(0, len(x), 3)
    np.testing.assert_array_equal(sliding.tangent_bases(x[some], sliding.nodes[some]), bases[some])
