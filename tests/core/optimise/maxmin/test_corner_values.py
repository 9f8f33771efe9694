"""Scaled Jacobians of corners one by one."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.mesh.edge_length import shortest_edges
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA, EDGES
from hexmend.optimise.maxmin.corner_values import gradients, scaled_jacobians
from hexmend.quality import measure
from tests.core.grids import grid, scrambled

seeds = st.integers(0, 2**32 - 1)
amplitudes = st.floats(0, 3)


def corners_of(mesh):
    return mesh.hexes[:, CORNER_TETRAHEDRA].reshape(-1, 4)


def with_coinciding_nodes(mesh):
    """The mesh with the second node of its first hex on the first."""
    points = mesh.points.copy()
    points[mesh.hexes[0, 1]] = points[mesh.hexes[0, 0]]
    return mesh.with_points(points)


@given(seeds, amplitudes)
def test_the_least_of_a_hex_is_its_scaled_jacobian(seed, amplitude):
    mesh = scrambled(grid(3), amplitude, seed)
    least = scaled_jacobians(mesh.points, mesh.hexes).min(axis=1)
    np.testing.assert_allclose(least, measure(mesh.points, mesh.hexes).scaled_jacobian, atol=1e-12)


def test_of_many_hexes_those_of_some_are_the_same():
    mesh = scrambled(grid(38), 0.4)
    values = scaled_jacobians(mesh.points, mesh.hexes)
    last = slice(-100, None)
    np.testing.assert_array_equal(values[last], scaled_jacobians(mesh.points, mesh.hexes[last]))
    np.testing.assert_allclose(values.min(axis=1), measure(mesh.points, mesh.hexes).scaled_jacobian, atol=1e-12)


@given(seeds, amplitudes, st.floats(1e-3, 1e3), st.permutations([0, 1, 2]))
def test_they_know_no_size_no_place_and_no_order_of_axes(seed, amplitude, size, order):
    mesh = scrambled(grid(2), amplitude, seed)
    turned = np.ascontiguousarray(size * mesh.points[:, list(order)] + 7)
    sign = np.linalg.det(np.eye(3)[list(order)])  # an odd order of the axes is a mirror
    expected = sign * scaled_jacobians(mesh.points, mesh.hexes)
    np.testing.assert_allclose(scaled_jacobians(turned, mesh.hexes), expected, atol=1e-9)


@given(seeds, st.floats(0, 0.8))
def test_derivatives_are_those_of_differences(seed, amplitude):
    mesh = scrambled(grid(2), amplitude, seed)
    corners, way = corners_of(mesh), np.random.default_rng(seed).uniform(-1, 1, mesh.points.shape)
    values, derivatives = gradients(mesh.points, corners)
    np.testing.assert_allclose(values, scaled_jacobians(mesh.points, mesh.hexes).ravel(), rtol=1e-12, atol=1e-12)
    t = 1e-6 * shortest_edges(mesh.points, mesh.hexes).min()
    rise = gradients(mesh.points + t * way, corners)[0] - gradients(mesh.points - t * way, corners)[0]
    slope = np.einsum("kij,kij->k", derivatives, way[corners])
    np.testing.assert_allclose(rise / (2 * t), slope, rtol=1e-5, atol=1e-5 * (1 + np.abs(slope).max()))


@given(seeds, amplitudes)
def test_moving_or_scaling_all_nodes_of_a_corner_changes_nothing(seed, amplitude):
    mesh = scrambled(grid(2), amplitude, seed)
    corners = corners_of(mesh)
    _, derivatives = gradients(mesh.points, corners)
    size = 1 + np.abs(derivatives).max()
    np.testing.assert_allclose(derivatives.sum(axis=1), 0, atol=1e-12 * size)
    along = np.einsum("kij,kij->k", derivatives, mesh.points[corners])
    np.testing.assert_allclose(along, 0, atol=1e-10 * size)


def test_an_edge_without_length_has_the_least_value_and_no_derivative():
    mesh = with_coinciding_nodes(grid(2))
    values, derivatives = gradients(mesh.points, corners_of(mesh))
    degenerate = (corners_of(mesh)[:, :, None] == mesh.hexes[0, :2]).any(axis=1).all(axis=1)
    degenerate &= np.isin(corners_of(mesh)[:, 0], mesh.hexes[0, :2])
    assert degenerate.sum() >= 2
    assert (values[degenerate] == -1).all()
    assert (derivatives[degenerate] == 0).all()
    assert np.isfinite(values).all()
    assert np.isfinite(derivatives).all()


@given(seeds, amplitudes)
def test_shortest_edges_are_those_at_each_node(seed, amplitude):
    mesh = scrambled(grid(2), amplitude, seed)
    some = mesh.hexes[:3]
    size = shortest_edges(mesh.points, some)
    for node in range(mesh.n_nodes):
        ends = some[:, EDGES].reshape(-1, 2)
        ends = ends[(ends == node).any(axis=1)]
        lengths = np.linalg.norm(mesh.points[ends[:, 0]] - mesh.points[ends[:, 1]], axis=1)
        assert size[node] == pytest.approx(lengths.min(initial=np.inf))


@given(seeds)
def test_of_no_corners_there_is_nothing(seed):
    points = np.random.default_rng(seed).normal(size=(8, 3))
    values, derivatives = gradients(points, np.empty((0, 4), dtype=np.int32))
    assert values.shape == (0,)
    assert derivatives.shape == (0, 4, 3)
    assert np.isinf(shortest_edges(points, np.empty((0, 8), dtype=np.int32))).all()
