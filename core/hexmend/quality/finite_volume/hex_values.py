"""Worst values of the faces of each hex, for metrics."""

from __future__ import annotations

import weakref
from collections.abc import Callable, Mapping
from typing import Any

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
        return _values(points, hexes, quality, lambda: Topology(hexes, len(points)))[field]

    return of


def of_mesh(field: str) -> Callable[[Mesh, ElementQuality], np.ndarray]:
    """Make the function for `Metric.of_mesh` of a field of `FaceQuality`, which uses the mesh's topology."""

    def of(mesh: Mesh, quality: ElementQuality) -> np.ndarray:
        return _values(mesh.points, mesh.hexes, quality, lambda: mesh.topology)[field]

    return of


class _LastValues:
    """The values that were computed last, kept as long as their mesh lives: the four metrics share the computation."""

    def __init__(self) -> None:
        self._of: tuple[weakref.ref[Any], ...] = ()
        self._values: Mapping[str, np.ndarray] = {}

    def get(self, *arrays: object) -> Mapping[str, np.ndarray] | None:
        """Return the values of these arrays; None for others."""
        of, values = self._of, self._values
        same = len(of) == len(arrays) and all(ref() is array for ref, array in zip(of, arrays, strict=True))
        return values if same else None

    def keep(self, values: Mapping[str, np.ndarray], *arrays: object) -> None:
        """Keep the values of these arrays until one of them is gone."""
        self._of, self._values = (), values
        self._of = tuple(weakref.ref(array, self._forget) for array in arrays)

    def _forget(self, gone: weakref.ref[Any]) -> None:
        if gone in self._of:
            self._of, self._values = (), {}


_LAST = _LastValues()


def _values(
    points: np.ndarray, hexes: np.ndarray, quality: ElementQuality | None, topology: Callable[[], Topology]
) -> Mapping[str, np.ndarray]:
    """The worst value over the faces of each hex, (m,) float64, by the field of `FaceQuality`."""
    immutable = quality is not None and not any(array.flags.writeable for array in (points, hexes))
    known = _LAST.get(points, hexes, quality) if immutable else None
    if known is None:
        faces = face_quality(cell_geometry(points, hexes), hexes, topology().face_neighbours)
        known = {
            name: worst_of_hexes(faces, getattr(faces, name), len(hexes), better) for name, better in _FIELDS.items()
        }
        if immutable:
            _LAST.keep(known, points, hexes, quality)
    return known
