"""The formulas of a corner tetrahedron, S = [u, v, w]: eta(T), its first and its second derivative.

With V and W directions of S, C the cofactors of S (its columns v x w, w x u, u x v, so that d sigma(V) = (C, V)),
r = sqrt(sigma^2 + 4 delta^2) and f = h^(-2/3)/3, so that eta = f |S|^2:

    d eta(V)    = 2 f [ (V, S) - |S|^2 (C, V)/(3 r) ]                                                       (B.3)
    d2 eta(V,W) = 2 f [ (V, W) - 2/(3 r) ((V, S)(C, W) + (C, V)(W, S))
                        - |S|^2/(3 r) d2 sigma(V, W) + |S|^2/(3 r^2) (2/3 + sigma/r) (C, V)(C, W) ]

The second is (B.19), mended, with (B.3) put in for d eta d eta/eta: the terms in 1/|S|^2 cancel, and nothing is divided
by eta, |S| or sigma, so that collapsed and inverted tetrahedra are no special case while delta > 0.
"""

from __future__ import annotations

from hexmend.numba_kernels import formula
from hexmend.numba_kernels.shape import barrier, determinant, power_minus_two_thirds


@formula
def cofactors(ux, uy, uz, vx, vy, vz, wx, wy, wz):
    """Columns v x w, w x u, u x v: the derivative of the determinant of [u, v, w]."""
    return (
        vy * wz - vz * wy, vz * wx - vx * wz, vx * wy - vy * wx,
        wy * uz - wz * uy, wz * ux - wx * uz, wx * uy - wy * ux,
        uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx,
    )  # fmt: skip


@formula
def energy(ux, uy, uz, vx, vy, vz, wx, wy, wz, delta, keep):
    """f, |S|^2, sigma and r; eta(T) is the product of the first two, (3.1).

    Where `keep` is 0 the tetrahedron is left out: f, to which all energies and derivatives are in proportion, is 0.
    """
    sigma = determinant(ux, uy, uz, vx, vy, vz, wx, wy, wz)
    f, square, r = _energy(sigma, ux, uy, uz, vx, vy, vz, wx, wy, wz, delta, keep)
    return f, square, sigma, r


@formula
def _energy(sigma, ux, uy, uz, vx, vy, vz, wx, wy, wz, delta, keep):
    """f, |S|^2 and r where sigma is known."""
    h, r = barrier(sigma, delta)
    square = ux * ux + uy * uy + uz * uz + vx * vx + vy * vy + vz * vz + wx * wx + wy * wy + wz * wz
    f = power_minus_two_thirds(h) * (1.0 / 3.0)
    return f if keep > 0 else 0.0, square, r


@formula
def gradient(ux, uy, uz, vx, vy, vz, wx, wy, wz, delta, keep):
    """eta(T), and an eighth of its derivative by the nine entries of S: (B.3), the mean of eight being eta(H)."""
    f, square, _, r = energy(ux, uy, uz, vx, vy, vz, wx, wy, wz, delta, keep)
    cux, cuy, cuz, cvx, cvy, cvz, cwx, cwy, cwz = cofactors(ux, uy, uz, vx, vy, vz, wx, wy, wz)
    k, c = f / 4, f * square / (12 * r) if keep > 0 else 0.0
    return (
        f * square,
        k * ux - c * cux, k * uy - c * cuy, k * uz - c * cuz,
        k * vx - c * cvx, k * vy - c * cvy, k * vz - c * cvz,
        k * wx - c * cwx, k * wy - c * cwy, k * wz - c * cwz,
    )  # fmt: skip


