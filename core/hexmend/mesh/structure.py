"""The structure of a mesh: where its regular blocks join, and where its boundary is sharp."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.mesh.mesh import Mesh

#: Neighbouring faces whose normals differ by more than this, in degrees, meet in a sharp edge.
SHARP_DEGREES = 30.0


@dataclass(frozen=True, eq=False)
class Structure:
    """The edges and nodes of a mesh that are not as in a grid.

    Parameters
    ----------
    interior : (k, 2) int32
        Nodes of the irregular interior edges, see `hexmend.mesh.topology.Topology.irregular_edges`.
    interior_valence : (k,) int32
        Number of hexes around each.
    nodes : (j,) int64
        Interior nodes at which irregular interior edges end or fork.
    boundary : (b, 2) int32
        Nodes of the boundary edges that not two hexes are around although the boundary is smooth there. (A sharp edge
        wants one hex if it is convex, three if it is concave.)
    boundary_valence : (b,) int32
        Number of hexes around each.
    sharp : (s, 2) int32
        Nodes of the boundary's sharp edges.
    """

    interior: np.ndarray
    interior_valence: np.ndarray
    nodes: np.ndarray
    boundary: np.ndarray
    boundary_valence: np.ndarray
    sharp: np.ndarray


def find_structure(mesh: Mesh) -> Structure:
    """Find the structure of a mesh; what depends on its connectivity alone is kept in its topology.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> found = find_structure(make("five-side", size=40))
    >>> set(found.interior_valence.tolist()), len(found.boundary)
    ({5}, 0)
    """
    topology = mesh.topology
    edges, valence = topology.edges, topology.edge_valence
    sharp = sharp_edges(mesh.points, topology.boundary_faces)
    inside, outside = topology.irregular_edges, topology.irregular_boundary_edges
    smooth = outside[~np.isin(_key(edges[outside], mesh.n_nodes), _key(sharp, mesh.n_nodes))]
    return Structure(
        edges[inside], valence[inside], topology.irregular_nodes, edges[smooth], valence[smooth], sharp
    )  # fmt: skip


def sharp_edges(points: np.ndarray, faces: np.ndarray, degrees: float = SHARP_DEGREES) -> np.ndarray:
    """Edges in which two faces meet at an angle, or one or more than two faces meet at all, (e, 2) of nodes.

    Parameters
    ----------
    points : (n, 3) float64
    faces : (k, 4) int32
        All counter-clockwise from the same side.
    degrees : float
        Angle between the normals of two faces beyond which their edge is sharp.
    """
    edges = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    key = _key(edges, len(points))
    order = np.argsort(key, kind="stable")
    first = np.flatnonzero(np.diff(key[order], prepend=-1))
    count = np.diff(first, append=len(key))
    corners = points[faces]
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
    pair = order[first] // 4, order[np.minimum(first + 1, len(key) - 1)] // 4
    turned = np.einsum("ij,ij->i", normals[pair[0]], normals[pair[1]]) < np.cos(np.radians(degrees))
    return edges[order[first[turned | (count != 2)]]]


def _key(edges: np.ndarray, n: int) -> np.ndarray:
    """One number for each edge (k, 2) of n nodes, lower node first."""
    return edges[:, 0].astype(np.int64) * n + edges[:, 1]
