"""Minimum residuals against a direct solver, and when they end."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.energy import MeshEnergy
from hexmend.gallery import make
from hexmend.optimise.linear_solvers import Minres, minres


def indefinite(size, seed, condition):
    """A symmetric matrix of this condition with eigenvalues of both signs, and a right-hand side."""
    random = np.random.default_rng(seed)
    q, _ = np.linalg.qr(random.normal(size=(size, size)))
    return (q * (np.geomspace(1, condition, size) * random.choice([-1, 1], size))) @ q.T, random.normal(size=size)


@given(st.integers(2, 40), st.integers(0, 2**32 - 1), st.sampled_from([1e1, 1e3]))
def test_it_solves_what_has_eigenvalues_of_both_signs(size, seed, condition):
    matrix, right = indefinite(size, seed, condition)
    x, _ = minres(matrix.__matmul__, right, 1e-9, 100 * size)
    np.testing.assert_allclose(matrix @ x, right, atol=1e-7 * np.linalg.norm(right))


@given(st.integers(5, 40), st.integers(0, 2**32 - 1), st.sampled_from([1e-1, 1e-3, 1e-6]))
def test_it_ends_by_the_residual_beside_the_right_hand_side(size, seed, tolerance):
    matrix, right = indefinite(size, seed, 1e3)
    goal = tolerance * np.linalg.norm(right)

    def left(x):
        return np.linalg.norm(right - matrix @ x)

    x, count = minres(matrix.__matmul__, right, tolerance, 1000)
    assert left(x) <= 1.01 * goal
    before, _ = minres(matrix.__matmul__, right, tolerance, count - 1)
    assert count == 1 or left(before) > 0.99 * goal


def test_a_newton_direction_is_as_good_as_its_tolerance_says():
    energy = MeshEnergy(make("bridge-sharp", size=500))
    x = energy.to_edge_units(energy.mesh.points)
    hessian, right = energy.hessian(x), -energy.gradient(x).ravel()
    step, count = Minres(tolerance=1e-6, iterations=10_000)(hessian, right)
    assert count < 10_000
    assert np.linalg.norm(right - hessian @ step) == pytest.approx(0, abs=2e-6 * np.linalg.norm(right))


@pytest.mark.parametrize("sound", [0, 1, 2])
def test_the_last_iterate_is_given_where_the_matrix_leaves_the_range_of_numbers(sound):
    matrix, calls = np.diag([3.0, 2.0, 1.0, 0.5]), []

    def product(x):
        calls.append(1)
        return matrix @ x if len(calls) <= sound else np.full(4, np.inf)

    with np.errstate(all="ignore"):
        x, count = minres(product, np.ones(4), 1e-12, 10)
    assert count == sound + 1
    expected, _ = minres(matrix.__matmul__, np.ones(4), 1e-12, sound) if sound else (np.zeros(4), 0)
    np.testing.assert_array_equal(x, expected)
