"""Curved edges of second-order hexes, divided into short lines for drawing, and sharp ones among them."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order.curved_geometry import QUAD_POSITIONS, quad_nodes
from hexmend.mesh.second_order.mid_node_lookup import face_mid_nodes
from hexmend_app.scene.geometry.curved_elements import edge_mid_nodes, edge_middles, evaluate_edges, quad_normals
from hexmend_app.state.mesh.inspection import all_mid_nodes
from hexmend_app.state.mesh.structure import SHARP_DEGREES, edges_at_an_angle

#: Number of lines into which an edge is divided.
DIVISIONS = 8


class CurvedEdges:
    """Divides curved edges into lines.

    Parameters
    ----------
    mesh : Mesh
        Mesh with mid-nodes; its positions are not used.
    edges : (e, 2) int
        Nodes at the ends of edges of hexes.
    """

    def __init__(self, mesh: Mesh, edges: np.ndarray):
        self._edges, self._mids = edges, edge_mid_nodes(mesh.hexes, mesh.mid_nodes, edges)

    def places(self, points: np.ndarray) -> np.ndarray:
        """Return the points of all lines, (e (DIVISIONS + 1), 3), edge by edge, for node positions (n, 3)."""
        middles = edge_middles(points, self._edges, self._mids)
        return divided(points[self._edges], middles).reshape(-1, 3)

    @property
    def chains(self) -> np.ndarray:
        """Indices of the points of each edge from end to end, (e, DIVISIONS + 1) int64."""
        return np.arange(len(self._edges) * (DIVISIONS + 1)).reshape(-1, DIVISIONS + 1)


def divided(ends: np.ndarray, middles: np.ndarray) -> np.ndarray:
    """Return points from end to end of curved edges, (e, DIVISIONS + 1, 3).

    Parameters
    ----------
    ends : (e, 2, 3) float64
    middles : (e, 3) float64
    """
    return evaluate_edges(ends, middles, np.linspace(0.0, 1.0, DIVISIONS + 1))


def segments(chains: np.ndarray) -> np.ndarray:
    """Return the pairs of consecutive points of chains, (e, d + 1) int64, as ((d e), 2)."""
    return np.stack([chains[:, :-1], chains[:, 1:]], axis=-1).reshape(-1, 2)


def sharp_curved_edges(mesh: Mesh, degrees: float = SHARP_DEGREES) -> np.ndarray:
    """Find edges of the boundary at which two curved faces meet at an angle, or which have one face or more than two.

    The angle is that of the faces' normals at the middle of the edge.

    Parameters
    ----------
    mesh : Mesh
        Mesh with mid-nodes.
    degrees : float
        Angle beyond which an edge is sharp.

    Returns
    -------
    (e, 2) int32
        Nodes of each edge, lower node first.
    """
    faces, owners = mesh.topology.boundary_faces, np.nonzero(mesh.topology.face_neighbours < 0)[0]
    nodes = quad_nodes(mesh.points, faces, face_mid_nodes(mesh.elements, all_mid_nodes(mesh), owners, faces))
    return edges_at_an_angle(faces, quad_normals(nodes, QUAD_POSITIONS[4:8]).reshape(-1, 3), degrees)
