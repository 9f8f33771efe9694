"""The scalar formulas of a corner tetrahedron: h(sigma), h^(-2/3), eta."""

from __future__ import annotations

import numpy as np

from hexmend.numba_kernels import exact, formula

#: The upper half of the bits of 2^52 (1023 + 1023 * 2/3 - 0.0446): makes those of h^(-2/3) right to 4 %.
MAGIC = 7678276173719137280 >> 32

#: The least normal and the greatest float.
TINY, HUGE = 2.2250738585072014e-308, 1.7976931348623157e308


@formula
def barrier(sigma, delta):
    """h(sigma) of (3.2) and r = sqrt(sigma^2 + 4 delta^2).

    For sigma < 0 it is 2 delta^2/(r - sigma), the same number without cancellation.
    """
    if delta == 0:  # also where sigma^2 would overflow
        return max(sigma, 0.0), abs(sigma)
    r = np.sqrt(sigma * sigma + 4 * delta * delta)
    u = abs(sigma) + r
    h = 0.5 * u if sigma >= 0 else 2 * delta * delta / u
    return h, r


@formula
def power_minus_two_thirds(h):
    """h^(-2/3); +inf for h <= 0, for less than the least normal float and for what is no number.

    A guess from the upper bits of h, then twice the series of q (1 - y)^(-1/3), y = 1 - h^2 q^3, to its fourth term,
    without a branch: an error of 0.04 becomes one of 3e-5, and then rounding is all that is left.
    """
    upper = np.int32(np.float64(h).view(np.int64) >> 32)
    q = np.int64(np.int64(MAGIC - np.int32(upper * (2.0 / 3.0))) << 32).view(np.float64)
    for _ in range(2):
        root = h * q  # h^(1/3): neither it nor its square leaves the range of floats
        y = 1.0 - root * root * q
        q += q * y * (1.0 / 3.0 + y * (2.0 / 9.0 + y * (14.0 / 81.0)))
    q = q if h >= TINY else np.inf
    return q if not h > HUGE else 0.0


@exact
def determinant(ux, uy, uz, vx, vy, vz, wx, wy, wz):
    """sigma = det [u, v, w] = u . (v x w). Exact, so that a flat corner is flat to every kernel."""
    return ux * (vy * wz - vz * wy) + uy * (vz * wx - vx * wz) + uz * (vx * wy - vy * wx)
