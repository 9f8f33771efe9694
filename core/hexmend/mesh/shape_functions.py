"""The functions by which the nodes of a hex of second order place every point of it, and their derivatives.

Zienkiewicz, Taylor, *The Finite Element Method*, volume 1: "serendipity" functions of 20 nodes, Lagrange's of 27. All
coordinates are those of the unit cube.
"""

from __future__ import annotations

import numpy as np


def serendipity(at: np.ndarray, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Functions of 20 nodes.

    Parameters
    ----------
    at : (k, 3) float64
        Where.
    places : (20, 3) float64
        Of the nodes: corners, and middles of edges.

    Returns
    -------
    (k, 20), (k, 20, 3) float64
        Values, and derivatives by the unit cube's coordinates.
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
    """Functions of 27 nodes, products of parabolas; parameters and results as of `serendipity`, for 27 nodes."""
    x, c = 2 * at[:, None] - 1, 2 * places - 1
    factors = np.where(c == 0, 1 - x**2, x * (x + c) / 2)
    slopes = np.where(c == 0, -2 * x, x + c / 2)
    gradients = np.empty_like(factors)
    for axis in range(3):
        gradients[..., axis] = 2 * slopes[..., axis] * np.delete(factors, axis, axis=2).prod(axis=2)
    return factors.prod(axis=2), gradients
