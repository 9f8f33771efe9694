"""Quantities of a mesh from which checks are computed, each computed on first use."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from hexmend.mesh.hexahedron import EDGES
from hexmend.mesh.mesh import Mesh
from hexmend.quality.finite_volume import CellGeometry, FaceQuality, cell_geometry, face_quality
from hexmend.quality.finite_volume.geometry import chunks, divide, norm
from hexmend.quality.measure import ElementQuality, measure
from hexmend.quality.metric import METRICS
from hexmend.solver_checks.quads import QuadShapes, quad_shapes


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
        self.quality = measure(mesh.points, mesh.hexes, mesh.mid_nodes) if quality is None else quality

    @cached_property
    def cells(self) -> CellGeometry:
        """Centres, areas and volumes of faces and hexes."""
        return cell_geometry(self.mesh.points, self.mesh.hexes)

    @cached_property
    def faces(self) -> FaceQuality:
        """Quality of every face."""
        return face_quality(self.cells, self.mesh.hexes, self.mesh.topology.face_neighbours)

    @cached_property
    def quads(self) -> QuadShapes:
        """Shapes of the faces and cross-sections of the hexes."""
        return quad_shapes(self.mesh.points, self.mesh.hexes)

    @cached_property
    def volumes(self) -> np.ndarray:
        """Volumes of the hexes, (m,) float64, in the cube of the mesh's unit of length."""
        return self.metric("volume")

    @cached_property
    def characteristic_lengths(self) -> np.ndarray:
        """Volume over the largest face of each hex, (m,) float64, in the mesh's unit of length."""
        largest = norm(self.cells.face_areas).max(axis=0)
        return divide(self.cells.volumes, largest, 0.0) * self.cells.unit

    @cached_property
    def edge_ratios(self) -> np.ndarray:
        """Longest over shortest edge of each hex, (m,) float64; +inf with an edge of no length."""
        ratios = np.empty(self.mesh.n_hexes)
        for part in chunks(len(ratios)):
            x = self.cells.points[:, self.mesh.hexes[part].T]
            lengths = norm(x[:, EDGES[:, 1]] - x[:, EDGES[:, 0]])
            ratios[part] = divide(lengths.max(axis=0), lengths.min(axis=0), np.inf)
        return ratios

    @property
    def cell_volumes(self) -> np.ndarray:
        """Sums of the pyramids of each hex, (m,) float64, in the cube of the mesh's unit of length."""
        return self.cells.volumes * self.cells.unit**3

    @property
    def internal_faces(self) -> np.ndarray:
        """True for faces between two hexes, (f,) bool."""
        return self.faces.internal

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
        if self.mesh.mid_nodes is None:
            return np.zeros(self.mesh.n_hexes, dtype=bool)
        return (self.mesh.mid_nodes >= 0).any(axis=1)

    def metric(self, name: str) -> np.ndarray:
        """Values of a metric of `METRICS`, (m,) float64."""
        return METRICS[name].values(self.mesh, self.quality)
