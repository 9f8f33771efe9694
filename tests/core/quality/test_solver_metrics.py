"""Time step, Jacobian ratio and mid-node offset: hand-computed values, and second-order hexes."""

import math

import numpy as np
import pytest

from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import MID_NODE_POSITIONS, jacobian_range
from hexmend.quality.corner_heights import least_heights
from hexmend.quality.validity import Validity, certify

ONE = np.arange(8)[None]


def second_order(width=20, shift=None):
    """A unit cube of 20 or 27 nodes; `shift` moves nodes, {number: vector}."""
    points = np.concatenate([UNIT_CUBE, MID_NODE_POSITIONS])[:width].copy()
    for node, vector in (shift or {}).items():
        points[node] += vector
    mid = np.full((1, 19), -1, np.int32)
    mid[0, : width - 8] = np.arange(8, width)
    return Mesh(points, ONE, mid_nodes=mid)


@pytest.mark.parametrize(
    ("x", "height"),
    [
        (UNIT_CUBE, 1.0),
        (UNIT_CUBE * [3, 2, 0.5], 0.5),
        (UNIT_CUBE @ [[1, 0, 0], [1, 1, 0], [0, 0, 1]], math.sqrt(0.5)),  # leans by 45 degrees
        (UNIT_CUBE * [-1, 1, 1], -1.0),
        (UNIT_CUBE * [1, 1, 0], 0.0),
        (UNIT_CUBE * 1e-200, 1e-200),
        (UNIT_CUBE * 1e200, 1e200),
    ],
)
def test_the_least_height_is_that_over_the_largest_face(x, height):
    assert least_heights(np.array(x, float), ONE)[0] == pytest.approx(height)


def test_the_height_of_a_parallelepiped_is_its_volume_over_its_largest_face():
    axes = np.random.default_rng(3).normal(size=(20, 3, 3))
    axes[np.linalg.det(axes) < 0, 0] *= -1
    for a in axes:
        faces = np.linalg.norm([np.cross(a[0], a[1]), np.cross(a[1], a[2]), np.cross(a[2], a[0])], axis=1)
        assert least_heights(UNIT_CUBE @ a, ONE)[0] == pytest.approx(np.linalg.det(a) / faces.max())


def test_the_jacobian_ratio_of_a_frustum_is_that_of_its_ends():
    x = UNIT_CUBE.copy()
    x[4:, :2] = x[4:, :2] / 2 + 0.25  # the upper square has half the edges
    mesh = Mesh(x, ONE)
    assert mesh.quality("jacobian-ratio")[0] == pytest.approx(4)
    flat = Mesh(UNIT_CUBE * [1, 1, 0], ONE)
    assert flat.quality("jacobian-ratio")[0] == math.inf


@pytest.mark.parametrize("width", [20, 27])
def test_straight_second_order_hexes_are_perfect(width):
    mesh = second_order(width)
    assert mesh.quality("jacobian-ratio")[0] == pytest.approx(1)
    assert mesh.quality("mid-node-offset")[0] == pytest.approx(0, abs=1e-15)
    np.testing.assert_allclose(jacobian_range(mesh.points, mesh.hexes, mesh.mid_nodes), [[1, 1]])


@pytest.mark.parametrize("width", [20, 27])
def test_a_mid_node_at_a_quarter_has_an_offset_of_a_quarter(width):
    mesh = second_order(width, {8: [-0.25, 0, 0]})
    assert mesh.quality("mid-node-offset")[0] == pytest.approx(0.25)
    least = jacobian_range(mesh.points, mesh.hexes, mesh.mid_nodes)[0, 0]
    assert least == pytest.approx(0, abs=1e-12)  # singular at the edge's end
    assert mesh.quality("jacobian-ratio")[0] > 1e6


def test_the_ratio_counts_nodes_and_gauss_points():
    mesh = second_order(20, {8: [-0.3, 0, 0]})
    at_nodes, at_gauss = (
        jacobian_range(mesh.points, mesh.hexes, mesh.mid_nodes, nodes=nodes, gauss=not nodes) for nodes in (True, False)
    )
    both = jacobian_range(mesh.points, mesh.hexes, mesh.mid_nodes)
    assert both[0, 0] == min(at_nodes[0, 0], at_gauss[0, 0]) < 0 < at_gauss[0, 0]
    assert both[0, 1] == max(at_nodes[0, 1], at_gauss[0, 1])
    assert mesh.quality("jacobian-ratio")[0] == math.inf
    assert (
        certify(mesh.points, mesh.hexes, mesh.mid_nodes)[0] == Validity.INVERTED
    )  # at the corner whose edge is curved
