"""Symmetric 3 x 3 matrices, given by xx, xy, xz, yy, yz, zz."""

from __future__ import annotations

import numpy as np

from hexmend.numba_kernels import serial


@serial
def extreme_eigenvalues(xx, xy, xz, yy, yz, zz):
    """Least and greatest eigenvalue, by the trigonometric solution of the characteristic equation (Smith 1961)."""
    mean = (xx + yy + zz) / 3
    ax, ay, az = xx - mean, yy - mean, zz - mean
    spread = np.sqrt((ax * ax + ay * ay + az * az + 2 * (xy * xy + xz * xz + yz * yz)) / 6)
    if not spread > 0:
        return mean, mean
    half = (ax * (ay * az - yz * yz) - xy * (xy * az - yz * xz) + xz * (xy * yz - ay * xz)) / (2 * spread**3)
    angle = np.arccos(min(max(half, -1.0), 1.0)) / 3
    return mean + 2 * spread * np.cos(angle + 2 * np.pi / 3), mean + 2 * spread * np.cos(angle)


@serial
def solve(xx, xy, xz, yy, yz, zz, bx, by, bz):
    """Solution of the linear system by cofactors; zero where the matrix is singular."""
    cxx, cxy, cxz = yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy
    det = xx * cxx + xy * cxy + xz * cxz
    if det == 0:
        return 0.0, 0.0, 0.0
    cyy, cyz, czz = xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy
    return (
        (cxx * bx + cxy * by + cxz * bz) / det,
        (cxy * bx + cyy * by + cyz * bz) / det,
        (cxz * bx + cyz * by + czz * bz) / det,
    )
