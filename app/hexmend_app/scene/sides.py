"""On which side of planes the elements lie; on one thread, because the window's thread asks."""

from __future__ import annotations

import numpy as np

from hexmend.kernels import serial


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
def touched(points, hexes, normal, offset):
    """True for each hex that the plane x . normal = offset crosses or touches, (m,) bool.

    A plane through nodes has hexes that only touch it on either side, and by rounding a node may lie here or there.
    Those of both sides are named, so that whoever cuts them can decide for each node once.
    """
    height = _heights(points, normal)
    slack = 0.0
    for i in range(height.size):
        slack = max(slack, abs(height[i]))
    slack = 1e-12 * max(slack, abs(offset))
    answer = np.empty(hexes.shape[0], np.bool_)
    for h in range(hexes.shape[0]):
        low, high = np.inf, -np.inf
        for c in range(8):
            low = min(low, height[hexes[h, c]])
            high = max(high, height[hexes[h, c]])
        answer[h] = low <= offset + slack and high >= offset - slack
    return answer


@serial
def _heights(points, normal):
    height = np.empty(points.shape[0])
    for i in range(points.shape[0]):
        height[i] = points[i, 0] * normal[0] + points[i, 1] * normal[1] + points[i, 2] * normal[2]
    return height
