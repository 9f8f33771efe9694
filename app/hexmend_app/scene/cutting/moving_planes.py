"""Cuts by whole hexes while their planes move along their normals: nothing but heights is compared."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend_app.picture.cut_shapes import Plane
from hexmend_app.scene.geometry import plane_sides

#: Maximum number of planes whose heights are stored; those of more planes are computed each time.
MOST_PLANES = 2


class MovingPlanes:
    """Sides of planes on which the centres of hexes lie, with the heights of the centres along the last normals.

    Parameters
    ----------
    mesh : Mesh
        Mesh that gives the hexes.
    """

    def __init__(self, mesh: Mesh):
        self._mesh = mesh
        self._points: np.ndarray | None = None
        self._heights: dict[tuple[float, ...], tuple[np.ndarray, float]] = {}

    def kept(self, points: np.ndarray, planes: Sequence[Plane], notch: bool) -> np.ndarray:
        """Return True for hexes whose centres are not cut away, (m,) bool; see `plane_sides.centres_kept`."""
        if len(planes) > MOST_PLANES:
            normals, offsets = zip(*(plane.equation for plane in planes), strict=True)
            return plane_sides.centres_kept(points, self._mesh.hexes, np.array(normals), np.array(offsets), notch)
        below = [heights <= 8 * offset for heights, _, offset in self._along(points, planes)]
        return (np.logical_or if notch else np.logical_and).reduce(below)

    def sections(self, points: np.ndarray, planes: Sequence[Plane]) -> tuple[np.ndarray, np.ndarray]:
        """Return the faces that a cut opens, without a search for all visible faces.

        Parameters
        ----------
        points : (n, 3) float64
        planes : sequence of Plane
            At most `MOST_PLANES`; what lies beyond any of them is cut away.

        Returns
        -------
        quads : (k, 4) int32
            Nodes of the faces, counter-clockwise as seen from outside. A face behind which a hex is beyond several
            planes is there several times.
        hexes : (k,) int32
            Hex of each face.
        """
        sides, faces, owners = self._along(points, planes), [], []
        for number, (heights, extent, offset) in enumerate(sides):
            quads, hexes = plane_sides.opened(self._mesh, heights, extent, offset)
            for other, _, limit in (*sides[:number], *sides[number + 1 :]):
                shown = other[hexes] <= 8 * limit
                quads, hexes = quads[shown], hexes[shown]
            faces.append(quads)
            owners.append(hexes)
        return np.concatenate(faces), np.concatenate(owners)

    def forget(self) -> None:
        """Free the heights."""
        self._heights.clear()

    def _along(self, points: np.ndarray, planes: Sequence[Plane]) -> list[tuple[np.ndarray, float, float]]:
        """Heights of the centres, largest extent of a hex, and offset, for each plane."""
        if points is not self._points:
            self._points = points
            self._heights.clear()
        found = []
        for plane in planes:
            normal, offset = plane.equation
            key = tuple(float(x) for x in normal)
            known = self._heights.pop(key, None)
            known = known or plane_sides.centre_heights(points, self._mesh.hexes, np.array(key))
            found.append((key, known, offset))
            while len(self._heights) >= MOST_PLANES:
                del self._heights[next(iter(self._heights))]
            self._heights[key] = known  # the last used comes last
        return [(*known, offset) for _, known, offset in found]
