"""Bends of feature curves whose nodes must not slide, and the sliding boundary with these as corners."""

from __future__ import annotations

import numpy as np

from hexmend.boundary.classification import Boundary, NodeClass, boundary_of
from hexmend.boundary.edges import edge_keys
from hexmend.boundary.feature_edges.features import FEATURE_ANGLE, FeatureAngle, marked_corners
from hexmend.boundary.skin_faces import skin_faces
from hexmend.mesh.mesh import Mesh
from hexmend.quality import corner_determinants


def boundary_with_kept_corners(mesh: Mesh, feature_angle: FeatureAngle = FEATURE_ANGLE) -> Boundary:
    """Classify the original boundary of a mesh for sliding, with `bend_corners` as corners.

    Parameters
    ----------
    mesh : Mesh
        Its `surface_points` define the original boundary.
    feature_angle : float or "auto"
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
        As of `boundary_of`.

    Returns
    -------
    (k,) int
        Numbers of nodes, ascending.
    """
    skin = skin_faces(mesh)
    sides_ahead = np.stack([boundary.faces, np.roll(boundary.faces, -1, axis=1)], axis=-1)
    on_curve = np.isin(edge_keys(sides_ahead, mesh.n_nodes), edge_keys(boundary.segments, mesh.n_nodes))
    before = np.roll(on_curve, 1, axis=1)
    before[:, 3] |= on_curve[:, 1] & (boundary.faces[:, 2] == boundary.faces[:, 3])  # a triangle's last corner
    at = on_curve & before & (boundary.node_class[boundary.faces] == NodeClass.CURVE)
    face, place = np.nonzero(at)
    nodes, open_ = boundary.faces[face, place], np.zeros(face.size, dtype=bool)
    for hexes in skin.hexes[face].T:  # an interface has a hex on both sides
        there = np.flatnonzero(hexes >= 0)
        sigma = corner_determinants(mesh.points, mesh.elements, hexes[there])
        corner = (mesh.elements[hexes[there]] == nodes[there, None]).argmax(axis=1)
        open_[there] |= sigma[np.arange(there.size), corner] > 0
    return np.unique(nodes[open_])
