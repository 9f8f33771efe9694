"""Locked hexes that sliding of the boundary can free."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import mask
from hexmend.boundary.feature_edges.features import FEATURE_ANGLE, FeatureAngle
from hexmend.boundary.sliding import SlidingBoundary
from hexmend.boundary.sliding.flat_parts import flat_parts
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import corner_tetrahedra
from hexmend.quality import corner_determinants


def freed_by_sliding(mesh: Mesh, locked: np.ndarray, feature_angle: FeatureAngle = FEATURE_ANGLE) -> np.ndarray:
    """Find locked hexes that may become valid once boundary nodes slide.

    A corner tetrahedron with sigma <= 0 stays inverted if its nodes are all fixed, all lie on one flat patch, or three
    of them lie on one straight curve: sliding cannot make sigma positive.

    Parameters
    ----------
    mesh : Mesh
    locked : (m,) bool
        Locked hexes; see `hexmend.quality.locked`.
    feature_angle : float or "auto"
        Dihedral angle beyond which an edge is a feature; see `boundary_of`.

    Returns
    -------
    (m,) bool
    """
    freed, where = locked.copy(), np.flatnonzero(locked)
    if where.size:
        freed[where] = ~_stays_inverted(SlidingBoundary(mesh, feature_angle), mesh.points, where)
    return freed


def _stays_inverted(sliding: SlidingBoundary, points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Find those of some hexes (k,) at points (n, 3) that have a corner which stays inverted wherever nodes slide."""
    mesh = sliding.mesh
    tetrahedra = corner_tetrahedra(mesh.elements[hexes])  # (k, 8, 4)
    blocked = mesh.fixed[tetrahedra].all(axis=2)
    for part in flat_parts(sliding.points, sliding.boundary, mesh.mean_edge_length):
        most = part.directions.shape[1] + 1  # nodes of a valid tetrahedron on a plane, and on a line
        blocked |= mask(part.nodes, mesh.n_nodes)[tetrahedra].sum(axis=2) > most
    inverted = ~(corner_determinants(points, mesh.elements, hexes) > 0)
    return (blocked & inverted).any(axis=1)
