"""Bends of feature curves that must not slide: they are corners of the boundary that nodes slide on."""

from __future__ import annotations

import numpy as np

from hexmend.boundary.classification import Boundary, NodeClass, boundary_of
from hexmend.boundary.features import DEGREES, given_corners
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh
from hexmend.quality import corner_determinants


def sliding_boundary(mesh: Mesh, degrees: float = DEGREES) -> Boundary:
    """The boundary as the nodes of a mesh slide on it: of the surface that the mesh keeps, its bends being corners.

    Parameters
    ----------
    mesh : Mesh
    degrees : float
        See `boundary_of`.
    """
    original = mesh.with_points(mesh.surface_points)
    boundary = boundary_of(original, degrees)
    bends = kept_bends(original, boundary)
    if not bends.size:
        return boundary
    return boundary_of(original, degrees, corners=np.concatenate([given_corners(mesh), bends]))


def kept_bends(mesh: Mesh, boundary: Boundary) -> np.ndarray:
    """Nodes of curves that had better not slide, (k,) int: of a face with both edges at the node on the curve.

    The bend of the curve at such a node is all that holds the hex's corner open: on one straight segment with its
    neighbours it would be flat for good, sigma being 0 and its derivative along the curve too. Where the corner is
    inverted as it is, the node may as well slide.
    """
    hexes, sides = np.nonzero(mesh.topology.face_neighbours < 0)
    ahead = _keys(boundary.faces, np.roll(boundary.faces, -1, axis=1), mesh.n_nodes)
    on_curve = np.isin(ahead, _keys(*boundary.segments.T, mesh.n_nodes))
    at = on_curve & np.roll(on_curve, 1, axis=1) & (boundary.kind[boundary.faces] == NodeClass.CURVE)
    face, place = np.nonzero(at)
    sigma = corner_determinants(mesh.points, mesh.hexes, hexes[face])
    corner = FACES[sides[face], place]
    return np.unique(boundary.faces[face, place][sigma[np.arange(face.size), corner] > 0])


def _keys(one: np.ndarray, other: np.ndarray, n: int) -> np.ndarray:
    return np.minimum(one, other).astype(np.int64) * n + np.maximum(one, other)
