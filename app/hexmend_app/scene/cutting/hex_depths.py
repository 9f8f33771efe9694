"""Centres of hexes and their depths below the boundary, for cuts by whole hexes."""

from __future__ import annotations

import numpy as np

from hexmend.boundary.closest_point import ClosestPointTrees, triangulate
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import centres
from hexmend_app.picture.cut_shapes import Depth, DepthUnit


class HexDepths:
    """Centres of hexes and their depths, stored for the positions that they were computed for.

    Parameters
    ----------
    mesh : Mesh
        Mesh that gives the hexes.
    """

    def __init__(self, mesh: Mesh):
        self._mesh = mesh
        self._points: np.ndarray | None = None
        self._centres: np.ndarray | None = None
        self._depths: np.ndarray | None = None

    def centres(self, points: np.ndarray) -> np.ndarray:
        """Return the centres of hexes, (m, 3) float64, for node positions (n, 3) float64."""
        if points is not self._points:
            self._points, self._depths = points, None
            self._centres = centres(points, self._mesh.elements)
        return self._centres

    def in_range(self, points: np.ndarray, depth: Depth) -> np.ndarray:
        """Return True for hexes with a depth in a range, (m,) bool.

        Parameters
        ----------
        points : (n, 3) float64
        depth : Depth
        """
        if depth.unit is DepthUnit.LAYERS:
            return depth.contains(self._mesh.topology.layers + 1)
        centres = self.centres(points)
        if self._depths is None:
            self._depths = self._distances(points, centres)
        return depth.contains(self._depths)

    def _distances(self, points: np.ndarray, centres: np.ndarray) -> np.ndarray:
        """Distances of centres, (m, 3), from the boundary in mean edge lengths, (m,) float64."""
        vertices, triangles, _ = triangulate(points, self._mesh.topology.boundary_faces)
        trees = ClosestPointTrees(vertices, triangles, np.zeros(len(triangles), np.int64))
        closest = trees.closest(centres, np.zeros(len(centres), np.int64))
        unit = self._mesh.with_points(points).mean_edge_length or 1.0
        return np.linalg.norm(closest.points - centres, axis=1) / unit