@formula
def product(ux, uy, uz, vx, vy, vz, wx, wy, wz, aux, auy, auz, avx, avy, avz, awx, awy, awz, delta, keep):
    """Along the direction A = [au, av, aw]: (B.3) and (B.19).

    Returns
    -------
    float
        eta(T).
    float
        d eta(A)/8.
    nine floats
        d eta/8 by the entries of S, as `gradient` gives it.
    nine floats
        d2 eta(A, .)/8 by the entries of S.
    """
    cux, cuy, cuz, cvx, cvy, cvz, cwx, cwy, cwz = cofactors(ux, uy, uz, vx, vy, vz, wx, wy, wz)
    sigma = ux * cux + uy * cuy + uz * cuz  # not to the last bit the determinant, but at hand
    f, square, r = _energy(sigma, ux, uy, uz, vx, vy, vz, wx, wy, wz, delta, keep)
    along_s = aux * ux + auy * uy + auz * uz + avx * vx + avy * vy + avz * vz + awx * wx + awy * wy + awz * wz
    along_c = aux * cux + auy * cuy + auz * cuz + avx * cvx + avy * cvy + avz * cvz
    along_c += awx * cwx + awy * cwy + awz * cwz  # d sigma(A)
    over_r = 1 / r if keep > 0 else 0.0
    k, c = f / 4, f * square * over_r / 12
    # What multiplies S and C in the second derivative; A itself comes with k, dC with -c.
    mixed = -2.0 / 3.0 * k * over_r
    s = mixed * along_c
    q = mixed * along_s + c * over_r * (2.0 / 3.0 + sigma * over_r) * along_c
    return (
        f * square,
        k * along_s - c * along_c,
        k * ux - c * cux, k * uy - c * cuy, k * uz - c * cuz,
        k * vx - c * cvx, k * vy - c * cvy, k * vz - c * cvz,
        k * wx - c * cwx, k * wy - c * cwy, k * wz - c * cwz,
        # dC: its columns are av x w + v x aw, and so on round.
        s * ux + q * cux + k * aux - c * (avy * wz - avz * wy + vy * awz - vz * awy),
        s * uy + q * cuy + k * auy - c * (avz * wx - avx * wz + vz * awx - vx * awz),
        s * uz + q * cuz + k * auz - c * (avx * wy - avy * wx + vx * awy - vy * awx),
        s * vx + q * cvx + k * avx - c * (awy * uz - awz * uy + wy * auz - wz * auy),
        s * vy + q * cvy + k * avy - c * (awz * ux - awx * uz + wz * aux - wx * auz),
        s * vz + q * cvz + k * avz - c * (awx * uy - awy * ux + wx * auy - wy * aux),
        s * wx + q * cwx + k * awx - c * (auy * vz - auz * vy + uy * avz - uz * avy),
        s * wy + q * cwy + k * awy - c * (auz * vx - aux * vz + uz * avx - ux * avz),
        s * wz + q * cwz + k * awz - c * (aux * vy - auy * vx + ux * avy - uy * avx),
    )  # fmt: skip


@formula
def second(ux, uy, uz, vx, vy, vz, wx, wy, wz, delta, keep):
    """What the second derivative is made of: eta(T), k, c, mixed and half; the last four for d2 eta/8.

    The gradient is k S - c C; the second derivative has k (V, W), -c d2 sigma, and, with p = mixed S + half C,
    (C, V)(p, W) + (p, V)(C, W).
    """
    f, square, sigma, r = energy(ux, uy, uz, vx, vy, vz, wx, wy, wz, delta, keep)
    over_r = 1 / r if keep > 0 else 0.0
    k, c = f / 4, f * square * over_r / 12
    return f * square, k, c, -2.0 / 3.0 * k * over_r, c * over_r * (1.0 / 3.0 + sigma * over_r / 2)


@formula
def own_second(f, square, sigma, r, k, sx, sy, sz, cx, cy, cz):
    """Second derivatives of eta(T) by one of its nodes, (xx xy xz yy yz zz); there d2 sigma vanishes (B.1).

    Parameters
    ----------
    f, square, sigma, r : float
        As from `energy`.
    k : float
        (V, V) of a unit displacement: 3 of the apex, 1 of the others.
    sx, sy, sz, cx, cy, cz : float
        (V, S) and (C, V) of the unit displacements along x, y, z.
    """
    a = 4 * f / (3 * r)
    b = 2 * f * square / (3 * r * r) * (2.0 / 3.0 + sigma / r)
    return (
        2 * f * k - 2 * a * sx * cx + b * cx * cx,
        -a * (sx * cy + sy * cx) + b * cx * cy,
        -a * (sx * cz + sz * cx) + b * cx * cz,
        2 * f * k - 2 * a * sy * cy + b * cy * cy,
        -a * (sy * cz + sz * cy) + b * cy * cz,
        2 * f * k - 2 * a * sz * cz + b * cz * cz,
    )
