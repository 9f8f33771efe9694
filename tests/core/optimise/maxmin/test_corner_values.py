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
