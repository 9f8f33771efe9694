"""The smooth cut: the sections of the elements by planes, and the skin that is left."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkClipPolyData, vtkPlaneCutter

from hexmend_app.scene import sides
from hexmend_app.scene.surface import coloured
from hexmend_app.state.clip import Clip, ClipPlane


def sections(
    points: np.ndarray, hexes: np.ndarray, keep: np.ndarray | None, clip: Clip, colours: np.ndarray
) -> pv.PolyData:
    """What is seen where planes cut through the elements: the section by each, as far as the others leave it open.

    Parameters are those of `section`.
    """
    seen, planes = [], clip.planes
    for at, plane in enumerate(planes):
        part = section(points, hexes, keep, plane, colours)
        for other in (*planes[:at], *planes[at + 1 :]):
            part = _half(part, other, beyond=clip.notch)
        seen.append(part)
    return _together(seen)


def section(
    points: np.ndarray, hexes: np.ndarray, keep: np.ndarray | None, plane: ClipPlane, colours: np.ndarray
) -> pv.PolyData:
    """Where a plane cuts through the elements: a polygon for each, in its colour.

    Only hexes that the plane crosses or touches are handed to VTK, a few in a hundred. To VTK a node on the plane lies
    beyond it: of two hexes whose common face lies in the plane, the one that is kept gives the polygon.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    keep : (m,) bool, optional
        Hexes that are shown at all.
    plane : ClipPlane
    colours : (m, 3) uint8
    """
    touched = sides.touched(points, hexes, *plane.equation)
    if keep is not None:
        touched &= keep
    chosen = np.flatnonzero(touched)
    if not len(chosen):
        return pv.PolyData()
    nodes, cells = np.unique(hexes[chosen], return_inverse=True)
    grid = pv.UnstructuredGrid({pv.CellType.HEXAHEDRON: cells.reshape(-1, 8)}, points[nodes])
    coloured(grid, colours[chosen], chosen)
    cutter = vtkPlaneCutter()
    cutter.SetInputData(grid)
    cutter.SetPlane(_vtk(plane))
    cutter.ComputeNormalsOff()
    cutter.Update()
    return pv.wrap(cutter.GetOutput())


def behind(skin: pv.PolyData, clip: Clip) -> pv.PolyData:
    """The part of a skin that is not cut away, colours carried along."""
    if not clip.notch:
        for plane in clip.planes:
            skin = _half(skin, plane)
        return skin
    left = []
    for plane in clip.planes:
        left.append(_half(skin, plane))
        skin = _half(skin, plane, beyond=True)
    return _together(left)


def _half(poly: pv.PolyData, plane: ClipPlane, beyond: bool = False) -> pv.PolyData:
    """The part of polygons that lies before a plane, or beyond it."""
    if not poly.GetNumberOfCells():
        return poly
    clip = vtkClipPolyData()
    clip.SetInputData(poly)
    clip.SetClipFunction(_vtk(plane))
    clip.SetInsideOut(not beyond)
    clip.Update()
    return pv.wrap(clip.GetOutput())


def _together(parts: list[pv.PolyData]) -> pv.PolyData:
    parts = [part for part in parts if part.GetNumberOfCells()]  # an empty one takes the colours of all away
    if len(parts) < 2:
        return parts[0] if parts else pv.PolyData()
    append = vtkAppendPolyData()
    for part in parts:
        append.AddInputData(part)
    append.Update()
    return pv.wrap(append.GetOutput())


def _vtk(plane: ClipPlane) -> vtkPlane:
    answer = vtkPlane()
    answer.SetNormal(plane.normal)
    answer.SetOrigin(plane.origin)
    return answer
