"""Validity of hexes: whether det J, the determinant of the map from the unit cube, is positive everywhere in them.

A hex may be invalid although all its corners have a positive determinant. det J is a polynomial, whose values lie
between its least and greatest Bernstein coefficient: a hex counts as valid only where these prove it.

Johnen, Remacle, Geuzaine: Geometrical validity of curvilinear finite elements, J. Comput. Phys. 233 (2013); Johnen,
Weill, Remacle: Robust and efficient validation of the linear hexahedral element, Proc. Eng. 203 (2017).
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import IntEnum

import numpy as np

from hexmend.kernels import validity as kernels
from hexmend.mesh.second_order import NODE_POSITIONS
from hexmend.mesh.second_order.curved_geometry import hex_nodes
from hexmend.mesh.validation import as_points_and_hexes

#: Row of `NODE_POSITIONS` of each node of a lattice 3 x 3 x 3, x slowest and z fastest, as the kernels take them.
_LATTICE = np.lexsort(NODE_POSITIONS.T[::-1])

#: Second-order hexes whose nodes are gathered at a time.
_CHUNK = 1 << 12


class Validity(IntEnum):
    """Validity of a hex; all but VALID count as invalid."""

    VALID = 0
    #: det J is not positive at a corner.
    INVERTED = 1
    #: det J is positive at the corners, and not positive elsewhere.
    INVALID_INSIDE = 2
    #: det J is within rounding of 0, so that neither was shown.
    UNDECIDED = 3


def certify(points: np.ndarray, hexes: np.ndarray, mid_nodes: np.ndarray | None = None) -> np.ndarray:
    """Find the validity of hexes.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    mid_nodes : (at most m, 19) int32, optional
        As `Mesh.mid_nodes`, of the first cells: hexes that have some are judged by the map of the second order.

    Returns
    -------
    (m,) uint8
        Numbers of `Validity`.

    Raises
    ------
    MeshError
        For arrays of another shape or type, and for a node that does not exist.

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> certify(UNIT_CUBE, np.arange(8, dtype=np.int32)[None])
    array([0], dtype=uint8)
    """
    points, hexes = as_points_and_hexes(points, hexes)
    found = np.empty(len(hexes), dtype=np.uint8)
    kernels.certify(points, hexes, found)
    for some, nodes in _second_order(points, hexes, mid_nodes):
        part = np.empty(len(some), dtype=np.uint8)
        kernels.certify_quadratic(nodes, part)
        found[some] = part
    return found


def jacobian_bounds(points: np.ndarray, hexes: np.ndarray, mid_nodes: np.ndarray | None = None) -> np.ndarray:
    """Compute a lower bound of the least det J of each hex and an upper bound of the greatest.

    Parameters and errors are those of `certify`.

    Returns
    -------
    (m, 2) float64
        In the cube of the points' unit of length. Each is within a hundredth of the extreme, or within 1e-7 of the
        greatest coefficient.

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> jacobian_bounds(2 * UNIT_CUBE, np.arange(8, dtype=np.int32)[None])
    array([[8., 8.]])
    """
    points, hexes = as_points_and_hexes(points, hexes)
    bounds = np.empty((len(hexes), 2))
    kernels.jacobian_bounds(points, hexes, bounds)
    for some, nodes in _second_order(points, hexes, mid_nodes):
        part = np.empty((len(some), 2))
        kernels.jacobian_bounds_quadratic(nodes, part)
        bounds[some] = part
    return bounds


def least_jacobian(points: np.ndarray, hexes: np.ndarray, mid_nodes: np.ndarray | None = None) -> float:
    """Compute a lower bound of the least det J over the greatest of the same hex, of all hexes: from -1 to 1.

    Parameters and errors are those of `certify`. 1 for parallelepipeds; 0 or less if a hex is invalid.
    """
    points, hexes = as_points_and_hexes(points, hexes)
    if mid_nodes is None:
        return kernels.least_jacobian(points, hexes)
    is_linear = np.ones(len(hexes), dtype=bool)
    is_linear[: len(mid_nodes)] = (mid_nodes < 0).all(axis=1)
    linear = np.ascontiguousarray(hexes[is_linear])
    curved = (kernels.least_jacobian_quadratic(nodes) for _, nodes in _second_order(points, hexes, mid_nodes))
    return min((kernels.least_jacobian(points, linear), *curved))


def _second_order(
    points: np.ndarray, hexes: np.ndarray, mid_nodes: np.ndarray | None
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield the numbers of hexes with mid-nodes, (k,), in parts, and their nodes as the kernels take them, (k, 81)."""
    if mid_nodes is None:
        return
    which = np.flatnonzero((mid_nodes >= 0).any(axis=1))
    for first in range(0, len(which), _CHUNK):
        some = which[first : first + _CHUNK]
        yield some, hex_nodes(points, hexes[some], mid_nodes[some])[:, _LATTICE].reshape(-1, 81)
