"""Positions of boundary nodes on their patches and curves at which locked hexes are sound."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hexmend.arrays import index_of, mask
from hexmend.boundary.sliding import SlidingBoundary
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA, EDGES, FACES
from hexmend.mesh.mesh import Mesh

#: Minimum scaled Jacobian of a hex that is free.
SOUND = 0.01
#: Steps of the search, and length of the first and the last of them in edges.
_STEPS, _FIRST_STEP, _LAST_STEP = 200, 0.15, 0.005
#: Steps after which the search ends if it frees no further hex.
_PATIENCE = 150
#: Sharpness of the smooth minimum over the corners of a hex, and of the weights of hexes.
_SHARPNESS, _HEX_SHARPNESS = 20.0, 15.0
#: Scaled Jacobian from which hexes are left as they are, and below which nodes move by whole steps.
_GOOD, _POOR = 0.35, 0.1
#: Least length by which a vector is divided.
_TINY = 1e-150


class FreePositions(NamedTuple):
    """Positions at which locked hexes are sound.

    Parameters
    ----------
    points : (n, 3) float64
        Of all nodes of the mesh, where most of the hexes are sound.
    free : (k,) bool
        True for hexes that are sound there, or at another step, while none around them is inverted that was not before.
    """

    points: np.ndarray
    free: np.ndarray


def find_free_positions(mesh: Mesh, sliding: SlidingBoundary, hexes: np.ndarray) -> FreePositions:
    """Search positions of nodes at which locked hexes are sound, by steps that raise the worst corners.

    The nodes of these hexes move: those of the boundary on their patches and curves, fixed ones stay. No face of the
    boundary is turned over. What is found is a proof that sliding frees a hex; what is not found is none that it
    does not.

    Parameters
    ----------
    mesh : Mesh
    sliding : SlidingBoundary
        Of the mesh.
    hexes : (k,) int

    Returns
    -------
    FreePositions
    """
    given = sliding.mesh.points
    free, best, most = np.zeros(len(hexes), dtype=bool), given, 0
    if not len(hexes):
        return FreePositions(best, free)
    search = _Search(mesh, sliding, hexes)
    x, since = given[search.nodes].copy(), 0
    for step in np.geomspace(_FIRST_STEP, _LAST_STEP, _STEPS):
        values, slopes = _soft_minimum(x[search.hexes])
        found = search.free(x, values.min(axis=1))
        since = 0 if (found & ~free).any() else since + 1
        free |= found
        if found.sum() > most:
            most, best = int(found.sum()), given.copy()
            best[search.nodes] = x
        if free.all() or since > _PATIENCE:
            break
        x = search.stepped(x, step, values.min(axis=1), slopes)
    return FreePositions(best, free)


class _Search:
    """Hexes around those that are to be freed, in numbers of their own nodes, and what their nodes may do."""

    def __init__(self, mesh: Mesh, sliding: SlidingBoundary, hexes: np.ndarray):
        region = np.flatnonzero(mesh.topology.hexes_around(hexes, 1))
        self.nodes = np.unique(mesh.hexes[region])
        self.hexes = index_of(self.nodes, mesh.n_nodes)[mesh.hexes[region]]
        self._sliding, self._wanted = sliding, np.searchsorted(region, hexes)
        self._moves = (mask(mesh.hexes[hexes], mesh.n_nodes) & ~sliding.mesh.fixed)[self.nodes]
        self._slides = sliding.slides(self.nodes) & self._moves
        x = sliding.mesh.points[self.nodes]
        ends = x[self.hexes][:, EDGES]
        self._edge = np.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=2).mean(axis=1)
        self._size = np.full(self.nodes.size, np.inf)
        np.minimum.at(self._size, self.hexes.ravel(), np.repeat(self._edge, 8))
        self._normals = _outward(mesh, region, sliding)
        self._turned = _turned(x[self.hexes], self._normals)
        self._sound = _soft_minimum(x[self.hexes])[0].min(axis=1) > 0
        self._counts = self._sound | mask(self._wanted, len(region))

    def free(self, x: np.ndarray, least: np.ndarray) -> np.ndarray:
        """Mark the hexes to be freed that are sound, and have no node of a hex that is so no more, (k,) bool."""
        turned = (_turned(x[self.hexes], self._normals) & ~self._turned).any(axis=1)
        lost = mask(self.hexes[turned | (self._sound & ~(least > 0))], self.nodes.size)
        return (least[self._wanted] > SOUND) & ~lost[self.hexes[self._wanted]].any(axis=1)

    def stepped(self, x: np.ndarray, step: float, least: np.ndarray, slopes: np.ndarray) -> np.ndarray:
        """Positions (j, 3) after a step along the slopes (r, 8, 3) of the hexes, the worst with the largest weight."""
        weights = np.exp(-_HEX_SHARPNESS * least) * (self._counts & (least < _GOOD)) * self._edge
        direction = np.zeros_like(x)
        np.add.at(direction, self.hexes.ravel(), (slopes * weights[:, None, None]).reshape(-1, 3))
        size = np.linalg.norm(direction, axis=1)
        length = np.minimum(1.0, size / np.exp(-_HEX_SHARPNESS * _POOR)) * self._moves * step * self._size
        x = x + direction * (length / np.maximum(size, _TINY))[:, None]
        if self._slides.any():
            x[self._slides] = self._sliding.project(x[self._slides], self.nodes[self._slides])
        return x


def _soft_minimum(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Scaled Jacobian of the corners of hexes (k, 8, 3), (k, 8), and the gradient of a smooth minimum of them."""
    edges = x[:, CORNER_TETRAHEDRA[:, 1:]] - x[:, CORNER_TETRAHEDRA[:, :1]]
    length = np.maximum(np.linalg.norm(edges, axis=3, keepdims=True), _TINY)
    units = edges / length
    crosses = np.stack([np.cross(units[:, :, (i + 1) % 3], units[:, :, (i + 2) % 3]) for i in range(3)], axis=2)
    values = np.einsum("kci,kci->kc", units[:, :, 0], crosses[:, :, 0])
    weights = np.exp(-_SHARPNESS * (values - values.min(axis=1, keepdims=True)))
    weights /= weights.sum(axis=1, keepdims=True)
    slopes = weights[:, :, None, None] * (crosses - values[:, :, None, None] * units) / length
    gradient = np.zeros_like(x)
    for corner, (apex, *others) in enumerate(CORNER_TETRAHEDRA):
        gradient[:, apex] -= slopes[:, corner].sum(axis=1)
        gradient[:, others] += slopes[:, corner]
    return values, gradient


def _outward(mesh: Mesh, hexes: np.ndarray, sliding: SlidingBoundary) -> np.ndarray:
    """Outward normals of the original boundary at the faces of hexes, 0 for faces inside, (k, 6, 3)."""
    normals = np.zeros((mesh.n_hexes, 6, 3))
    at = np.argwhere(mesh.topology.face_neighbours < 0)
    normals[at[:, 0], at[:, 1]] = sliding.outward[: len(at)]  # the faces of the boundary come first
    return normals[hexes]


def _turned(x: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Mark the faces of hexes (k, 8, 3) that look against their normals (k, 6, 3), (k, 6) bool."""
    quads = x[:, FACES]
    area = np.cross(quads[:, :, 2] - quads[:, :, 0], quads[:, :, 3] - quads[:, :, 1])
    return np.einsum("kfi,kfi->kf", area, normals) < 0
