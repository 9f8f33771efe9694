"""Worst values of the faces of each hex, for metrics."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from weakref import WeakKeyDictionary

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import Topology
from hexmend.mesh.validation import as_points_and_hexes
from hexmend.quality.finite_volume.face_quality import face_quality, worst_of_hexes
from hexmend.quality.finite_volume.geometry import cell_geometry
from hexmend.quality.measure import ElementQuality

#: Fields of `FaceQuality`, and their better end: 1 if higher values are better, -1 if lower ones are.
_FIELDS = {"non_orthogonality": -1, "skewness": -1, "weight": 1, "volume_ratio": 1}

#: Values of the mesh that was measured last, by its quality: all fields take hardly longer than one.
_LAST: WeakKeyDictionary[ElementQuality, Mapping[str, np.ndarray]] = WeakKeyDictionary()


def of_hexes(field: str, points: np.ndarray, hexes: np.ndarray, quality: ElementQuality) -> np.ndarray:
    """Return the worst values of a field of `FaceQuality`, for `Metric.of`; neighbours are those among the hexes."""
    points, hexes = as_points_and_hexes(points, hexes)
    return _values(points, hexes, quality, lambda: Topology(hexes, len(points)))[field]


def of_mesh(field: str, mesh: Mesh, quality: ElementQuality) -> np.ndarray:
    """Return the worst values of a field of `FaceQuality`, for `Metric.of_mesh`, by the mesh's topology."""
    return _values(mesh.points, mesh.hexes, quality, lambda: mesh.topology)[field]


def _values(
    points: np.ndarray, hexes: np.ndarray, quality: ElementQuality, topology: Callable[[], Topology]
) -> Mapping[str, np.ndarray]:
    """Worst value over the faces of each hex, (m,) float64, by the field of `FaceQuality`."""
    values = _LAST.get(quality)
    if values is None:
        faces = face_quality(cell_geometry(points, hexes), hexes, topology().face_neighbours)
        values = {name: worst_of_hexes(faces, getattr(faces, name), len(hexes), of) for name, of in _FIELDS.items()}
        _LAST.clear()
        _LAST[quality] = values
    return values
