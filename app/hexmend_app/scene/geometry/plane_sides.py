"""Sides of planes on which hexes lie, computed in a single thread because the UI thread waits for the result."""

from __future__ import annotations

import numpy as np

from hexmend.errors import MeshError
from hexmend.kernels import clip_planes
from hexmend.mesh.mesh import Mesh
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
    kept, eightfold = np.full(len(hexes), not notch), np.empty(len(hexes))
    for normal, offset in zip(normals, offsets, strict=True):
        clip_planes.centre_heights(points, hexes, normal[None], eightfold)
        before = eightfold <= 8 * offset
        kept = kept | before if notch else kept & before
    return kept


def centre_heights(points: np.ndarray, hexes: np.ndarray, normal: np.ndarray) -> tuple[np.ndarray, float]:
    """Return eight times the heights of the centres of hexes along a normal, (m,) float64.

    `centres_kept` compares them with eight times the offset of a plane. Also returns the largest extent of a hex along
    the normal.

    Parameters are those of `centres_kept`; normal is (3,).
    """
    points, hexes, normal, _ = _checked(points, hexes, normal[None], np.zeros(1))
    eightfold = np.empty(len(hexes))
    return eightfold, clip_planes.centre_heights(points, hexes, normal, eightfold)


def opened(mesh: Mesh, eightfold: np.ndarray, extent: float, offset: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the faces between hexes whose centres are before a plane and beyond it.

    Parameters
    ----------
    mesh : Mesh
    eightfold : (m,) float64
    extent : float
        Results of `centre_heights`.
    offset : float
        Of the plane.

    Returns
    -------
    quads : (k, 4) int32
        Nodes of the faces, counter-clockwise as seen from beyond the plane.
    hexes : (k,) int32
        Hex before the plane.
    """
    eightfold = as_reals(eightfold, "eightfold")
    return clip_planes.opened(mesh.hexes, mesh.topology.face_neighbours, eightfold, extent, offset)


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
