"""Block Jacobi: the 3 x 3 blocks of a Hessian's diagonal, made positive definite, inverted and applied."""

from __future__ import annotations

import numba

from hexmend.kernels import parallel
from hexmend.kernels.symmetric import extreme_eigenvalues

#: Nodes that one thread takes at a time.
_CHUNK = 1024


@parallel
def invert_blocks(blocks, inverse):
    """Invert symmetric blocks after Algorithm A.4 has raised their least eigenvalue; writes inverse (k, 6).

    Parameters
    ----------
    blocks : (k, 6) float64
        xx xy xz yy yz zz.
    """
    for chunk in numba.prange((blocks.shape[0] + _CHUNK - 1) // _CHUNK):
        for i in range(chunk * _CHUNK, min(blocks.shape[0], (chunk + 1) * _CHUNK)):
            xx, xy, xz = blocks[i, 0], blocks[i, 1], blocks[i, 2]
            yy, yz, zz = blocks[i, 3], blocks[i, 4], blocks[i, 5]
            least, greatest = extreme_eigenvalues(xx, xy, xz, yy, yz, zz)
            size = max(abs(least), abs(greatest))
            if size == 0:
                size = 1.0
            shift = max(0.001 * size - least, 0.0)
            xx, yy, zz = xx + shift, yy + shift, zz + shift
            cxx, cxy, cxz = yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy
            det = xx * cxx + xy * cxy + xz * cxz
            if not det > 0:  # a block that is all but of rank 1 or 2: its scale alone
                cxx, cxy, cxz, det = 1.0, 0.0, 0.0, size
                inverse[i, 3], inverse[i, 4], inverse[i, 5] = 1 / size, 0.0, 1 / size
            else:
                inverse[i, 3] = (xx * zz - xz * xz) / det
                inverse[i, 4] = (xy * xz - xx * yz) / det
                inverse[i, 5] = (xx * yy - xy * xy) / det
            inverse[i, 0], inverse[i, 1], inverse[i, 2] = cxx / det, cxy / det, cxz / det


@parallel
def apply_blocks(inverse, r, z):
    """Symmetric blocks (k, 6) times r (k, 3); writes z (k, 3)."""
    for chunk in numba.prange((r.shape[0] + _CHUNK - 1) // _CHUNK):
        for i in range(chunk * _CHUNK, min(r.shape[0], (chunk + 1) * _CHUNK)):
            x, y, w = r[i, 0], r[i, 1], r[i, 2]
            z[i, 0] = inverse[i, 0] * x + inverse[i, 1] * y + inverse[i, 2] * w
            z[i, 1] = inverse[i, 1] * x + inverse[i, 3] * y + inverse[i, 4] * w
            z[i, 2] = inverse[i, 2] * x + inverse[i, 4] * y + inverse[i, 5] * w
