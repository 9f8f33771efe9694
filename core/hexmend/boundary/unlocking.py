"""Which locked hexes can be freed where the boundary slides."""

from __future__ import annotations

import numpy as np

from hexmend.boundary.classification import Boundary
from hexmend.boundary.features import DEGREES
from hexmend.boundary.sliding import SlidingBoundary
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.mesh.mesh import Mesh
from hexmend.quality import corner_determinants

#: How far places of a flat patch may be from their plane, or of a straight curve from their line, in mean edge lengths.
_FLAT = 1e-9


def freed_by_sliding(mesh: Mesh, locked: np.ndarray, degrees: float = DEGREES) -> np.ndarray:
    """True for each locked hex that nothing holds in inversion any more once boundary nodes slide, (m,) bool.

    Held are corner tetrahedra with sigma <= 0 all of whose nodes are kept, or lie on one flat patch, or three of them
    on one straight curve: wherever these slide, sigma is not positive.

    Parameters
    ----------
    mesh : Mesh
    locked : (m,) bool
        As `hexmend.quality.locked` tells.
    degrees : float
        See `boundary_of`.
    """
    freed = locked.copy()
    where = np.flatnonzero(locked)
    if not where.size:
        return freed
    sliding = SlidingBoundary(mesh, degrees)
    tetrahedra = mesh.hexes[where][:, CORNER_TETRAHEDRA]  # (k, 8, 4)
    held = sliding.mesh.fixed[tetrahedra].all(axis=2)
    for nodes, most in _straight(mesh, sliding.boundary):
        on = np.zeros(mesh.n_nodes, dtype=bool)
        on[nodes] = True
        held |= on[tetrahedra].sum(axis=2) > most
    inverted = ~(corner_determinants(mesh.points, mesh.hexes, where) > 0)
    freed[where] = ~(held & inverted).any(axis=1)
    return freed


def _straight(mesh: Mesh, boundary: Boundary) -> list[tuple[np.ndarray, int]]:
    """Nodes of each flat patch and of each straight curve, and how many of a tetrahedron's may be on it: 3 and 2."""
    parts = [(boundary.faces, boundary.patch_of_face, boundary.n_patches, 2)]
    parts += [(boundary.segments, boundary.curve_of_segment, boundary.n_curves, 1)]
    found = []
    for pieces, part, count, dimensions in parts:
        if not count:
            continue
        order = np.argsort(part, kind="stable")
        starts = np.searchsorted(part[order], np.arange(1, count))
        for one in np.split(pieces[order], starts):
            nodes = np.unique(one)
            x = mesh.points[nodes] - mesh.points[nodes].mean(axis=0)
            least = np.linalg.eigh(x.T @ x)[1][:, : 3 - dimensions]  # the directions in which they extend least
            if np.abs(x @ least).max() <= _FLAT * mesh.mean_edge_length:
                found.append((nodes, dimensions + 1))
    return found
