"""Chains of boundary edges: the shortest between two nodes, and the marked curve through a node."""

from __future__ import annotations

import numpy as np

from hexmend.boundary.edges import SurfaceEdges
from hexmend.boundary.feature_edges.features import dihedral_angles
from hexmend.boundary.marking import marked_segments
from hexmend.errors import MeshError
from hexmend.mesh.mesh import Mesh

#: Dihedral angle in degrees at which an edge counts half its length: chains follow creases.
_CREASE = 15.0


def edge_path(mesh: Mesh, start: int, end: int) -> tuple[int, ...]:
    """Find the shortest chain of boundary edges between two nodes; sharp edges count as shorter.

    Parameters
    ----------
    mesh : Mesh
    start, end : int
        Nodes of the boundary.

    Returns
    -------
    tuple of int
        Nodes of the chain, from `start` to `end`.

    Raises
    ------
    MeshError
        For a node that is not on the boundary, and for nodes of two parts of it.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> cube = make("cube", size=27)
    >>> corner, other = (int(np.abs(cube.points - x).sum(axis=1).argmin()) for x in ([0, 0, 0], [1, 0, 0]))
    >>> len(edge_path(cube, corner, other))
    4
    """
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import dijkstra

    for node in (start, end):
        if not (0 <= node < mesh.n_nodes and mesh.topology.boundary[node]):
            raise MeshError(f"node {node} (counted from 0) is not on the boundary: expected a node of a boundary face")
    edges = SurfaceEdges(mesh.topology.boundary_faces, mesh.n_nodes)
    points = mesh.surface_points
    length = np.linalg.norm(points[edges.nodes[:, 1]] - points[edges.nodes[:, 0]], axis=1)
    weight = length / (1 + dihedral_angles(points, edges) / _CREASE)
    graph = csr_array((weight, edges.nodes.T), shape=(mesh.n_nodes, mesh.n_nodes))
    _, before = dijkstra(graph, directed=False, indices=start, return_predecessors=True)
    if end != start and before[end] < 0:
        raise MeshError(f"no edges of the boundary join the nodes {start} and {end}: choose two nodes of one surface")
    chain = [end]
    while chain[-1] != start:
        chain.append(int(before[chain[-1]]))
    return tuple(reversed(chain))


def curve_through(mesh: Mesh, node: int) -> tuple[int, ...]:
    """Find the marked curve through a node: a chain that ends where marked edges end or branch.

    Parameters
    ----------
    mesh : Mesh
    node : int

    Returns
    -------
    tuple of int
        Nodes of the chain in order; the first node again at the end of a closed one; empty if no edge is marked there.
    """
    neighbours: dict[int, list[int]] = {}
    for one, other in marked_segments(mesh).tolist():
        neighbours.setdefault(one, []).append(other)
        neighbours.setdefault(other, []).append(one)
    chain = [node]
    for _ in range(2):  # to one end, then from there to the other
        chain = _walk(neighbours, list(reversed(chain)))
        if len(chain) > 2 and chain[0] == chain[-1]:
            break
    return tuple(chain) if len(chain) > 1 else ()


def _walk(neighbours: dict[int, list[int]], chain: list[int]) -> list[int]:
    """Extend a chain at its end along marked edges, until these end, branch or lead back to its begin."""
    while True:
        node, at = chain[-1], neighbours.get(chain[-1], [])
        if len(chain) > 1 and (len(at) != 2 or node == chain[0]):
            return chain
        onward = [other for other in at if len(chain) < 2 or other != chain[-2]]
        if not onward:
            return chain
        chain.append(onward[0])
