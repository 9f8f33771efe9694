"""Polygons as a fine frame shows them: one normal each, and light at each of their corners."""

from __future__ import annotations

import numpy as np
import pyvista as pv

from hexmend_app.scene import occlusion
from hexmend_app.scene.colours import INVERTED
from hexmend_app.scene.cutting.polygons import Polygons
from hexmend_app.scene.layers.surface import SHADED, coloured, colours_of, hexes_of

_NORMALS = "normals"


def fine(poly: pv.PolyData, light: np.ndarray | None) -> pv.PolyData:
    """The same polygons with corners of their own, so that neighbours differ in colour and normal where they meet.

    Parameters
    ----------
    poly : pyvista.PolyData
        With colours and hexes (see `coloured`).
    light : (c,) float64, optional
        What reaches each corner, polygon after polygon; None for all of it.
    """
    polygons = Polygons.of(poly)
    corners, counts = len(polygons.places), np.diff(polygons.start)
    cells = pv.CellArray.from_arrays(polygons.start, np.arange(corners))
    answer = pv.PolyData(polygons.points[polygons.places], faces=cells)
    colours = np.repeat(colours_of(poly), counts, axis=0)
    answer.point_data[SHADED] = colours if light is None else shaded(colours, light)
    answer.point_data[_NORMALS] = np.repeat(occlusion.normals(polygons).astype(np.float32), counts, axis=0)
    answer.point_data.active_normals_name = _NORMALS
    return coloured(answer, colours_of(poly), hexes_of(poly))


def shaded(colours: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Colours, (k, 3) uint8, under so much light, (k,) float64; what is inverted has no outside, and all light."""
    inverted = (colours == INVERTED).all(axis=1)
    brightness = np.where(inverted, 1.0, occlusion.brightness(light))
    return (colours * brightness[:, None] + 0.5).astype(np.uint8)
