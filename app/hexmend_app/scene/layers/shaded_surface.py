"""Polygons of a fine frame, each flat or with the normals of a curved face, and with shading at its corners."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkFiltersCore import vtkBinnedDecimation

from hexmend_app.scene.colour.colouring import are_invalid
from hexmend_app.scene.geometry import occlusion
from hexmend_app.scene.geometry.coloured_polygons import coloured, colours_of, hexes_of
from hexmend_app.scene.geometry.edge_flags import edge_flags, normals_of, set_edge_flags, set_normals
from hexmend_app.scene.geometry.polygons import Polygons
from hexmend_app.scene.layers.surface import SHADED

#: Number of faces above which a skin is decimated while the camera moves; they take 50 ms in software rendering.
MANY = 30_000

_DIVISIONS = 64  # of each side of the bounding box, so that a grid cell is about ten pixels wide


def shaded_surface(poly: pv.PolyData, light: np.ndarray | None) -> pv.PolyData:
    """Return polygons that share no points, so that adjacent polygons can differ in colour and normal.

    Parameters
    ----------
    poly : pyvista.PolyData
        Polygons with colours and hexes (see `coloured`).
    light : (c,) float64, optional
        Ambient light at each corner, polygon by polygon; None for full light.
    """
    polygons = Polygons.of(poly)
    corners: np.ndarray = np.arange(len(polygons.places))
    counts, cells = np.diff(polygons.start), pv.CellArray.from_arrays(polygons.start, corners)
    separated = pv.PolyData(polygons.points[polygons.places], faces=cells)
    colours = np.repeat(colours_of(poly), counts, axis=0)
    separated.point_data[SHADED] = colours if light is None else shaded(colours, light)
    normals, flags = normals_of(poly), edge_flags(poly)
    if normals is None:
        set_normals(separated, np.repeat(occlusion.normals(polygons).astype(np.float32), counts, axis=0))
    else:
        set_normals(separated, normals[polygons.places])
    if flags is not None:
        set_edge_flags(separated, flags[polygons.places])
    return coloured(separated, colours_of(poly), hexes_of(poly))


def shaded(colours: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return colours, (k, 3) uint8, shaded by ambient light, (k,) float64; invalid hexes are not shaded."""
    brightness = np.where(are_invalid(colours), 1.0, occlusion.brightness(light))
    return (colours * brightness[:, None] + 0.5).astype(np.uint8)


def decimated(skin: pv.PolyData) -> pv.PolyData:
    """Cluster a surface into triangles of about the size of a grid cell, each in the colour of one of its faces.

    Parameters
    ----------
    skin : pyvista.PolyData
        Quads and triangles, with colours and hexes (see `coloured`).
    """
    faces = Polygons.of(skin)
    first, quads = faces.start[:-1], np.flatnonzero(np.diff(faces.start) == 4)
    corners = np.concatenate([first[:, None] + [0, 1, 2], first[quads, None] + [0, 2, 3]])
    data = pv.PolyData.from_regular_faces(skin.points, faces.places[corners])
    data.cell_data["face"] = np.concatenate([np.arange(len(first)), quads])
    bins = vtkBinnedDecimation()
    bins.SetInputData(data)
    bins.SetNumberOfDivisions(_DIVISIONS, _DIVISIONS, _DIVISIONS)
    bins.SetPointGenerationModeToUseInputPoints()
    bins.ProduceCellDataOn()
    bins.ProducePointDataOff()
    bins.Update()
    coarse = pv.wrap(bins.GetOutput())
    owners = np.asarray(coarse.cell_data["face"]).astype(np.int64)
    coarse.clear_data()
    return coloured(coarse, colours_of(skin)[owners], hexes_of(skin)[owners])
