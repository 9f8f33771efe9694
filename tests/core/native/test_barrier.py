"""h(sigma) and h^(-2/3) over the whole range of floats."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.core.native.extension import extension

kernels = extension()


def power_minus_two_thirds(h):
    powers = np.empty(1)
    kernels.barrier.power_minus_two_thirds(np.array([h]), powers)
    return powers[0]


def barrier(sigma, delta):
    h, r = np.empty(1), np.empty(1)
    kernels.barrier.barrier(np.array([sigma]), delta, h, r)
    return h[0], r[0]


@given(st.floats(min_value=1e-300, max_value=1e300))
def test_the_fast_power_is_the_power(h):
    assert power_minus_two_thirds(h) == pytest.approx(h ** (-2 / 3), rel=1e-13)


@given(st.floats(-1e6, 1e6), st.floats(1e-6, 1e3))
def test_barrier_is_positive_and_solves_its_equation(sigma, delta):
    h, r = barrier(sigma, delta)
    assert h > 0
    assert r == pytest.approx(np.hypot(sigma, 2 * delta))
    assert h * (h - sigma) == pytest.approx(delta * delta, rel=1e-6, abs=1e-12 * max(1, sigma * sigma))


@given(st.floats(-1e6, 1e6))
def test_without_delta_the_barrier_is_sigma_or_zero(sigma):
    assert barrier(sigma, 0.0)[0] == max(sigma, 0.0)
