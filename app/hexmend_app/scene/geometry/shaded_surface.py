"""Polygons of a fine frame, each with one normal and with shading at its corners."""

from __future__ import annotations

import numpy as np
import pyvista as pv

from hexmend_app.scene.colour.colouring import INVERTED
from hexmend_app.scene.cutting.polygons import Polygons
from hexmend_app.scene.geometry import occlusion
from hexmend_app.scene.layers.surface import SHADED, coloured, colours_of, hexes_of

_NORMALS = "normals"


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
    corners, counts = len(polygons.places), np.diff(polygons.start)
    cells = pv.CellArray.from_arrays(polygons.start, np.arange(corners))
    separated = pv.PolyData(polygons.points[polygons.places], faces=cells)
    colours = np.repeat(colours_of(poly), counts, axis=0)
    separated.point_data[SHADED] = colours if light is None else shaded(colours, light)
    separated.point_data[_NORMALS] = np.repeat(occlusion.normals(polygons).astype(np.float32), counts, axis=0)
    separated.point_data.active_normals_name = _NORMALS
    return coloured(separated, colours_of(poly), hexes_of(poly))


def shaded(colours: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Return colours, (k, 3) uint8, shaded by ambient light, (k,) float64; inverted hexes are not shaded."""
    inverted = (colours == INVERTED).all(axis=1)
    brightness = np.where(inverted, 1.0, occlusion.brightness(light))
    return (colours * brightness[:, None] + 0.5).astype(np.uint8)
