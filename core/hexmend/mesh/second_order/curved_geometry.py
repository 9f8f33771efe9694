"""Points of the curved faces of second-order hexes, and all nodes of faces and hexes.

Coordinates run from 0 to 1 along the first edge and along the last edge of a quad. Its nodes are numbered as VTK
numbers types 23 (8 nodes) and 28 (9 nodes)::

    3 -- 6 -- 2
    |         |
    7    8    5        0 to 3 corners, 4 to 7 midpoints of edges, 8 centre
    |         |
    0 -- 4 -- 1
"""

from __future__ import annotations

import numpy as np

from hexmend.errors import MeshError
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.second_order.mid_node_lookup import EDGE_COLUMNS

#: Coordinates of the nodes of a quad, (9, 2).
QUAD_POSITIONS = np.array(
    [[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0], [1, 0.5], [0.5, 1], [0, 0.5], [0.5, 0.5]], dtype=np.float64
)

#: Weights of the nodes 0 to 7 at the centre of a serendipity quad, (8,).
_CENTRE = np.array([-0.25] * 4 + [0.5] * 4)

#: Columns of `mid_nodes` of the nodes 4 to 8 of each of `FACES`, (6, 5).
FACE_COLUMNS = np.column_stack([EDGE_COLUMNS[FACES, np.roll(FACES, -1, axis=1)], np.arange(12, 18)])


def quad_functions(at: np.ndarray, width: int) -> tuple[np.ndarray, np.ndarray]:
    """Evaluate the shape functions of second-order quads: serendipity of 8 nodes, Lagrange of 9.

    Parameters
    ----------
    at : (k, 2) float64
        Points of evaluation, in coordinates of the unit square.
    width : int
        Number of nodes, 8 or 9.

    Returns
    -------
    values : (k, width) float64
    gradients : (k, width, 2) float64
        Derivatives with respect to the coordinates.

    Notes
    -----
    Zienkiewicz and Taylor, *The Finite Element Method*, volume 1. Serendipity functions are those of Lagrange whose
    centre is the point that the other nodes determine.
    """
    x, c = 2 * np.asarray(at, dtype=np.float64)[:, None] - 1, 2 * QUAD_POSITIONS - 1  # from -1 to 1
    factors = np.where(c == 0, 1 - x**2, x * (x + c) / 2)
    slopes = 2 * np.where(c == 0, -2 * x, x + c / 2)
    values, gradients = factors.prod(axis=2), slopes * factors[..., ::-1]
    if width == 9:
        return values, gradients
    return values[:, :8] + values[:, 8:] * _CENTRE, gradients[:, :8] + gradients[:, 8:] * _CENTRE[:, None]


def grid(divisions: int) -> np.ndarray:
    """Return the points of a regular grid of the unit square, ((divisions + 1)^2, 2), first coordinate fastest."""
    line = np.linspace(0.0, 1.0, divisions + 1)
    return np.stack(np.meshgrid(line, line, indexing="xy"), axis=-1).reshape(-1, 2)


def evaluate_quads(nodes: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Evaluate second-order quads at points of the unit square.

    Parameters
    ----------
    nodes : (k, 8, 3) or (k, 9, 3) float64
        Positions of the nodes of serendipity or of Lagrange quads.
    at : (g, 2) float64
        For example the points of a `grid`.

    Returns
    -------
    (k, g, 3) float64

    Raises
    ------
    MeshError
        If the quads have neither 8 nor 9 nodes.
    """
    # A product of small matrices for each element is ten times faster than one of large matrices.
    return quad_functions(at, _width(nodes))[0] @ nodes


def quad_nodes(points: np.ndarray, corners: np.ndarray, mid_nodes: np.ndarray) -> np.ndarray:
    """Return the positions of all nine nodes of quads.

    Parameters
    ----------
    points : (n, 3) float64
    corners : (k, 4) int32
    mid_nodes : (k, 5) int32
        Nodes 4 to 8, -1 where a quad has none. A missing midpoint of an edge is the mean of its ends, a missing centre
        that of the serendipity quad.

    Returns
    -------
    (k, 9, 3) float64
    """
    answer = points[np.concatenate([corners, mid_nodes], axis=1)]  # -1 takes the last point, which is replaced
    straight, central = mid_nodes[:, :4] < 0, mid_nodes[:, 4] < 0
    if straight.any():
        means = (answer[:, :4] + answer[:, [1, 2, 3, 0]]) / 2
        answer[:, 4:8] = np.where(straight[..., None], means, answer[:, 4:8])
    if central.all():
        answer[:, 8] = _CENTRE @ answer[:, :8]
    elif central.any():
        answer[central, 8] = _CENTRE @ answer[central, :8]
    return answer


def hex_nodes(points: np.ndarray, hexes: np.ndarray, mid_nodes: np.ndarray) -> np.ndarray:
    """Return the positions of all 27 nodes of hexes; missing nodes are placed as in the serendipity hex.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (k, 8) int32
    mid_nodes : (k, 19) int32
        As `Mesh.mid_nodes`; -1 where a hex has none.

    Returns
    -------
    (k, 27, 3) float64
    """
    answer = np.empty((len(hexes), 27, 3))
    answer[:, :8] = points[hexes]
    for face, columns in enumerate(FACE_COLUMNS):
        answer[:, 8 + columns] = quad_nodes(points, hexes[:, FACES[face]], mid_nodes[:, columns])[:, 4:]
    corners, edges, faces = (answer[:, part].sum(axis=1) for part in (slice(8), slice(8, 20), slice(20, 26)))
    missing = (mid_nodes[:, 18] < 0)[:, None]
    answer[:, 26] = np.where(missing, faces / 2 - edges / 4 + corners / 8, points[mid_nodes[:, 18]])
    return answer


def _width(nodes: np.ndarray) -> int:
    if nodes.ndim != 3 or nodes.shape[1] not in (8, 9) or nodes.shape[2] != 3:
        raise MeshError(f"nodes of quads have shape {nodes.shape}: expected (quads, 8 or 9, 3)")
    return nodes.shape[1]
