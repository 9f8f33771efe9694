"""Flags of corners of polygons from which an edge of a hex begins; other edges divide a curved face and are not drawn.

VTK draws the edge from a corner to the next one if the corner's point has a flag that is not 0. Polygons with flags
share no points. They also have normals at their points, those of the curved face.
"""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes

_FLAGS = "vtkEdgeFlags"  # the name that VTK expects

#: Name of the point normals.
NORMALS = "normals"


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
