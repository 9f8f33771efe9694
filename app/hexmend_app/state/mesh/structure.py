"""Structure of a mesh: irregular edges and nodes, at which its regular blocks join, and sharp boundary edges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.mesh.mesh import Mesh

#: Default dihedral angle, in degrees, beyond which a boundary edge is sharp.
SHARP_DEGREES = 30.0


@dataclass(frozen=True, eq=False)
class MeshStructure:
    """Irregular edges and nodes of a mesh, and its sharp boundary edges.

    Parameters
    ----------
    interior : (k, 2) int32
        Nodes of the irregular interior edges; see `hexmend.mesh.topology.Topology.irregular_edges`.
    interior_valence : (k,) int32
        Number of hexes around each.
    nodes : (j,) int64
        Interior nodes at which irregular interior edges end or fork.
    boundary : (b, 2) int32
        Nodes of the irregular boundary edges at which the boundary is smooth: those without exactly two hexes. (Sharp
        edges are expected to have one hex if convex, three if concave.)
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


def find_structure(mesh: Mesh) -> MeshStructure:
    """Find the irregular edges and nodes of a mesh.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    MeshStructure

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
    return MeshStructure(
        edges[inside], valence[inside], topology.irregular_nodes, edges[smooth], valence[smooth], sharp
    )


def sharp_edges(points: np.ndarray, faces: np.ndarray, degrees: float = SHARP_DEGREES) -> np.ndarray:
    """Find edges at which two faces meet at an angle, or which have one face or more than two.

    Parameters
    ----------
    points : (n, 3) float64
    faces : (k, 4) int32
        Consistently oriented faces.
    degrees : float
        Dihedral angle beyond which an edge is sharp.

    Returns
    -------
    (e, 2) int32
        Nodes of each edge, lower node first.
    """
    corners = points[faces]
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
    return edges_at_an_angle(faces, normals.repeat(4, axis=0), degrees)


def edges_at_an_angle(faces: np.ndarray, normals: np.ndarray, degrees: float) -> np.ndarray:
    """Find edges as `sharp_edges` does, by the normal of each face at each of its edges, (4 k, 3) float64."""
    edges = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    key = _key(edges, int(faces.max(initial=0)) + 1)
    key[edges[:, 0] == edges[:, 1]] = -1  # triangles repeat their last node
    order = np.argsort(key, kind="stable")
    first = np.flatnonzero(np.diff(key[order], prepend=-1))
    count = np.diff(first, append=len(key))
    pair = order[first], order[np.minimum(first + 1, len(key) - 1)]
    turned = np.einsum("ij,ij->i", normals[pair[0]], normals[pair[1]]) < np.cos(np.radians(degrees))
    return edges[order[first[turned | (count != 2)]]]


def _key(edges: np.ndarray, n: int) -> np.ndarray:
    """Unique numbers of edges (k, 2) of n nodes, lower node first."""
    return edges[:, 0].astype(np.int64) * n + edges[:, 1]
