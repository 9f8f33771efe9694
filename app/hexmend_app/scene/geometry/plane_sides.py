"""Sides of planes on which hexes lie, computed in a single thread because the UI thread waits for the result."""

from __future__ import annotations

import numpy as np

from hexmend.errors import MeshError
from hexmend.kernels import clip_planes
from hexmend.mesh.validation import as_hexes, as_points, as_reals


def centres_kept(
    points: np.ndarray, hexes: np.ndarray, normals: np.ndarray, offsets: np.ndarray, notch: bool
) -> np.ndarray:
    """Return True for hexes whose centres are not cut away, (m,) bool.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    normals : (k, 3) float64
    offsets : (k,) float64
        A point x lies beyond a plane if x . normal > offset.
    notch : bool
        Cut away points beyond all planes instead of points beyond any plane.

    Raises
    ------
    MeshError
        If an array has a wrong shape or type, or a hex has a node that does not exist.
    """
    points, hexes, normals, offsets = _checked(points, hexes, normals, offsets)
    kept = np.empty(len(hexes), bool)
    clip_planes.centres_kept(points, hexes, normals, offsets, notch, kept)
    return kept


def touched(points: np.ndarray, hexes: np.ndarray, normals: np.ndarray, offsets: np.ndarray, notch: bool) -> np.ndarray:
    """Return True for pairs of a hex and a plane that visibly cross or touch, (m, k) bool.

    If a plane contains nodes, the hexes on both sides touch it, because rounding decides the side of these nodes; the
    caller must treat each node consistently. Pairs whose section the other planes cut away are False: the hex lies
    entirely beyond another plane or, with `notch`, entirely in front of another plane.

    Parameters are those of `centres_kept`.
    """
    points, hexes, normals, offsets = _checked(points, hexes, normals, offsets)
    touching = np.empty((len(hexes), len(offsets)), bool)
    clip_planes.touched(points, hexes, normals, offsets, notch, touching.ravel())
    return touching


def _checked(
    points: np.ndarray, hexes: np.ndarray, normals: np.ndarray, offsets: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    points, normals, offsets = as_points(points), as_points(normals, "normals"), as_reals(offsets, "offsets")
    if offsets.shape != (len(normals),):
        raise MeshError(f"offsets have shape {offsets.shape}: expected ({len(normals)},), one for each plane")
    return points, as_hexes(hexes, len(points)), normals, offsets
