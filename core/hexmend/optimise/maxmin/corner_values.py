"""Scaled Jacobians of single corners, and their derivatives."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA

#: Hexes in a batch, which bounds the memory of temporary arrays.
_HEXES = 50_000


def scaled_jacobians(points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Compute the scaled Jacobian of each corner of hexes, (k, 8) in [-1, 1]; -1 where an edge has no length.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (k, 8) int

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> scaled_jacobians(UNIT_CUBE, np.arange(8)[None])
    array([[1., 1., 1., 1., 1., 1., 1., 1.]])
    """
    return values_at_corners(hexes, lambda corners: corner_jacobians(points, corners))


def values_at_corners(hexes: np.ndarray, of: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """Evaluate a function at the corners of hexes (k, 8), batch by batch, (k, 8).

    Parameters
    ----------
    hexes : (k, 8) int
    of : callable
        Takes corners (c, 4), the apex and the ends of its edges each, and returns their values (c,).
    """
    values = np.empty((len(hexes), 8))
    for first in range(0, len(hexes), _HEXES):
        part = slice(first, first + _HEXES)
        values[part] = of(hexes[part][:, CORNER_TETRAHEDRA].reshape(-1, 4)).reshape(-1, 8)
    return values


def corner_jacobians(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Compute the scaled Jacobian of corners (k, 4), the apex and the ends of its edges each, (k,)."""
    return _edge_terms(points, corners)[0]


def gradients(points: np.ndarray, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Compute scaled Jacobians with their derivatives by the four nodes.

    Parameters
    ----------
    points : (n, 3) float64
    corners : (k, 4) int
        Apex and ends of the edges of each corner.

    Returns
    -------
    values : (k,)
    derivatives : (k, 4, 3)
        With s = (u, v x w)/(|u| |v| |w|), ds/du = (v x w)/(|u| |v| |w|) - s u/|u|^2, and so on round; of the apex minus
        their sum. 0 where an edge has no length.
    """
    values, edges, lengths, across = _edge_terms(points, corners)
    size = lengths.prod(axis=1)[:, None, None]
    sound = size > 0
    by_edge = across / np.where(sound, size, 1.0)
    by_edge -= values[:, None, None] * edges / np.where(sound, np.square(lengths)[:, :, None], 1.0)
    by_edge *= sound
    return values, np.concatenate([-by_edge.sum(axis=1, keepdims=True), by_edge], axis=1)


def _edge_terms(points: np.ndarray, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Values (k,), edges (k, 3, 3) by rows, their lengths (k, 3), cross products of the other two (k, 3, 3)."""
    x = points[corners]
    edges = x[:, 1:] - x[:, :1]
    lengths = np.linalg.norm(edges, axis=2)
    across = np.cross(np.roll(edges, -1, axis=1), np.roll(edges, -2, axis=1))
    volume = np.einsum("ki,ki->k", edges[:, 0], across[:, 0])
    size = lengths.prod(axis=1)
    return np.where(size > 0, volume / np.where(size > 0, size, 1.0), -1.0), edges, lengths, across
