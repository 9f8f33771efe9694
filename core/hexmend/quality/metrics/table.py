"""The metrics of `metrics.json` and their functions: by kernels, by the faces of finite volumes, and of the target.

A range without a bound has null in its place. A hex for which a formula has no value gets the worse end of the full
range, or the lower one where none is better; cells for which there is no formula get NaN.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from weakref import WeakKeyDictionary

import numpy as np

from hexmend.errors import MeshError
from hexmend.kernels import faces, metrics
from hexmend.mesh.edge_length import hex_lengths
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import MID_EDGES
from hexmend.mesh.solid_cells import kinds_of
from hexmend.mesh.topology import Topology
from hexmend.mesh.validation import as_hexes, as_points, as_points_and_hexes
from hexmend.quality.corner_heights import least_heights
from hexmend.quality.finite_volume.face_quality import face_quality, worst_of_hexes
from hexmend.quality.finite_volume.geometry import cell_geometry, chunks, divide
from hexmend.quality.measure import ElementQuality
from hexmend.quality.mesh_quality import measure_against_target
from hexmend.quality.metric import METRICS, MeshValues, Metric, Values
from hexmend.quality.validity import jacobian_bounds

#: Fields of `FaceQuality`, and their better end: 1 if higher values are better, -1 if lower ones are.
_BETTER = {"non_orthogonality": -1, "skewness": -1, "weight": 1, "volume_ratio": 1}

#: Values of the mesh that was measured last, by its quality: all fields take hardly longer than one.
_LAST: WeakKeyDictionary[ElementQuality, Mapping[str, np.ndarray]] = WeakKeyDictionary()


def _faces_of_hexes(field: str, points: np.ndarray, hexes: np.ndarray, quality: ElementQuality) -> np.ndarray:
    """Return the worst values of a field of `FaceQuality`, for `Metric.of`; neighbours are those among the hexes."""
    points, hexes = as_points_and_hexes(points, hexes)
    return _face_values(points, hexes, quality, lambda: Topology(hexes, len(points)))[field]


def _faces_of_mesh(field: str, mesh: Mesh, quality: ElementQuality) -> np.ndarray:
    """Return the worst values of a field of `FaceQuality`, for `Metric.of_mesh`, by the mesh's topology."""
    return _face_values(mesh.points, mesh.elements, quality, lambda: mesh.topology)[field]


def _face_values(
    points: np.ndarray, hexes: np.ndarray, quality: ElementQuality, topology: Callable[[], Topology]
) -> Mapping[str, np.ndarray]:
    """Worst value over the faces of each hex, (m,) float64, by the field of `FaceQuality`."""
    values = _LAST.get(quality)
    if values is None:
        found = face_quality(cell_geometry(points, hexes), hexes, topology().face_neighbours)
        values = {name: worst_of_hexes(found, getattr(found, name), len(hexes), of) for name, of in _BETTER.items()}
        _LAST.clear()
        _LAST[quality] = values
    return values


#: Kernel that computes results from points, hexes and arrays for them, the number of its results, and an index of them.
_KernelResult = tuple[Callable[..., None], int, int]

#: Metrics that a kernel computes.
_KERNELS: dict[str, _KernelResult] = {
    "min-angle": (faces.angles, 2, 0),
    "max-angle": (faces.angles, 2, 1),
    "aspect-ratio": (metrics.axes, 3, 0),
    "skew": (metrics.axes, 3, 1),
    "taper": (metrics.axes, 3, 2),
    "shape": (metrics.corners, 2, 0),
    "condition": (metrics.corners, 2, 1),
    "edge-ratio": (metrics.lengths, 3, 0),
    "stretch": (metrics.lengths, 3, 1),
    "diagonal": (metrics.lengths, 3, 2),
    "volume": (faces.volume, 1, 0),
    "warpage": (faces.warpage, 1, 0),
}

#: Metrics of the axes and diagonals of hexes, which other cells do not have.
_OF_HEXES_ALONE = ("aspect-ratio", "skew", "taper", "stretch", "diagonal")

#: Metrics of the worst face of a hex as OpenFOAM's checkMesh measures it: fields of `FaceQuality`.
_FACE_FIELDS = {
    "face-skewness": "skewness",
    "face-weight": "weight",
    "non-orthogonality": "non_orthogonality",
    "volume-ratio": "volume_ratio",
}


def _by_kernel(
    result: _KernelResult, worst: float, points: np.ndarray, hexes: np.ndarray, quality: ElementQuality
) -> np.ndarray:
    """Compute a kernel's result; NaN, of a hex so large that the squares of its lengths overflow, becomes `worst`."""
    kernel, n_results, index = result
    points, hexes = as_points_and_hexes(points, hexes)
    values = np.empty((n_results, len(hexes)))
    kernel(points, hexes, *values)
    values[index][np.isnan(values[index])] = worst
    return values[index]


