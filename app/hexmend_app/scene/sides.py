"""On which side of planes the elements lie; on one thread, because the window's thread asks."""

from __future__ import annotations

import numpy as np

from hexmend.numba_kernels import serial


@serial
def centres_kept(points, hexes, normals, offsets, notch):
    """True for each hex whose centre is not cut away, (m,) bool.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    normals : (k, 3) float64
    offsets : (k,) float64
        A point lies beyond a plane where x . normal > offset.
    notch : bool
        Cut away what lies beyond all planes; else what lies beyond one of them.
    """
    kept = np.full(hexes.shape[0], not notch)
    for k in range(normals.shape[0]):
        height = _heights(points, normals[k])
        for h in range(hexes.shape[0]):
            if kept[h] == notch:  # already decided
                continue
            total = 0.0
            for c in range(8):
                total += height[hexes[h, c]]
            kept[h] = total <= 8 * offsets[k]
    return kept


@serial
def touched(points, hexes, normals, offsets, notch):
    """Which planes cross or touch each hex where that can be seen, (m, k) bool.

    A plane through nodes has hexes that only touch it on either side, and by rounding a node may lie here or there.
    Those of both sides are named, so that whoever cuts them can decide for each node once. A section is seen as far as
    the other planes leave it open: not where a hex lies wholly beyond one of them, or, with `notch`, wholly before.

    Parameters are those of `centres_kept`.
    """
    planes = normals.shape[0]
    height = np.empty((points.shape[0], planes))
    for p in range(planes):
        height[:, p] = _heights(points, normals[p])
    answer = np.zeros((hexes.shape[0], planes), np.bool_)
    slack = np.empty(planes)
    for p in range(planes):
        slack[p] = 1e-12 * max(np.abs(height[:, p]).max() if points.size else 0.0, abs(offsets[p]))
    for h in range(hexes.shape[0]):
        for p in range(planes):
            low, high = np.inf, -np.inf
            for c in range(8):
                low = min(low, height[hexes[h, c], p])
                high = max(high, height[hexes[h, c], p])
            before, beyond = high < offsets[p] - slack[p], low > offsets[p] + slack[p]
            answer[h, p] = not (before or beyond)
            if before if notch else beyond:
                answer[h] = False
                break
    return answer


@serial
def _heights(points, normal):
    height = np.empty(points.shape[0])
    for i in range(points.shape[0]):
        height[i] = points[i, 0] * normal[0] + points[i, 1] * normal[1] + points[i, 2] * normal[2]
    return height
