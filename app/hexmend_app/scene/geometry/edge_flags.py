"""Flags of corners of polygons from which an edge of a hex begins; other edges divide a curved face and are not drawn.

VTK draws the edge from a corner to the next one if the corner's point has a flag that is not 0. Polygons with flags
share no points. They also have normals at their points, those of the curved face.
"""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes

from hexmend_app.scene.cutting.polygons import Polygons

_FLAGS = "vtkEdgeFlags"  # the name that VTK expects

#: Name of the point normals.
NORMALS = "normals"

#: Tolerance for a point on a side of a polygon, as a fraction of the longest side.
_TOLERANCE = 1e-6


def set_edge_flags(poly: pv.PolyData, flags: np.ndarray) -> None:
    """Set the flags of the points, (p,) bool."""
    array = numpy_to_vtk(flags.astype(np.uint8), deep=True)
    array.SetName(_FLAGS)
    data = poly.GetPointData()
    data.AddArray(array)
    data.SetActiveAttribute(_FLAGS, vtkDataSetAttributes.EDGEFLAG)


def edge_flags(poly: pv.PolyData) -> np.ndarray | None:
    """Return the flags of the points, (p,) bool; None if all edges are edges of hexes."""
    if not poly.GetPointData().HasArray(_FLAGS):
        return None
    return np.asarray(poly.point_data[_FLAGS]).astype(bool)


def set_normals(poly: pv.PolyData, normals: np.ndarray) -> None:
    """Set the normals of the points, (p, 3)."""
    poly.point_data[NORMALS] = normals.astype(np.float32, copy=False)
    poly.point_data.active_normals_name = NORMALS


def normals_of(poly: pv.PolyData) -> np.ndarray | None:
    """Return the normals of the points, (p, 3) float32; None if each polygon has one normal."""
    return np.asarray(poly.point_data[NORMALS]) if poly.GetPointData().HasArray(NORMALS) else None


def clipped(whole: Polygons, flags: np.ndarray, normals: np.ndarray, left: Polygons) -> tuple[np.ndarray, np.ndarray]:
    """Return flags and normals of polygons that are parts of others.

    An edge on a side of the original polygon has the flag of this side, and an edge of the cut has a flag. Normals are
    interpolated along the sides.

    Parameters
    ----------
    whole : Polygons
    flags : (c,) bool
    normals : (c, 3) float32
        Of the corners of `whole`, polygon by polygon.
    left : Polygons
        Each has the number of its original polygon as owner.

    Returns
    -------
    flags : (d,) bool
    normals : (d, 3) float32
        Of the corners of `left`.
    """
    first, counts = left.start[:-1], np.diff(left.start)
    begin, sides = whole.start[left.owner], np.diff(whole.start)[left.owner]
    polygon = np.repeat(np.arange(len(left)), counts)
    corner = np.arange(len(left.places)) - first[polygon]
    same = begin[polygon] + np.minimum(corner, sides[polygon] - 1)  # the corner itself, if the polygon is not clipped
    points = left.points[left.places]
    differs = (points != whole.points[whole.places[same]]).any(axis=1) | (counts != sides)[polygon]
    changed = np.zeros(len(left), dtype=bool)
    changed[polygon[differs]] = True
    answer, turned = flags[same], normals[same]
    some = np.flatnonzero(changed[polygon])
    if len(some):
        following = np.where(corner[some] + 1 < counts[polygon[some]], some + 1, first[polygon[some]])
        at, share, on = _nearest_sides(whole, begin[polygon[some]], sides[polygon[some]], points[some])
        ends = normals[at]
        mixed = ends[:, 0] + share[:, None] * (ends[:, 1] - ends[:, 0])
        turned[some] = mixed / np.maximum(np.linalg.norm(mixed, axis=1), 1e-30)[:, None]
        index = np.full(len(points), -1)
        index[some] = np.arange(len(some))
        both = on & on[index[following]]
        columns = np.minimum(np.arange(on.shape[1]), sides[polygon[some], None] - 1)
        flagged = flags[begin[polygon[some], None] + columns]
        answer[some] = np.where(both.any(axis=1), (both & flagged).any(axis=1), True)
    return answer, turned


def _nearest_sides(
    whole: Polygons, begin: np.ndarray, sides: np.ndarray, points: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the ends of the nearest side of each point, (k, 2), its share from the first end, and all its sides.

    Parameters
    ----------
    whole : Polygons
    begin, sides : (k,) int64
        First corner and number of sides of the polygon of each point.
    points : (k, 3) float64
    """
    columns = np.arange(int(sides.max()))
    real = columns < sides[:, None]
    starts = begin[:, None] + np.where(real, columns, 0)
    ends = begin[:, None] + np.where(columns + 1 < sides[:, None], columns + 1, 0)
    a, b = whole.points[whole.places[starts]], whole.points[whole.places[ends]]
    along, away = b - a, points[:, None] - a
    squares = np.einsum("ksx,ksx->ks", along, along)
    share = np.clip(np.einsum("ksx,ksx->ks", away, along) / np.where(squares > 0, squares, 1.0), 0.0, 1.0)
    distances = np.square(away - share[..., None] * along).sum(axis=2)
    distances[~real] = np.inf
    row, nearest = np.arange(len(points)), distances.argmin(axis=1)
    longest = np.where(real, squares, 0.0).max(axis=1)
    on = distances <= _TOLERANCE**2 * longest[:, None]
    return np.stack([starts, ends], axis=2)[row, nearest], share[row, nearest], on