def _of_hexes_alone(
    result: _KernelResult, worst: float, points: np.ndarray, hexes: np.ndarray, quality: ElementQuality
) -> np.ndarray:
    """Compute a kernel's result as `_by_kernel` does, and NaN for cells that are no hexes."""
    values = _by_kernel(result, worst, points, hexes, quality)
    values[kinds_of(hexes) > 0] = math.nan
    return values


def _jacobian(points: np.ndarray, hexes: np.ndarray, quality: ElementQuality) -> np.ndarray:
    """Least of the centre's determinant and of sigma at the corners, the same that `ElementQuality.inverted` tests."""
    if len(quality.sigma) != len(hexes):
        raise MeshError(f"the quality is that of {len(quality.sigma)} hexes: expected that of the same {len(hexes)}")
    centre = _by_kernel((metrics.centre, 1, 0), -math.inf, points, hexes, quality)
    return np.where(kinds_of(hexes) > 0, quality.sigma, np.fmin(quality.sigma, centre))


def _jacobian_ratio(bounds: np.ndarray) -> np.ndarray:
    least, greatest = bounds.T
    return np.where(least > 0, np.maximum(divide(greatest, least, math.inf), 1.0), math.inf)


def _mid_node_offset(mesh: Mesh, quality: ElementQuality) -> np.ndarray:
    offsets = np.zeros(mesh.n_elements)
    if mesh.mid_nodes is None:
        return offsets
    for part in chunks(mesh.n_hexes):
        middles = mesh.mid_nodes[part, : len(MID_EDGES)]
        ends = mesh.points[mesh.hexes[part][:, MID_EDGES]]
        away = np.linalg.norm(mesh.points[middles] - ends.mean(axis=2), axis=2)
        lengths = np.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=2)
        offsets[: mesh.n_hexes][part] = np.where(middles >= 0, divide(away, lengths, math.inf), 0.0).max(axis=1)
    return offsets


def _of_length_ratios(of: Callable[[np.ndarray], np.ndarray], mesh: Mesh, quality: ElementQuality) -> np.ndarray:
    """Compute a metric of the lengths of hexes over those of their target; 1 in a mesh without a target."""
    if mesh.element_target is None:
        return np.ones(mesh.n_elements)
    return of(hex_lengths(mesh.points, mesh.elements) / mesh.element_target.lengths)


#: Other metrics: the functions for `Metric.of` and `Metric.of_mesh`.
_OTHERS: dict[str, tuple[Values, MeshValues | None]] = {
    "q": (lambda points, hexes, quality: quality.q, None),
    "scaled-jacobian": (lambda points, hexes, quality: quality.scaled_jacobian, None),
    "jacobian": (_jacobian, None),
    "jacobian-ratio": (
        lambda points, hexes, quality: _jacobian_ratio(jacobian_bounds(points, hexes)),
        lambda mesh, quality: _jacobian_ratio(jacobian_bounds(mesh.points, mesh.elements, mesh.mid_nodes)),
    ),
    "mid-node-offset": (
        lambda points, hexes, quality: np.zeros(len(as_hexes(hexes, len(as_points(points))))),
        _mid_node_offset,
    ),
    "time-step": (lambda points, hexes, quality: np.maximum(least_heights(points, hexes), 0.0), None),
    "aspect-against-given": (
        lambda points, hexes, quality: np.ones(len(hexes)),
        partial(_of_length_ratios, lambda ratios: divide(ratios.max(axis=1), ratios.min(axis=1), math.inf)),
    ),
    "q-of-target": (
        lambda points, hexes, quality: quality.q,
        lambda mesh, quality: measure_against_target(mesh, mesh.points, quality).q,
    ),
    "size-against-target": (
        lambda points, hexes, quality: np.ones(len(hexes)),
        partial(_of_length_ratios, lambda ratios: np.cbrt(ratios).prod(axis=1)),
    ),
}


def _functions(name: str, worst: float) -> tuple[Values, MeshValues | None]:
    if name in _KERNELS:
        return partial(_of_hexes_alone if name in _OF_HEXES_ALONE else _by_kernel, _KERNELS[name], worst), None
    if name in _FACE_FIELDS:
        return partial(_faces_of_hexes, _FACE_FIELDS[name]), partial(_faces_of_mesh, _FACE_FIELDS[name])
    return _OTHERS[name]


def _range(low: float | None, high: float | None) -> tuple[float, float]:
    return -math.inf if low is None else low, math.inf if high is None else high


for _name, _entry in json.loads(Path(__file__).with_name("metrics.json").read_text(encoding="utf-8")).items():
    _entry |= {key: _range(*_entry[key]) for key in ("full_range", "acceptable")}
    _of, _of_mesh = _functions(_name, _entry["full_range"][_entry["better"] < 0])
    Metric(name=_name, of=_of, of_mesh=_of_mesh, **_entry).register()

Q, SCALED_JACOBIAN = METRICS["q"], METRICS["scaled-jacobian"]
