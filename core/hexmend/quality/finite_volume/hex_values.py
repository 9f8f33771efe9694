"""Worst values of the faces of each hex, for metrics."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import Topology
from hexmend.mesh.validation import as_hexes, as_points
from hexmend.quality.finite_volume.face_quality import face_quality, worst_of_hexes
from hexmend.quality.finite_volume.geometry import cell_geometry
from hexmend.quality.measure import ElementQuality

#: Fields of `FaceQuality`, and their better end: 1 if higher values are better, -1 if lower ones are.
_FIELDS = {"non_orthogonality": -1, "skewness": -1, "weight": 1, "volume_ratio": 1}


def of_hexes(field: str) -> Callable[[np.ndarray, np.ndarray, ElementQuality], np.ndarray]:
    """Make the function for `Metric.of` of a field of `FaceQuality`; neighbours are those among the given hexes."""

    def of(points: np.ndarray, hexes: np.ndarray, quality: ElementQuality) -> np.ndarray:
        points = as_points(points)
        hexes = as_hexes(hexes, len(points))
        return _values(field, points, hexes, Topology(hexes, len(points)))

    return of


def of_mesh(field: str) -> Callable[[Mesh, ElementQuality], np.ndarray]:
    """Make the function for `Metric.of_mesh` of a field of `FaceQuality`, which uses the mesh's topology."""

    def of(mesh: Mesh, quality: ElementQuality) -> np.ndarray:
        return _values(field, mesh.points, mesh.hexes, mesh.topology)

    return of


def _values(field: str, points: np.ndarray, hexes: np.ndarray, topology: Topology) -> np.ndarray:
    """Worst value of a field of `FaceQuality` over the faces of each hex, (m,) float64."""
    faces = face_quality(cell_geometry(points, hexes), hexes, topology.face_neighbours)
    return worst_of_hexes(faces, getattr(faces, field), len(hexes), _FIELDS[field])
