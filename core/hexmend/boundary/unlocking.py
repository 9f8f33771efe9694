"""Locked hexes that sliding of the boundary can free."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import mask
from hexmend.boundary.classification import Boundary
from hexmend.boundary.features import FEATURE_ANGLE
from hexmend.boundary.sliding import SlidingBoundary
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.mesh.mesh import Mesh
from hexmend.quality import corner_determinants

#: Largest distance of nodes from the plane of a flat patch or the line of a straight curve, in mean edge lengths.
_FLATNESS_TOLERANCE = 1e-9


def freed_by_sliding(mesh: Mesh, locked: np.ndarray, feature_angle: float = FEATURE_ANGLE) -> np.ndarray:
    """Find locked hexes that may become valid once boundary nodes slide.

    A corner tetrahedron with sigma <= 0 stays inverted if its nodes are all fixed, all lie on one flat patch, or three
    of them lie on one straight curve: sliding cannot make sigma positive.

    Parameters
    ----------
    mesh : Mesh
    locked : (m,) bool
        Locked hexes; see `hexmend.quality.locked`.
    feature_angle : float
        Dihedral angle beyond which an edge is a feature; see `boundary_of`.

    Returns
    -------
    (m,) bool
    """
    freed = locked.copy()
    where = np.flatnonzero(locked)
    if not where.size:
        return freed
    sliding = SlidingBoundary(mesh, feature_angle)
    tetrahedra = mesh.hexes[where][:, CORNER_TETRAHEDRA]  # (k, 8, 4)
    blocked = sliding.mesh.fixed[tetrahedra].all(axis=2)
    for nodes, most in _flat_parts(mesh, sliding.boundary):
        blocked |= mask(nodes, mesh.n_nodes)[tetrahedra].sum(axis=2) > most
    inverted = ~(corner_determinants(mesh.points, mesh.hexes, where) > 0)
    freed[where] = ~(blocked & inverted).any(axis=1)
    return freed


def _flat_parts(mesh: Mesh, boundary: Boundary) -> list[tuple[np.ndarray, int]]:
    """Nodes of each flat patch and straight curve, and how many of a valid tetrahedron may lie on it: 3 and 2."""
    found = []
    kinds = (boundary.faces, boundary.patch_of_face, 2), (boundary.segments, boundary.curve_of_segment, 1)
    for pieces, part, dimensions in kinds:
        order = np.argsort(part, kind="stable")
        starts = np.flatnonzero(np.diff(part[order])) + 1
        for of_part in np.split(pieces[order], starts) if part.size else ():
            nodes = np.unique(of_part)
            x = mesh.points[nodes] - mesh.points[nodes].mean(axis=0)
            least = np.linalg.eigh(x.T @ x)[1][:, : 3 - dimensions]  # the directions in which they extend least
            if np.abs(x @ least).max() <= _FLATNESS_TOLERANCE * mesh.mean_edge_length:
                found.append((nodes, dimensions + 1))
    return found
