"""Shape functions of second-order hexes and their derivatives, in coordinates of the unit cube.

Zienkiewicz and Taylor, *The Finite Element Method*, volume 1: serendipity functions of 20 nodes, Lagrange of 27.
"""

from __future__ import annotations

import numpy as np


def serendipity(at: np.ndarray, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Evaluate the serendipity functions of 20 nodes.

    Parameters
    ----------
    at : (k, 3) float64
        Points of evaluation.
    places : (20, 3) float64
        Positions of the nodes: corners and edge midpoints.

    Returns
    -------
    values : (k, 20) float64
    gradients : (k, 20, 3) float64
        Derivatives with respect to the coordinates of the unit cube.
    """
    x, c = 2 * at[:, None] - 1, 2 * places - 1  # from -1 to 1
    middle = c == 0
    factors = np.where(middle, 1 - x**2, 1 + x * c)
    slopes = np.where(middle, -2 * x, np.broadcast_to(c, factors.shape))
    corner = ~middle.any(axis=1)
    scale = np.where(corner, 1 / 8, 1 / 4)
    last = np.where(corner, (x * c).sum(axis=2) - 2, 1.0)
    values = scale * factors.prod(axis=2) * last
    gradients = np.empty_like(factors)
    for axis in range(3):
        others = np.delete(factors, axis, axis=2).prod(axis=2)
        along = slopes[..., axis] * others * last + np.where(corner, factors[..., axis] * others * c[:, axis], 0)
        gradients[..., axis] = 2 * scale * along
    return values, gradients


def lagrange(at: np.ndarray, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Evaluate the Lagrange functions of 27 nodes; parameters and results are those of `serendipity`."""
    x, c = 2 * at[:, None] - 1, 2 * places - 1
    factors = np.where(c == 0, 1 - x**2, x * (x + c) / 2)
    slopes = np.where(c == 0, -2 * x, x + c / 2)
    gradients = np.empty_like(factors)
    for axis in range(3):
        gradients[..., axis] = 2 * slopes[..., axis] * np.delete(factors, axis, axis=2).prod(axis=2)
    return factors.prod(axis=2), gradients
