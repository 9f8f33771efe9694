"""Second-order hexahedra: numbering of their mid-nodes, which follow the corners, and their Jacobians.

Numbered as VTK numbers types 25 (20 nodes) and 29 (27 nodes), after the corners 0 to 7::

    8 to 19    midpoints of the edges 01 12 23 30, 45 56 67 74, 04 15 26 37
    20 to 25   centres of the faces x-, x+, y-, y+, z-, z+
    26         centre of the hex

`mid_nodes` (m, 19) int32 holds nodes 8 to 26 of each hex, -1 where it has none.

Shape functions of second-order hexes and their derivatives, in coordinates of the unit cube.

Zienkiewicz and Taylor, *The Finite Element Method*, volume 1: serendipity functions of 20 nodes, Lagrange of 27.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from hexmend.mesh.hexahedron import FACES, UNIT_CUBE


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


#: Edges of nodes 8 to 19, (12, 2).
MID_EDGES = np.array(
    [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]], dtype=np.int64
)

#: Positions of nodes 8 to 26 in the unit cube, (19, 3).
MID_NODE_POSITIONS = np.concatenate(
    [UNIT_CUBE[MID_EDGES].mean(axis=1), UNIT_CUBE[FACES].mean(axis=1), UNIT_CUBE.mean(axis=0)[None]]
)

#: Trilinear weights of the corners at nodes 8 to 26, (19, 8).
MID_NODE_WEIGHTS = np.prod(
    np.where(UNIT_CUBE[None] == 1, MID_NODE_POSITIONS[:, None], 1 - MID_NODE_POSITIONS[:, None]), axis=2
)

#: Permutation of nodes 8 to 26 in a hex whose lower and upper face are exchanged.
MIRRORED_MID_NODES = np.array([4, 5, 6, 7, 0, 1, 2, 3, 8, 9, 10, 11, 12, 13, 14, 15, 17, 16, 18])

#: Positions of all 27 nodes, and of the 3 x 3 x 3 Gauss points, in the unit cube.
NODE_POSITIONS = np.concatenate([UNIT_CUBE, MID_NODE_POSITIONS])
_GAUSS_ABSCISSAE = np.array([0.5 - np.sqrt(0.15), 0.5, 0.5 + np.sqrt(0.15)])
GAUSS_POINTS = np.stack(
    np.meshgrid(_GAUSS_ABSCISSAE, _GAUSS_ABSCISSAE, _GAUSS_ABSCISSAE, indexing="ij"), axis=-1
).reshape(-1, 3)

#: Number of hexes whose Jacobians are computed at a time.
_CHUNK_HEXES = 1 << 15


def move_mid_nodes(before: np.ndarray, after: np.ndarray, hexes: np.ndarray, mid_nodes: np.ndarray) -> np.ndarray:
    """Move the mid-nodes of second-order hexes with the corners.

    A mid-node is displaced by the trilinear interpolation of its corners' displacements: a hex that is moved as a whole
    keeps its shape, and a mid-node whose corners stay does not move.

    Parameters
    ----------
    before, after : (n, 3) float64
        Node positions; of `after` only the corners are read.
    hexes : (m, 8) int32
    mid_nodes : (m, 19) int32

    Returns
    -------
    (n, 3) float64
        Copy of `after` with the mid-nodes moved.
    """
    answer, displacement = after.copy(), after - before
    for column, weights in enumerate(MID_NODE_WEIGHTS):
        chosen = np.flatnonzero(mid_nodes[:, column] >= 0)
        nodes, used = mid_nodes[chosen, column], np.flatnonzero(weights)
        moves = np.einsum("c,kcx->kx", weights[used], displacement[hexes[chosen][:, used]])
        # Hexes that share a node agree on it up to rounding; the first of them is written last.
        answer[nodes[::-1]] = (before[nodes] + moves)[::-1]
    return answer


def corners_of_mid_nodes(marks: np.ndarray, hexes: np.ndarray, mid_nodes: np.ndarray) -> np.ndarray:
    """Mark the corners with which marked mid-nodes move: they stay if these do.

    Parameters
    ----------
    marks : (n,) bool
        Nodes.
    hexes : (m, 8) int32
    mid_nodes : (m, 19) int32

    Returns
    -------
    (n,) bool
    """
    corners = np.zeros(marks.size, dtype=bool)
    for column, weights in enumerate(MID_NODE_WEIGHTS):
        nodes = mid_nodes[:, column]
        corners[hexes[(nodes >= 0) & marks[nodes]][:, weights > 0]] = True
    return corners


def jacobian_range(
    points: np.ndarray, hexes: np.ndarray, mid_nodes: np.ndarray, *, nodes: bool = True, gauss: bool = True
) -> np.ndarray:
    """Compute the least and the greatest Jacobian determinant of second-order hexes.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    mid_nodes : (m, 19) int32
    nodes, gauss : bool
        Whether it is taken at the nodes, and at the points of the 3 x 3 x 3 Gauss rule.

    Returns
    -------
    (m, 2) float64
        In the cube of the unit of the points; NaN for hexes with neither 20 nor 27 nodes.
    """
    answer = np.full((len(hexes), 2), np.nan)
    for some, maps in _derivatives(points, hexes, mid_nodes, nodes=nodes, gauss=gauss):
        found = np.array([np.linalg.det(columns) for columns in maps])
        answer[some] = np.column_stack([found.min(axis=0), found.max(axis=0)])
    return answer


def _derivatives(
    points: np.ndarray, hexes: np.ndarray, mid_nodes: np.ndarray, *, nodes: bool, gauss: bool
) -> Iterator[tuple[np.ndarray, Iterator[np.ndarray]]]:
    """Numbers of some second-order hexes (k,), and the derivatives of the position at each place, (k, 3, 3) by rows."""
    more = (mid_nodes >= 0).sum(axis=1)
    for width, functions in ((20, serendipity), (27, lagrange)):
        places = [NODE_POSITIONS[:width]] * nodes + [GAUSS_POINTS] * gauss
        gradients = functions(np.concatenate(places), NODE_POSITIONS[:width])[1]
        chosen = np.flatnonzero(more == width - 8)
        for some in np.split(chosen, range(_CHUNK_HEXES, len(chosen), _CHUNK_HEXES)):
            x = points[np.column_stack([hexes[some], mid_nodes[some, : width - 8]])]
            yield some, (gradient.T @ x for gradient in gradients)
