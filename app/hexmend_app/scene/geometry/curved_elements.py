"""Curved edges, faces and hexes of second order, evaluated at points of the reference element."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.second_order import MID_EDGES, NODE_POSITIONS, lagrange
from hexmend.mesh.second_order.curved_geometry import quad_functions


def edge_mid_nodes(hexes: np.ndarray, mid_nodes: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Return the mid-nodes of edges.

    Parameters
    ----------
    hexes : (m, 8) int32
    mid_nodes : (m, 19) int32
    edges : (e, 2) int
        Nodes at the ends of edges of any cells.

    Returns
    -------
    (e,) int64
        -1 for edges without a mid-node.
    """
    if not len(edges) or not len(hexes):
        return np.full(len(edges), -1)
    nodes = int(max(hexes.max(), np.max(edges))) + 1
    end = np.zeros(nodes, dtype=bool)
    end[edges] = True
    near = np.flatnonzero(end[hexes].sum(axis=1) > 1)
    ends, middles = hexes[near][:, MID_EDGES].reshape(-1, 2).astype(np.int64), mid_nodes[near, :12].ravel()
    known = np.unique(np.column_stack([ends.min(axis=1) * nodes + ends.max(axis=1), middles]), axis=0)
    known = known[known[:, 1] >= 0]
    wanted = np.asarray(edges, dtype=np.int64)
    wanted = wanted.min(axis=1) * nodes + wanted.max(axis=1)
    if not len(known):
        return np.full(len(edges), -1)
    at = np.minimum(np.searchsorted(known[:, 0], wanted), len(known) - 1)
    return np.where(known[at, 0] == wanted, known[at, 1], -1)


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
    return weights @ np.concatenate([ends, middles[:, None]], axis=1)


def quad_normals(nodes: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Compute unit normals of second-order quads at points of the unit square.

    A normal points to the side from which the nodes are counter-clockwise. Where the map is singular, as at a collapsed
    edge, it is the normal of the quad of the corners; (0, 0, 0) if that has no area either. Parameters are those
    of `evaluate_quads`.

    Returns
    -------
    (k, g, 3) float64
    """
    gradients = quad_functions(at, nodes.shape[1])[1]
    normals = _cross(gradients[..., 0] @ nodes, gradients[..., 1] @ nodes)
    lengths = np.sqrt(np.einsum("kgx,kgx->kg", normals, normals))
    singular = lengths <= 1e-9 * lengths.max(axis=1, initial=0.0)[:, None]
    if singular.any():
        quads = np.flatnonzero(singular.any(axis=1))
        flat = _cross(nodes[quads, 2] - nodes[quads, 0], nodes[quads, 3] - nodes[quads, 1])
        normals[quads] = np.where(singular[quads, :, None], flat[:, None], normals[quads])
        lengths[quads] = np.linalg.norm(normals[quads], axis=2)
    normals /= np.where(lengths > 0, lengths, 1.0)[..., None]
    return normals


def evaluate_hexes(nodes: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Evaluate second-order hexes of 27 nodes, (k, 27, 3), at points of the unit cube, (g, 3); returns (k, g, 3)."""
    return lagrange(at, NODE_POSITIONS)[0] @ nodes


def jacobian_field(nodes: np.ndarray, divisions: int = 16) -> tuple[np.ndarray, np.ndarray]:
    """Compute positions and det J on a regular grid of the unit cube, of one hex.

    Parameters
    ----------
    nodes : (8, 3) or (27, 3) float64
        Corners, or all nodes of the second order as `hexmend.mesh.second_order.curved_geometry.hex_nodes` has them.
    divisions : int

    Returns
    -------
    positions : (d + 1, d + 1, d + 1, 3) float64
        First index along x.
    determinants : (d + 1, d + 1, d + 1) float64
        In the cube of the nodes' unit of length.
    """
    t = np.linspace(0.0, 1.0, divisions + 1)
    if len(nodes) == 27:
        values = np.column_stack([(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)])
        slopes = np.column_stack([4 * t - 3, 4 - 8 * t, 4 * t - 1])
    else:
        values, slopes = np.column_stack([1 - t, t]), np.tile([-1.0, 1.0], (len(t), 1))
    order = np.lexsort(NODE_POSITIONS[: len(nodes)].T[::-1])
    lattice = nodes[order].reshape(*[values.shape[1]] * 3, 3)

    def evaluate(*along: np.ndarray) -> np.ndarray:
        return np.einsum("ia,jb,kc,abcx->ijkx", *along, lattice, optimize=True)

    gradients = [evaluate(*(slopes if axis == other else values for other in range(3))) for axis in range(3)]
    return evaluate(values, values, values), np.linalg.det(np.stack(gradients, axis=-2))


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return cross products of vectors, (..., 3), several times faster than NumPy."""
    answer = np.empty(np.broadcast_shapes(a.shape, b.shape))
    for x, (y, z) in enumerate(((1, 2), (2, 0), (0, 1))):
        np.subtract(a[..., y] * b[..., z], a[..., z] * b[..., y], out=answer[..., x])
    return answer
