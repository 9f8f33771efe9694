"""Points and normals of the curved faces of second-order hexes, and points inside the hexes.

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
from hexmend.mesh.second_order.mid_nodes import NODE_POSITIONS
from hexmend.mesh.second_order.shape_functions import lagrange

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
    return _weighted(quad_functions(at, _width(nodes))[0], nodes)


def quad_normals(nodes: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Compute unit normals of second-order quads at points of the unit square.

    A normal points to the side from which the nodes are counter-clockwise. Where the map is singular, as at a collapsed
    edge, it is the normal of the quad of the corners; (0, 0, 0) if that has no area either. Parameters and errors are
    those of `evaluate_quads`.

    Returns
    -------
    (k, g, 3) float64
    """
    gradients = quad_functions(at, _width(nodes))[1]
    normals = _cross(_weighted(gradients[..., 0], nodes), _weighted(gradients[..., 1], nodes))
    lengths = np.sqrt(np.einsum("kgx,kgx->kg", normals, normals))
    singular = lengths <= 1e-9 * lengths.max(axis=1, initial=0.0)[:, None]
    if singular.any():
        quads = np.flatnonzero(singular.any(axis=1))
        flat = _cross(nodes[quads, 2] - nodes[quads, 0], nodes[quads, 3] - nodes[quads, 1])
        normals[quads] = np.where(singular[quads, :, None], flat[:, None], normals[quads])
        lengths[quads] = np.linalg.norm(normals[quads], axis=2)
    normals /= np.where(lengths > 0, lengths, 1.0)[..., None]
    return normals


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
    """Return the positions of all 27 nodes of hexes; missing ones are those of the serendipity hex.

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


def evaluate_hexes(nodes: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Evaluate second-order hexes of 27 nodes, (k, 27, 3), at points of the unit cube, (g, 3); returns (k, g, 3)."""
    return _weighted(lagrange(at, NODE_POSITIONS)[0], nodes)


def evaluate_edges(ends: np.ndarray, middles: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Evaluate edges of three nodes.

    Parameters
    ----------
    ends : (e, 2, 3) float64
    middles : (e, 3) float64
    at : (g,) float64
        From 0 at the first end to 1 at the second.

    Returns
    -------
    (e, g, 3) float64
    """
    weights = np.column_stack([(1 - at) * (1 - 2 * at), at * (2 * at - 1), 4 * at * (1 - at)])
    return _weighted(weights, np.concatenate([ends, middles[:, None]], axis=1))


def edge_middles(points: np.ndarray, edges: np.ndarray, mid_nodes: np.ndarray) -> np.ndarray:
    """Return the positions of the mid-nodes of edges; a missing one is the mean of the ends.

    Parameters
    ----------
    points : (n, 3) float64
    edges : (..., 2) int
    mid_nodes : (...) int
        -1 where an edge has none.

    Returns
    -------
    (..., 3) float64
    """
    return np.where((mid_nodes < 0)[..., None], points[edges].mean(axis=-2), points[mid_nodes])


def _width(nodes: np.ndarray) -> int:
    if nodes.ndim != 3 or nodes.shape[1] not in (8, 9) or nodes.shape[2] != 3:
        raise MeshError(f"nodes of quads have shape {nodes.shape}: expected (quads, 8 or 9, 3)")
    return nodes.shape[1]


def _weighted(weights: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    """Return the sums of positions, (k, w, 3), with weights, (g, w), as (k, g, 3)."""
    return weights @ nodes  # a product of small matrices for each element, ten times faster than one of large matrices


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return cross products of vectors, (..., 3), several times faster than NumPy."""
    answer = np.empty(np.broadcast_shapes(a.shape, b.shape))
    for x, (y, z) in enumerate(((1, 2), (2, 0), (0, 1))):
        np.subtract(a[..., y] * b[..., z], a[..., z] * b[..., y], out=answer[..., x])
    return answer
