"""Quantities of a mesh from which checks are computed, each computed on first use.

Shapes of the quads of hexes: their six faces, and the three cross-sections through the middles of their edges.

Source: ANSYS Theory Reference, 12.1 Element Shape Testing, which judges solids by the quads of both kinds.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import HEXAHEDRON, SolidKind, rows_by_kind
from hexmend.quality.finite_volume import CellGeometry, FaceQuality, cell_geometry, face_quality
from hexmend.quality.finite_volume.geometry import chunks, cross, divide, dot, in_unit, norm
from hexmend.quality.measure import ElementQuality, measure
from hexmend.quality.metric import METRICS

#: Opposite faces by their corners; the middles of the edges between them are the corners of a cross-section.
_ENDS = np.array([[[0, 3, 7, 4], [1, 2, 6, 5]], [[0, 4, 5, 1], [3, 7, 6, 2]], [[0, 1, 2, 3], [4, 5, 6, 7]]])


@dataclass(frozen=True, eq=False)
class QuadShapes:
    """Worst shapes of the quads of each hex.

    Parameters
    ----------
    aspect_ratio : (m,) float64
        Of faces and cross-sections; +inf for a quad without area.
    parallel_deviation : (m,) float64
        Largest angle of two opposite edges in degrees, of faces and cross-sections.
    max_angle : (m,) float64
        Largest angle of two adjacent edges in degrees, of faces and cross-sections.
    warping_factor : (m,) float64
        Of faces: difference of the heights of an edge's ends, along the face's normal, over the root of its area.
    corner_cosine : (m,) float64
        Least cosine of the normals at two diagonally opposite corners of a face; -1 where a corner has no normal.
    """

    aspect_ratio: np.ndarray
    parallel_deviation: np.ndarray
    max_angle: np.ndarray
    warping_factor: np.ndarray
    corner_cosine: np.ndarray


def quad_shapes(points: np.ndarray, hexes: np.ndarray) -> QuadShapes:
    """Compute the worst shapes of the quads of each hex; of other cells those of their faces that are quads.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32

    Returns
    -------
    QuadShapes
    """
    x, _ = in_unit(points, hexes)
    values = np.empty((5, len(hexes)))
    for kind, rows in rows_by_kind(hexes):
        values[:, rows] = _shapes_of_kind(x, hexes[rows], kind)
    return QuadShapes(*values)


def _shapes_of_kind(x: np.ndarray, cells: np.ndarray, kind: SolidKind) -> np.ndarray:
    """The fields of `QuadShapes` of cells (k, 8) of one kind at points (3, n), (5, k); tetrahedra have no quads."""
    values = np.tile([[1.0], [0.0], [90.0], [0.0], [1.0]], len(cells))
    is_quad = (kind.faces[:, 0] >= 0) & (kind.faces[:, 2] != kind.faces[:, 3])
    for part in chunks(len(cells) if is_quad.any() else 0):
        corners = x[:, cells[part].T]
        quads = faces = corners[:, kind.faces[is_quad]]
        if kind is HEXAHEDRON:
            sections = (corners[:, _ENDS[:, 0]] + corners[:, _ENDS[:, 1]]) / 2
            quads = np.concatenate([faces, sections], axis=1)  # (3, 9, 4, k)
        edges = np.roll(quads, -1, axis=2) - quads
        values[:, part] = [
            _aspect_ratios(quads).max(axis=0),
            _parallel_deviations(edges).max(axis=0),
            _angles(edges, -np.roll(edges, 1, axis=2)).max(axis=(0, 1)),
            _warping_factors(faces).max(axis=0),
            _corner_cosines(edges[:, : faces.shape[1]]).min(axis=0),
        ]
    return values


def _aspect_ratios(quads: np.ndarray) -> np.ndarray:
    """Aspect ratios of quads (3, q, 4, k), (q, k).

    The lines that join the middles of opposite edges each have a rectangle with two sides along it that passes through
    the ends of the other line; the ratio of sides of the more stretched counts.
    """
    a, b, c, d = np.moveaxis(quads, 2, 0)
    first, second = (b + c - a - d) / 2, (c + d - a - b) / 2
    area = norm(cross(first, second))
    ratios = [divide(dot(line, line), area, np.inf) for line in (first, second)]
    with np.errstate(divide="ignore"):
        return np.max([np.maximum(ratio, 1 / ratio) for ratio in ratios], axis=0)


def _parallel_deviations(edges: np.ndarray) -> np.ndarray:
    """Largest angles of opposite edges of quads (3, q, 4, k) in degrees, (q, k); 180 with an edge of no length."""
    return np.maximum(_angles(edges[:, :, 0], -edges[:, :, 2]), _angles(edges[:, :, 1], -edges[:, :, 3]))


def _angles(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Angles of vectors (3, ...) in degrees; 180 for a vector without length."""
    angles = np.degrees(np.arctan2(norm(cross(a, b)), dot(a, b)))
    return np.where((norm(a) > 0) & (norm(b) > 0), angles, 180.0)


