"""Symmetric 3 x 3 matrices in the kernels: eigenvalues, solutions and Newton's direction."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.core.native.extension import extension

symmetric = extension().symmetric
seeds = st.integers(0, 2**32 - 1)


def matrix_of(xx, xy, xz, yy, yz, zz):
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


@given(seeds, st.integers(-8, 8))
def test_symmetric_matrices_of_three_rows(seed, exponent):
    random = np.random.default_rng(seed)
    entries = random.normal(size=6) * 10.0**exponent
    right = random.normal(size=3)
    values = np.linalg.eigvalsh(matrix_of(*entries))
    least, greatest = symmetric.extreme_eigenvalues(entries)
    assert (least, greatest) == pytest.approx((values[0], values[2]), rel=1e-6, abs=1e-9 * np.abs(values).max())
    solution = np.array(symmetric.solve(entries, right))
    scale = np.abs(solution).max() * np.abs(entries).max()
    np.testing.assert_allclose(matrix_of(*entries) @ solution, right, atol=1e-10 * max(scale, 1))


def test_special_symmetric_matrices():
    assert symmetric.extreme_eigenvalues([2.0, 0.0, 0.0, 2.0, 0.0, 2.0]) == (2.0, 2.0)
    assert symmetric.extreme_eigenvalues([1.0, 0.0, 0.0, 3.0, 0.0, 3.0]) == pytest.approx((1, 3))
    assert symmetric.solve([0.0] * 6, [1.0, 2.0, 3.0]) == [0.0, 0.0, 0.0]


@given(seeds)
def test_modified_newton_of_a_node_is_algorithm_a_4(seed):
    random = np.random.default_rng(seed)
    entries, gradient = random.normal(size=6), random.normal(size=3)
    hessian = matrix_of(*entries)
    values = np.linalg.eigvalsh(hessian)
    if values[0] < 0.001 * values[2]:
        hessian = hessian + (0.001 * values[2] - values[0]) * np.eye(3)
    p = np.array(symmetric.newton(entries, gradient, True))
    np.testing.assert_allclose(hessian @ p, -gradient, atol=1e-7 * max(1, np.abs(p).max()))
    if values[2] > 0.1:  # positive definite now
        assert p @ gradient < 0
