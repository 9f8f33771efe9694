"""Quality of faces as OpenFOAM's checkMesh measures it: non-orthogonality, skewness, weights, volume ratios.

Source: OpenFOAM, `primitiveMeshTools.C` (faceOrthogonality, faceSkewness, boundaryFaceSkewness, faceFlatness) and
`polyMeshTools.C` (faceWeights, volRatio). Written with the letters used there: d joins the centres of owner and
neighbour, S is the area vector.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.mesh.solid_cells import face_nodes
from hexmend.quality.finite_volume.geometry import CellGeometry, chunks, cross, divide, dot, norm


@dataclass(frozen=True, eq=False)
class FaceQuality:
    """Quality of every face of a mesh, each once.

    Parameters
    ----------
    owner, neighbour : (f,) int32
        Hexes at the face; the owner has the lower number, the neighbour is -1 on the boundary.
    non_orthogonality : (f,) float64
        Angle between d and S in degrees, from 0 to 180; 0 on the boundary, where OpenFOAM computes none.
    skewness : (f,) float64
        Distance of the face's centre from the point where d meets its plane, over the extent of the face in that
        direction.
    weight : (f,) float64
        Smaller share of owner or neighbour in the distance of the centres along S, at most 1/2; 1/2 on the boundary.
    volume_ratio : (f,) float64
        Volume of the smaller hex over that of the larger, 0 for volumes of different sign; 1 on the boundary.
    flatness : (f,) float64
        |S| over the sum of the areas of the face's four triangles: 1 for a flat face.
    """

    owner: np.ndarray
    neighbour: np.ndarray
    non_orthogonality: np.ndarray
    skewness: np.ndarray
    weight: np.ndarray
    volume_ratio: np.ndarray
    flatness: np.ndarray

    @property
    def internal(self) -> np.ndarray:
        """True for faces between two hexes, (f,) bool."""
        return self.neighbour >= 0


def face_quality(geometry: CellGeometry, hexes: np.ndarray, face_neighbours: np.ndarray) -> FaceQuality:
    """Measure the quality of every face.

    Parameters
    ----------
    geometry : CellGeometry
    hexes : (m, 8) int32
    face_neighbours : (m, 6) int32
        See `hexmend.mesh.topology.Topology.face_neighbours`.

    Returns
    -------
    FaceQuality
    """
    owned = (face_neighbours < 0) | (np.arange(len(hexes), dtype=np.int32)[:, None] < face_neighbours)
    owner, side = np.nonzero(owned)
    neighbour = face_neighbours[owner, side]
    values = np.empty((5, owner.size))
    for part in chunks(owner.size):
        corners = geometry.points[:, face_nodes(hexes, owner[part], side[part]).T]
        values[:, part] = _measure(geometry, corners, owner[part], side[part], neighbour[part])
    return FaceQuality(owner.astype(np.int32), neighbour, *values)


def worst_of_hexes(quality: FaceQuality, values: np.ndarray, n_hexes: int, better: int) -> np.ndarray:
    """Find the worst value over the faces of each hex.

    Parameters
    ----------
    quality : FaceQuality
    values : (f,) float64
        A value for each face.
    n_hexes : int
    better : int
        1 if higher values are better, -1 if lower ones are.

    Returns
    -------
    (n_hexes,) float64
    """
    worst = np.full(n_hexes, better * np.inf)
    internal = quality.internal
    choose = np.minimum if better > 0 else np.maximum
    choose.at(worst, quality.owner, values)
    choose.at(worst, quality.neighbour[internal], values[internal])
    return worst


def _measure(
    geometry: CellGeometry, corners: np.ndarray, owner: np.ndarray, side: np.ndarray, neighbour: np.ndarray
) -> np.ndarray:
    """Measure faces with these corners (3, 4, k), the fields of `FaceQuality` from the third on, (5, k)."""
    centre, area = geometry.face_centres[:, side, owner], geometry.face_areas[:, side, owner]
    own = geometry.centres[:, owner]
    internal = neighbour >= 0
    size = norm(area)
    to_face = centre - own
    # On the boundary d is as if a mirrored cell were beyond: half of it, along the normal.
    normal = divide(area, size, 0.0)
    d = np.where(internal, geometry.centres[:, neighbour] - own, normal * dot(normal, to_face))
    length, along = norm(d), dot(area, d)
    cosine = np.where(internal, divide(along, length * size, 0.0), 1.0)
    angle = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
    before, beyond = np.abs(dot(area, to_face)), np.abs(dot(area, geometry.centres[:, neighbour] - centre))
    weight = np.where(internal, divide(np.minimum(before, beyond), before + beyond, 0.0), 0.5)
    v, w = geometry.volumes[owner], geometry.volumes[neighbour]
    share = divide(np.minimum(np.abs(v), np.abs(w)), np.maximum(np.abs(v), np.abs(w)), 0.0)
    ratio = np.where(internal, np.where((v > 0) == (w > 0), share, 0.0), 1.0)
    skewness = _skewness(corners - centre[:, None], to_face, d, divide(dot(area, to_face), along, np.inf), internal)
    return np.stack([angle, skewness, weight, ratio, _flatness(corners, centre, size)])


def _skewness(
    corners: np.ndarray, to_face: np.ndarray, d: np.ndarray, share: np.ndarray, internal: np.ndarray
) -> np.ndarray:
    """Skewness of faces, (k,): the corners (3, 4, k) from the face's centre, `share` of d where it meets the plane."""
    sound = np.isfinite(share)
    with np.errstate(over="ignore", invalid="ignore"):
        offset = to_face - np.where(sound, share, 0.0) * d
        distance = norm(offset)
        direction = divide(offset, distance, 0.0)
        extent = np.abs(dot(direction[:, None], corners)).max(axis=0)
        extent = np.maximum(extent, np.where(internal, 0.2, 0.4) * norm(d))
        skewness = divide(distance, extent, np.inf)
    return np.where(sound & (extent > 0), skewness, np.inf)


def _flatness(corners: np.ndarray, centre: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Flatness of faces, (k,), with triangles around the face's centre; 1 for a face without area."""
    towards = centre[:, None] - corners
    triangles = norm(cross(np.roll(corners, -1, axis=1) - corners, towards)).sum(axis=0) / 2
    return np.minimum(divide(size, triangles, 1.0), 1.0)