def _warping_factors(faces: np.ndarray) -> np.ndarray:
    """Warping factors of quads (3, q, 4, k), (q, k); +inf for a quad without area."""
    a, b, c, d = np.moveaxis(faces, 2, 0)
    normal = cross(c - a, d - b)
    area = norm(normal)  # twice that of the quad, projected along its normal
    height = np.abs(divide(dot(b - a, normal), area, np.inf))
    return divide(height, np.sqrt(area / 2), np.inf)


def _corner_cosines(edges: np.ndarray) -> np.ndarray:
    """Least cosines of the normals at opposite corners of quads with these edges (3, q, 4, k), (q, k)."""
    normals = cross(edges, -np.roll(edges, 1, axis=2))
    size = norm(normals)
    opposite = np.roll(normals, 2, axis=2)
    cosines = divide(dot(normals, opposite), size * np.roll(size, 2, axis=1), -1.0)
    return np.clip(cosines, -1.0, 1.0).min(axis=1)


class Measures:
    """Quantities of a mesh.

    Parameters
    ----------
    mesh : Mesh
    quality : ElementQuality, optional
        Quality of its hexes, if it is measured already.
    """

    def __init__(self, mesh: Mesh, quality: ElementQuality | None = None):
        self.mesh = mesh
        self.quality = measure(mesh.points, mesh.elements, mesh.mid_nodes) if quality is None else quality

    @cached_property
    def cells(self) -> CellGeometry:
        """Centres, areas and volumes of faces and hexes."""
        return cell_geometry(self.mesh.points, self.mesh.elements)

    @cached_property
    def faces(self) -> FaceQuality:
        """Quality of every face."""
        return face_quality(self.cells, self.mesh.elements, self.mesh.topology.face_neighbours)

    @cached_property
    def quads(self) -> QuadShapes:
        """Shapes of the faces and cross-sections of the hexes."""
        return quad_shapes(self.mesh.points, self.mesh.elements)

    @cached_property
    def characteristic_lengths(self) -> np.ndarray:
        """Volume over the largest face of each hex, (m,) float64, in the mesh's unit of length."""
        largest = norm(self.cells.face_areas).max(axis=0)
        return divide(self.cells.volumes, largest, 0.0) * self.cells.unit

    @property
    def cell_volumes(self) -> np.ndarray:
        """Sums of the pyramids of each hex, (m,) float64, in the cube of the mesh's unit of length."""
        return self.cells.volumes * self.cells.unit**3

    @property
    def boundary_faces(self) -> np.ndarray:
        """True for faces of one hex, (f,) bool."""
        return ~self.faces.internal

    @property
    def first_order(self) -> np.ndarray:
        """True for hexes without mid-nodes, (m,) bool."""
        return ~self.second_order

    @cached_property
    def second_order(self) -> np.ndarray:
        """True for hexes with mid-nodes, (m,) bool."""
        marks = np.zeros(self.mesh.n_elements, dtype=bool)
        if self.mesh.mid_nodes is not None:
            marks[: self.mesh.n_hexes] = (self.mesh.mid_nodes >= 0).any(axis=1)
        return marks

    def metric(self, name: str) -> np.ndarray:
        """Values of a metric of `METRICS`, (m,) float64."""
        return METRICS[name].values(self.mesh, self.quality)
