"""Sides of planes on which hexes lie; single-threaded, because the window's thread calls it."""

from __future__ import annotations

import numpy as np

from hexmend.errors import MeshError
from hexmend.kernels import clip_planes
from hexmend.mesh.validation import as_hexes, as_points, as_reals


def centres_kept(
    points: np.ndarray, hexes: np.ndarray, normals: np.ndarray, offsets: np.ndarray, notch: bool
) -> np.ndarray:
    """Return True for each hex whose centre is not cut away, (m,) bool.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    normals : (k, 3) float64
    offsets : (k,) float64
        A point lies beyond a plane where x . normal > offset.
    notch : bool
        Cut away what lies beyond all planes; else what lies beyond one of them.

    Raises
    ------
    MeshError
        For arrays of another shape or type, and for a node that does not exist.
    """
    points, hexes, normals, offsets = _checked(points, hexes, normals, offsets)
    kept = np.empty(len(hexes), bool)
    clip_planes.centres_kept(points, hexes, normals, offsets, notch, kept)
    return kept


def touched(points: np.ndarray, hexes: np.ndarray, normals: np.ndarray, offsets: np.ndarray, notch: bool) -> np.ndarray:
    """Return the planes that visibly cross or touch each hex, (m, k) bool.

    A plane through nodes has hexes that only touch it on either side, and by rounding a node may lie here or there.
    Those of both sides are named, so that whoever cuts them can decide for each node once. A section is seen as far as
    the other planes leave it open: not where a hex lies wholly beyond one of them, or, with `notch`, wholly before.

    Parameters are those of `centres_kept`.
    """
    points, hexes, normals, offsets = _checked(points, hexes, normals, offsets)
    answer = np.empty((len(hexes), len(offsets)), bool)
    clip_planes.touched(points, hexes, normals, offsets, notch, answer.ravel())
    return answer


def _checked(
    points: np.ndarray, hexes: np.ndarray, normals: np.ndarray, offsets: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    points, normals, offsets = as_points(points), as_points(normals, "normals"), as_reals(offsets, "offsets")
    if offsets.shape != (len(normals),):
        raise MeshError(f"offsets have shape {offsets.shape}: expected ({len(normals)},), one for each plane")
    return points, as_hexes(hexes, len(points)), normals, offsets
