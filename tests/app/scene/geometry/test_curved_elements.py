"""Curved faces and hexes of second order: polynomials, areas, normals and missing nodes."""

import numpy as np
import pytest

from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.second_order import NODE_POSITIONS
from hexmend.mesh.second_order.curved_geometry import (
    QUAD_POSITIONS,
    evaluate_quads,
    grid,
    hex_nodes,
    quad_nodes,
)
from hexmend.mesh.second_order.mid_node_lookup import face_mid_nodes
from hexmend_app.scene.geometry.curved_elements import edge_mid_nodes, evaluate_hexes, quad_normals
from tests.core.curved_shell import curved_shell


def polynomial(at, powers, seed=0):
    """Return a random vector polynomial with these powers of u, v (and w) at points, (..., 3)."""
    coefficients = np.random.default_rng(seed).normal(size=(len(powers), 3))
    return sum(c * np.prod(at ** np.array(p), axis=-1)[..., None] for c, p in zip(coefficients, powers, strict=True))


Q2 = [(i, j) for i in range(3) for j in range(3)]
SERENDIPITY = [p for p in Q2 if p != (2, 2)]


@pytest.mark.parametrize(("width", "powers"), [(8, SERENDIPITY), (9, Q2)])
def test_quads_reproduce_their_polynomials_and_the_normals_of_these(width, powers):
    nodes = polynomial(QUAD_POSITIONS[:width], powers)[None] + [0, 0, 0]
    at = np.random.default_rng(1).random((50, 2))
    np.testing.assert_allclose(evaluate_quads(nodes, at)[0], polynomial(at, powers), atol=1e-13)
    step = 1e-6
    du, dv = (
        (polynomial(at + step * axis, powers) - polynomial(at - step * axis, powers)) / (2 * step) for axis in np.eye(2)
    )
    normal = np.cross(du, dv)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    np.testing.assert_allclose(quad_normals(nodes, at)[0], normal, atol=1e-6)


def test_hexes_reproduce_triquadratic_polynomials():
    powers = [(i, j, k) for i in range(3) for j in range(3) for k in range(3)]
    at = np.random.default_rng(2).random((40, 3))
    nodes = polynomial(NODE_POSITIONS, powers)[None]
    np.testing.assert_allclose(evaluate_hexes(nodes, at)[0], polynomial(at, powers), atol=1e-12)


@pytest.mark.parametrize("nodes", [20, 27])
def test_area_and_normals_of_a_cylinder_are_those_of_the_circle(nodes):
    mesh = curved_shell(nodes, around=8)
    outer = outer_faces(mesh)
    at = grid(64)
    points, normals = evaluate_quads(outer, at), quad_normals(outer, at)
    radii = np.linalg.norm(points[..., :2], axis=2)
    assert np.abs(radii - 2).max() < 2e-4  # third order: a chord of this angle is 2e-2 from the circle
    radial = points.copy()
    radial[..., 2] = 0
    radial /= np.linalg.norm(radial, axis=2)[..., None]
    assert (normals * radial).sum(axis=2).min() > np.cos(np.radians(0.2))
    assert area(points.reshape(len(outer), 65, 65, 3)) == pytest.approx(2 * np.pi / 2 * 1.0, rel=1e-4)


def area(points):
    """Return the area of grids of points, (k, n, n, 3), by triangles."""
    a, b, c, d = points[:, :-1, :-1], points[:, :-1, 1:], points[:, 1:, 1:], points[:, 1:, :-1]
    return sum(np.linalg.norm(np.cross(q - p, r - p), axis=-1).sum() / 2 for p, q, r in ((a, b, c), (a, c, d)))


def outer_faces(mesh):
    """Return the positions of all nodes of the faces x+ (the outer ones) of a shell, (k, 9, 3)."""
    owners = np.flatnonzero(np.isclose(np.linalg.norm(mesh.points[mesh.hexes[:, 1], :2], axis=1), 2))
    corners = mesh.hexes[owners][:, FACES[1]]
    mids = face_mid_nodes(mesh.hexes, mesh.mid_nodes, owners, corners)
    return quad_nodes(mesh.points, corners, mids)


def test_mid_nodes_of_rotated_and_reversed_faces_are_those_of_their_edges():
    mesh = curved_shell(27)
    corners = mesh.hexes[:, FACES[4]]
    mids = face_mid_nodes(mesh.hexes, mesh.mid_nodes, np.arange(mesh.n_hexes), corners)
    turned = face_mid_nodes(mesh.hexes, mesh.mid_nodes, np.arange(mesh.n_hexes), np.roll(corners, 1, axis=1))
    np.testing.assert_array_equal(turned[:, :4], np.roll(mids[:, :4], 1, axis=1))
    np.testing.assert_array_equal(turned[:, 4], mesh.mid_nodes[:, 16])
    found = edge_mid_nodes(mesh.hexes, mesh.mid_nodes, corners[:, [1, 0]])
    np.testing.assert_array_equal(found, mids[:, 0])
    assert edge_mid_nodes(mesh.hexes, mesh.mid_nodes, corners[:1, [0, 2]]) == [-1]


def test_missing_mid_nodes_make_straight_edges_and_serendipity_faces():
    mesh = curved_shell(20)
    nodes = hex_nodes(mesh.points, mesh.hexes, mesh.mid_nodes)
    face = FACES[1]
    corners = mesh.hexes[:, face]
    mids = face_mid_nodes(mesh.hexes, mesh.mid_nodes, np.arange(mesh.n_hexes), corners)
    eight = evaluate_quads(quad_nodes(mesh.points, corners, mids)[:, :8], np.array([[0.3, 0.8]]))
    whole = evaluate_hexes(nodes, np.array([[1.0, 0.3, 0.8]]))
    np.testing.assert_allclose(whole, eight, atol=1e-14)
    none = np.full_like(mesh.mid_nodes, -1)
    straight = hex_nodes(mesh.points, mesh.hexes, none)
    np.testing.assert_allclose(straight[:, 26], mesh.points[mesh.hexes].mean(axis=1), atol=1e-14)
    np.testing.assert_allclose(straight[:, 8], mesh.points[mesh.hexes[:, :2]].mean(axis=1), atol=1e-15)


def test_normals_at_a_collapsed_edge_are_those_of_the_triangle():
    quad = QUAD_POSITIONS @ np.array([[1.0, 0, 0], [0, 1, 0]])
    quad[[2, 3, 6]] = [0.5, 1, 0]
    quad[[5, 7]] = [[0.75, 0.5, 0], [0.25, 0.5, 0]]
    normals = quad_normals(quad[None, :8], grid(4))
    np.testing.assert_allclose(normals, np.broadcast_to([0, 0, 1.0], normals.shape), atol=1e-12)
