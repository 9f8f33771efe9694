"""Polygons with colours and the hexes that they belong to."""

from __future__ import annotations

import numpy as np
import pyvista as pv

#: Names of the cell arrays of colours and of hexes.
COLOURS, HEX = "colours", "hex"


def quads(points: np.ndarray, faces: np.ndarray, colours: np.ndarray, hexes: np.ndarray) -> pv.PolyData:
    """Build quads from points (u, 3), faces (k, 4), and colours (k, 3) uint8 and hexes (k,) int32 of the faces.

    Faces that repeat their last point are triangles.
    """
    return coloured(polygons(points, faces), colours, hexes)


def polygons(points: np.ndarray, faces: np.ndarray) -> pv.PolyData:
    """Build quads from points (u, 3) and faces (k, 4), of which those that repeat their last point are triangles."""
    kept = np.ones(faces.shape, dtype=bool)
    kept[:, 3] = faces[:, 2] != faces[:, 3]
    if kept.all():
        return pv.PolyData.from_regular_faces(points, faces)
    start = np.append(0, np.cumsum(kept.sum(axis=1)))
    return pv.PolyData(points, faces=pv.CellArray.from_arrays(start, faces[kept]))


def coloured(data: pv.PolyData, colours: np.ndarray, hexes: np.ndarray) -> pv.PolyData:
    """Set the colours of cells, (k, 3) uint8, and the hexes that they belong to, (k,) int32; return the dataset."""
    if len(colours):  # VTK rejects empty arrays
        data.cell_data[COLOURS] = colours
        data.cell_data[HEX] = hexes.astype(np.int32, copy=False)
    return data


def hex_of(data: pv.DataSet, cell: int) -> int:
    """Return the hex that a cell belongs to."""
    return int(data.cell_data[HEX][cell])


def hexes_of(poly: pv.PolyData) -> np.ndarray:
    """Return the hexes that polygons belong to, (k,) int32."""
    return np.asarray(poly.cell_data[HEX])


def colours_of(poly: pv.PolyData) -> np.ndarray:
    """Return the colours of polygons, (k, 3) uint8."""
    return np.asarray(poly.cell_data[COLOURS])


def set_points(data: pv.DataSet, points: np.ndarray) -> None:
    """Overwrite the points in place and notify VTK."""
    if not len(points):
        return
    data.points[:] = points  # type: ignore[index]  # PyVista's annotation names integers only
    data.GetPoints().Modified()
    data.Modified()


def set_colours(data: pv.DataSet, colours: np.ndarray) -> None:
    """Overwrite the colours of cells in place and notify VTK."""
    if not len(colours):
        return
    data.cell_data[COLOURS][:] = colours  # type: ignore[index]
    data.GetCellData().GetArray(COLOURS).Modified()
    data.Modified()
