"""Heights of corners one by one, their derivatives, and the measures made of them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.mesh.edge_length import shortest_edges
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.optimise.maxmin.corner_heights import corner_heights, height_gradients, least_corner_heights
from hexmend.optimise.maxmin.corner_measure import SCALED_JACOBIAN, time_step_measure
from hexmend.optimise.maxmin.slp import MaxMinOptimiser
from hexmend.optimise.maxmin.slp_step import ActiveCorners
from hexmend.quality.corner_heights import least_heights
from tests.core.grids import grid, scrambled

seeds = st.integers(0, 2**32 - 1)
amplitudes = st.floats(0, 3)


def corners_of(mesh):
    return mesh.hexes[:, CORNER_TETRAHEDRA].reshape(-1, 4)


@given(seeds, amplitudes)
def test_the_least_of_a_hex_is_that_of_the_metric(seed, amplitude):
    mesh = scrambled(grid(3), amplitude, seed)
    least = least_corner_heights(mesh.points, mesh.hexes).min(axis=1)
    np.testing.assert_allclose(least, least_heights(mesh.points, mesh.hexes), atol=1e-12)


@given(seeds, st.floats(0, 0.4))
def test_derivatives_are_those_of_differences(seed, amplitude):
    mesh = scrambled(grid(2), amplitude, seed)
    corners, way = corners_of(mesh), np.random.default_rng(seed).uniform(-1, 1, mesh.points.shape)
    values, derivatives = height_gradients(mesh.points, corners)
    np.testing.assert_array_equal(values, corner_heights(mesh.points, corners))
    t = 1e-6 * shortest_edges(mesh.points, mesh.hexes).min()
    rise = corner_heights(mesh.points + t * way, corners) - corner_heights(mesh.points - t * way, corners)
    slope = np.einsum("khij,kij->kh", derivatives, way[corners])
    np.testing.assert_allclose(rise / (2 * t), slope, rtol=1e-5, atol=1e-5 * (1 + np.abs(slope).max()))


def test_a_face_without_area_has_no_height_and_no_derivative():
    mesh = grid(1)
    points = mesh.points.copy()
    points[mesh.hexes[0, 1]] = points[mesh.hexes[0, 0]]
    values, derivatives = height_gradients(points, corners_of(mesh))
    assert (values[0] == 0).all()
    assert np.isfinite(derivatives).all()
    flat = values == 0
    areas = np.linalg.norm(derivatives[flat], axis=(1, 2))
    assert (areas == 0).any()


@pytest.mark.parametrize("measure", [SCALED_JACOBIAN, time_step_measure(0.7)], ids=["jacobian", "time-step"])
def test_the_value_of_a_corner_is_the_least_of_its_models(measure):
    mesh = scrambled(grid(3), 0.5)
    corners = corners_of(mesh)
    models = measure.models(mesh.points, corners)
    least = np.full(len(corners), np.inf)
    np.minimum.at(least, models.corner, models.values)
    np.testing.assert_allclose(least.reshape(-1, 8), measure.values(mesh.points, mesh.hexes), rtol=1e-14)
    assert models.derivatives.shape == (models.values.size, 4, 3)


def test_the_least_height_is_raised_step_by_step():
    mesh = scrambled(grid(4), 0.35, 3)
    measure = time_step_measure(1.0)
    raising = MaxMinOptimiser(mesh, mesh.points, measure=measure)
    start = raising.least
    *steps, limit = raising.steps()
    assert isinstance(limit, ActiveCorners)
    least = [step.least for step in steps]
    assert least == sorted(least)
    assert start < least[-1] <= 1.0
    assert least[-1] > 0.95  # cubes are the optimum
    np.testing.assert_allclose(least_corner_heights(raising.points, mesh.hexes), raising.corners.values)
    np.testing.assert_array_equal(raising.points[mesh.fixed], mesh.points[mesh.fixed])
