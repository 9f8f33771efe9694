"""Bernstein coefficients of det J of second-order hexes, and the derivatives of functions of them by the nodes.

det J of the map of 27 nodes has degree 5 in each coordinate: its 216 coefficients follow linearly from its values at a
lattice of 6 x 6 x 6 points, and bound it from below.

Johnen, Remacle, Geuzaine: Geometrical validity of curvilinear finite elements, J. Comput. Phys. 233 (2013).
"""

from __future__ import annotations

from math import comb

import numpy as np

from hexmend.mesh.second_order import NODE_POSITIONS, lagrange
from hexmend.mesh.second_order.curved_geometry import hex_nodes

_LINE = np.linspace(0.0, 1.0, 6)
_LATTICE = np.stack(np.meshgrid(_LINE, _LINE, _LINE, indexing="ij"), axis=-1).reshape(-1, 3)

#: Derivatives of the functions of 27 nodes at the lattice, (27, 648): the three coordinates, each at 216 points.
_DERIVATIVES = lagrange(_LATTICE, NODE_POSITIONS)[1].transpose(1, 2, 0).reshape(27, -1)

_TO_COEFFICIENTS_1D = np.linalg.inv([[comb(5, j) * s**j * (1 - s) ** (5 - j) for j in range(6)] for s in _LINE])

#: Coefficients from values at the lattice, (216, 216).
_TO_COEFFICIENTS = np.kron(np.kron(_TO_COEFFICIENTS_1D, _TO_COEFFICIENTS_1D), _TO_COEFFICIENTS_1D)


def completion(mid_nodes: np.ndarray) -> np.ndarray:
    """Return the weights by which the positions of all 27 nodes follow from those that hexes have.

    Parameters
    ----------
    mid_nodes : (k, 19) int32
        As `Mesh.mid_nodes`; -1 where a hex has none.

    Returns
    -------
    (k, 27, 27) float64
        A missing node has a column of zeros.
    """
    patterns, of_hex = np.unique(mid_nodes >= 0, axis=0, return_inverse=True)
    unit, corners = np.eye(27), np.repeat(np.arange(8)[None], len(patterns), axis=0)
    local = np.where(patterns, np.arange(8, 27), -1)
    parts = [hex_nodes(unit[:, first : first + 3], corners, local) for first in range(0, 27, 3)]
    return np.concatenate(parts, axis=2)[of_hex.ravel()]


def coefficients(nodes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Compute the Bernstein coefficients of det J.

    Parameters
    ----------
    nodes : (k, 27, 3) float64
        Positions of all nodes of hexes.

    Returns
    -------
    values : (k, 216) float64
        In the cube of the unit of the positions.
    cofactors : (k, 3, 3, 216) float64
        Of J at the points of the lattice, for `gradient`.
    """
    nodes = nodes - nodes[:, :1]  # so that sums are not rounded at the size of the coordinates
    jacobians = (nodes.transpose(0, 2, 1).reshape(-1, 27) @ _DERIVATIVES).reshape(-1, 3, 3, 216)
    cofactors = np.empty_like(jacobians)
    for i, j in np.ndindex(3, 3):  # i - 2 and i - 1 are the next two rows, from the end
        one, other = jacobians[:, i - 2], jacobians[:, i - 1]
        cofactors[:, i, j] = one[:, j - 2] * other[:, j - 1] - one[:, j - 1] * other[:, j - 2]
    determinants = (jacobians[:, 0] * cofactors[:, 0]).sum(axis=1)
    return determinants @ _TO_COEFFICIENTS.T, cofactors


def least_coefficients(points: np.ndarray, hexes: np.ndarray, mid_nodes: np.ndarray) -> np.ndarray:
    """Compute the least coefficient of each hex, (k,); a positive one proves that the hex is valid.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (k, 8) int32
    mid_nodes : (k, 19) int32
    """
    return coefficients(completion(mid_nodes) @ points[np.concatenate([hexes, mid_nodes], axis=1)])[0].min(axis=1)


def gradient(weights: np.ndarray, cofactors: np.ndarray) -> np.ndarray:
    """Compute the gradient of a function of the coefficients by the positions of all 27 nodes.

    Parameters
    ----------
    weights : (k, 216) float64
        Derivatives of the function by the coefficients.
    cofactors : (k, 3, 3, 216) float64
        Of `coefficients`.

    Returns
    -------
    (k, 27, 3) float64
    """
    by_jacobian = (weights @ _TO_COEFFICIENTS)[:, None, None] * cofactors
    return (by_jacobian.reshape(-1, 648) @ _DERIVATIVES.T).reshape(-1, 3, 27).transpose(0, 2, 1)
