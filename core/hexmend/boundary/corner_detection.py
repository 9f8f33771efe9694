"""Bends of feature curves whose nodes must not slide, and the sliding boundary with these as corners."""

from __future__ import annotations

import numpy as np

from hexmend.boundary.classification import Boundary, NodeClass, boundary_of
from hexmend.boundary.edges import edge_keys
from hexmend.boundary.features import FEATURE_ANGLE, marked_corners
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh
from hexmend.quality import corner_determinants


def boundary_with_kept_corners(mesh: Mesh, feature_angle: float = FEATURE_ANGLE) -> Boundary:
    """Classify the original boundary of a mesh for sliding, with `bend_corners` as corners.

    Parameters
    ----------
    mesh : Mesh
        Its `surface_points` define the original boundary.
    feature_angle : float
        Dihedral angle beyond which an edge is a feature; see `boundary_of`.

    Returns
    -------
    Boundary
    """
    original = mesh.with_points(mesh.surface_points)
    boundary = boundary_of(original, feature_angle)
    corners = bend_corners(original, boundary)
    if not corners.size:
        return boundary
    return boundary_of(original, feature_angle, corners=np.concatenate([marked_corners(mesh), corners]))


def bend_corners(mesh: Mesh, boundary: Boundary) -> np.ndarray:
    """Find curve nodes at which both edges of one face lie on the curve.

    Only the bend of the curve keeps such a corner of a hex open: with its neighbours on one straight segment sigma
    would be 0, and so would its derivative along the curve. Nodes at which the corner is inverted already may slide.

    Parameters
    ----------
    mesh : Mesh
    boundary : Boundary
        Boundary of the mesh.

    Returns
    -------
    (k,) int
        Numbers of nodes, ascending.
    """
    hexes, sides = np.nonzero(mesh.topology.face_neighbours < 0)
    sides_ahead = np.stack([boundary.faces, np.roll(boundary.faces, -1, axis=1)], axis=-1)
    on_curve = np.isin(edge_keys(sides_ahead, mesh.n_nodes), edge_keys(boundary.segments, mesh.n_nodes))
    at = on_curve & np.roll(on_curve, 1, axis=1) & (boundary.node_class[boundary.faces] == NodeClass.CURVE)
    face, place = np.nonzero(at)
    sigma = corner_determinants(mesh.points, mesh.hexes, hexes[face])
    corner = FACES[sides[face], place]
    return np.unique(boundary.faces[face, place][sigma[np.arange(face.size), corner] > 0])
