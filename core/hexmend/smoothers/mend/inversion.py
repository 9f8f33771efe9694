"""What of a mesh is tangled, what of that fixed nodes lock, and nodes that are far away."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.optimise.maxmin.corner_values import shortest_edges
from hexmend.quality import ElementQuality, corner_determinants, measure
from hexmend.quality.measure import locked_tetrahedra

#: From how many mean edge lengths of its shortest edge on an inner node is far away: it begins amid its neighbours.
FAR = 10.0


def brought_near(mesh: Mesh, figures: ElementQuality) -> np.ndarray:
    """The points of a mesh, those nodes of its inverted hexes amid their neighbours that are far from them all, (n, 3).

    From far away such a node would draw the others after it for as long as delta is large.
    """
    size = shortest_edges(mesh.points, mesh.hexes[figures.inverted])
    far = np.isfinite(size) & (size > FAR * mesh.mean_edge_length)
    points = mesh.points
    for node in np.flatnonzero(far & mesh.free & ~mesh.topology.boundary):
        ring = mesh.topology.rings[node]
        ring = ring[~far[ring]]
        if ring.size:
            points = points.copy() if points is mesh.points else points
            points[node] = mesh.points[ring].mean(axis=0)
    return points


def inverted_corners(points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """A bit for each corner tetrahedron with sigma <= 0, (m,) uint8."""
    bits = np.zeros(len(hexes), np.uint8)
    where = np.flatnonzero(measure(points, hexes).inverted)
    inverted = ~(corner_determinants(points, hexes, where) > 0)
    bits[where] = np.packbits(inverted, axis=1, bitorder="little")[:, 0]
    return bits


def locked_corners(mesh: Mesh) -> np.ndarray:
    """A bit for each corner tetrahedron that fixed nodes lock in inversion, (m,) uint8."""
    inverted = measure(mesh.points, mesh.hexes).inverted
    locked = locked_tetrahedra(mesh.points, mesh.hexes, mesh.fixed, inverted)
    return np.packbits(locked, axis=1, bitorder="little")[:, 0]


def tangled_in(
    points: np.ndarray, hexes: np.ndarray, left_out: np.ndarray, figures: ElementQuality
) -> tuple[int, float]:
    """How many hexes have an inverted corner that is not left out, and the least determinant of those corners.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    left_out : (m,) uint8
        A bit for each corner, as of `inverted_corners`.
    figures : ElementQuality
        Of these hexes.

    Returns
    -------
    int, float
        The determinant in the cube of the points' unit of length; 0 where no such corner is inverted.
    """
    where = np.flatnonzero(figures.inverted)
    counts = np.unpackbits(left_out[where, None], axis=1, bitorder="little") == 0
    sigma = np.where(counts, corner_determinants(points, hexes, where), np.inf)
    inverted = ~(sigma > 0)
    return int(np.count_nonzero(inverted.any(axis=1))), float(sigma.min(initial=0.0))
