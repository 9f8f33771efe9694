"""The smooth cut: the section of the elements by a plane, and the skin behind it."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkClipPolyData, vtkPlaneCutter

from hexmend_app.scene import sides
from hexmend_app.scene.surface import coloured
from hexmend_app.state.look import ClipPlane


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


def behind(skin: pv.PolyData, plane: ClipPlane) -> pv.PolyData:
    """The part of a skin on the kept side of a plane, colours carried along."""
    clip = vtkClipPolyData()
    clip.SetInputData(skin)
    clip.SetClipFunction(_vtk(plane))
    clip.InsideOutOn()
    clip.Update()
    return pv.wrap(clip.GetOutput())


def _vtk(plane: ClipPlane) -> vtkPlane:
    answer = vtkPlane()
    answer.SetNormal(plane.normal)
    answer.SetOrigin(plane.origin)
    return answer
