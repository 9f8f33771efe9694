"""Scaled Jacobians of single corners, and their derivatives."""

from __future__ import annotations

import numpy as np

from hexmend.kernels import elements


def scaled_jacobians(points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Compute the scaled Jacobian of each corner of hexes, (k, 8) in [-1, 1]; -1 where an edge has no length.

    Parameters
    ----------
    points : (n, 3) float64
        Contiguous, as all arrays here.
    hexes : (k, 8) int32

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> scaled_jacobians(UNIT_CUBE, np.arange(8, dtype=np.int32)[None])
    array([[1., 1., 1., 1., 1., 1., 1., 1.]])
    """
    values = np.empty((len(hexes), 8))
    elements.corner_jacobians(points, hexes, values)
    return values


def gradients(points: np.ndarray, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Compute scaled Jacobians with their derivatives by the four nodes.

    Parameters
    ----------
    points : (n, 3) float64
    corners : (k, 4) int32
        Apex and ends of the edges of each corner.

    Returns
    -------
    values : (k,)
    derivatives : (k, 4, 3)
        With s = (u, v x w)/(|u| |v| |w|), ds/du = (v x w)/(|u| |v| |w|) - s u/|u|^2, and so on round; of the apex minus
        their sum. 0 where an edge has no length.
    """
    values, derivatives = np.empty(len(corners)), np.empty((len(corners), 12))
    elements.jacobian_gradients(points, corners, values, derivatives)
    return values, derivatives.reshape(-1, 4, 3)
