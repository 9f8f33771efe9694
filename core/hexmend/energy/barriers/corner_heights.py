"""Heights of single corners over their three faces, and their derivatives."""

from __future__ import annotations

import numpy as np


def corner_heights(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Compute the heights of corners (k, 4), the apex and the ends of its edges each, over their faces, (k, 3).

    Height i is that of edge i over the face of the other two; 0 over a face without area.
    """
    return _terms(points, corners)[0]


def height_gradients(points: np.ndarray, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Compute the heights of corners with their derivatives by the four nodes.

    Parameters
    ----------
    points : (n, 3) float64
    corners : (k, 4) int
        Apex and ends of the edges of each corner.

    Returns
    -------
    values : (k, 3)
    derivatives : (k, 3, 4, 3)
        With h = u·n / |n| and n = v x w: dh/du = n/|n|, dh/dv = w x t and dh/dw = t x v, where t = (u - h n/|n|) / |n|;
        of the apex minus their sum. 0 over a face without area.
    """
    heights, edges, normals, areas = _terms(points, corners)
    derivatives = np.zeros((len(corners), 3, 4, 3))
    divisor = np.where(areas > 0, areas, 1.0)[:, :, None]
    unit = normals / divisor
    offset = (edges - heights[:, :, None] * unit) / divisor * (areas > 0)[:, :, None]  # t
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        derivatives[:, i, 1 + i] = unit[:, i]
        derivatives[:, i, 1 + j] = np.cross(edges[:, k], offset[:, i])
        derivatives[:, i, 1 + k] = np.cross(offset[:, i], edges[:, j])
    derivatives[:, :, 0] = -derivatives[:, :, 1:].sum(axis=2)
    return heights, derivatives


def _terms(points: np.ndarray, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Heights (k, 3), edges (k, 3, 3) by rows, normals of the other two (k, 3, 3), the lengths of these (k, 3)."""
    x = points[corners]
    edges = x[:, 1:] - x[:, :1]
    normals = np.cross(np.roll(edges, -1, axis=1), np.roll(edges, -2, axis=1))
    areas = np.linalg.norm(normals, axis=2)
    volume = np.einsum("ki,ki->k", edges[:, 0], normals[:, 0])
    return np.where(areas > 0, volume[:, None] / np.where(areas > 0, areas, 1.0), 0.0), edges, normals, areas
