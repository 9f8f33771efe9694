"""Inverted corner tetrahedra of a mesh, those that fixed nodes lock, and nodes that are far away."""

from __future__ import annotations

import numpy as np

from hexmend.energy.hex_energy import pack_corners, unpack_corners
from hexmend.mesh.edge_length import shortest_edges
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, corner_determinants
from hexmend.quality.measure import locked_tetrahedra

#: An inner node is far away if the shortest edge of its inverted hexes is longer than this, in mean edge lengths.
FAR_NODE_FACTOR = 10.0


def recentre_far_nodes(mesh: Mesh, quality: ElementQuality) -> np.ndarray:
    """Move inner nodes of inverted hexes that are far from all their neighbours to the mean of the neighbours.

    While delta is large, a node far away would pull all others towards it.

    Parameters
    ----------
    mesh : Mesh
    quality : ElementQuality
        Of its hexes.

    Returns
    -------
    (n, 3) float64
        All points; the mesh's own array where no node is far away.
    """
    size = shortest_edges(mesh.points, mesh.elements[quality.inverted])
    far = np.isfinite(size) & (size > FAR_NODE_FACTOR * mesh.mean_edge_length)
    points, motion = mesh.points, mesh.linear_motion
    movable = mesh.free & mesh.interior
    if motion is not None:
        movable |= mesh.free & motion.marks(mesh.n_nodes)
    for node in np.flatnonzero(far & movable):
        ring = mesh.topology.rings[node]
        ring = ring[~far[ring]]
        if ring.size:
            points = points.copy() if points is mesh.points else points
            points[node] = mesh.points[ring].mean(axis=0)
    return points if points is mesh.points else mesh.constrained(points)


def inverted_corners(points: np.ndarray, hexes: np.ndarray, quality: ElementQuality) -> np.ndarray:
    """Mark the corner tetrahedra with sigma <= 0.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    quality : ElementQuality
        Of these hexes at these points.

    Returns
    -------
    (m,) uint8
        Bit t set: corner tetrahedron t of the hex is inverted.
    """
    return corners_of_inverted(points, hexes, np.flatnonzero(quality.inverted))


def corners_of_inverted(points: np.ndarray, hexes: np.ndarray, where: np.ndarray) -> np.ndarray:
    """Mark the corner tetrahedra with sigma <= 0 of the hexes `where` (k,), as `inverted_corners`.

    Their qualities, which large meshes do not keep, are not measured again for it.

    Returns
    -------
    (m,) uint8
        As of `inverted_corners`.
    """
    bits = np.zeros(len(hexes), np.uint8)
    inverted = ~(corner_determinants(points, hexes, where) > 0)
    bits[where] = pack_corners(inverted)
    return bits


def locked_corners(mesh: Mesh, quality: ElementQuality) -> np.ndarray:
    """Mark the corner tetrahedra that fixed nodes lock in inversion, (m,) uint8, bits as in `inverted_corners`."""
    return pack_corners(locked_tetrahedra(mesh.points, mesh.elements, mesh.fixed, quality.inverted))


def count_inverted(
    points: np.ndarray,
    hexes: np.ndarray,
    omitted: np.ndarray,
    where: np.ndarray,
    sizes: np.ndarray | float = 1.0,
) -> tuple[int, float]:
    """Count hexes that have an inverted corner, and find the least determinant of these corners.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    omitted : (m,) uint8
        Corners that do not count, bits as in `inverted_corners`.
    where : (k,) int
        Hexes that are inverted.
    sizes : (m,) float64 or float
        Lengths to whose cubes determinants are relative; see `MeshEnergy.hex_sizes`.

    Returns
    -------
    count : int
    least : float
        0 where no corner is inverted.
    """
    sigma = np.where(unpack_corners(omitted[where]), np.inf, corner_determinants(points, hexes, where))
    inverted = ~(sigma > 0)
    volumes = np.broadcast_to(np.power(sizes, 3), len(hexes))[where]
    return int(np.count_nonzero(inverted.any(axis=1))), float((sigma / volumes[:, None]).min(initial=0.0))
