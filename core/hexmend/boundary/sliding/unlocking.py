"""Locked hexes that sliding of the boundary can free, and hexes that stay inverted."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import mask
from hexmend.boundary.feature_edges.features import FEATURE_ANGLE, FeatureAngle
from hexmend.boundary.sliding import SlidingBoundary
from hexmend.boundary.sliding.flat_parts import flat_parts
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.mesh.mesh import Mesh
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
        freed[where] = ~stays_inverted(SlidingBoundary(mesh, feature_angle), mesh.points, where)
    return freed


def stays_inverted(sliding: SlidingBoundary, points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Find hexes with a corner that stays inverted wherever nodes slide; see `freed_by_sliding`.

    Parameters
    ----------
    sliding : SlidingBoundary
        On its own surface, not on a target: which parts are flat is seen from the nodes where it began.
    points : (n, 3) float64
        Node positions on that surface.
    hexes : (k,) int64
        Numbers of hexes.

    Returns
    -------
    (k,) bool
    """
    mesh = sliding.mesh
    tetrahedra = mesh.hexes[hexes][:, CORNER_TETRAHEDRA]  # (k, 8, 4)
    blocked = mesh.fixed[tetrahedra].all(axis=2)
    for part in flat_parts(sliding.points, sliding.boundary, mesh.mean_edge_length):
        most = part.directions.shape[1] + 1  # nodes of a valid tetrahedron on a plane, and on a line
        blocked |= mask(part.nodes, mesh.n_nodes)[tetrahedra].sum(axis=2) > most
    inverted = ~(corner_determinants(points, mesh.hexes, hexes) > 0)
    return (blocked & inverted).any(axis=1)
