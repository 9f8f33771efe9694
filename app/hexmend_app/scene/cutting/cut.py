"""Smooth cuts: sections of hexes by planes, and the remaining skin."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pyvista as pv
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkPlaneCutter

from hexmend_app.picture.cut import Cut
from hexmend_app.picture.cut_shapes import Plane
from hexmend_app.scene.cutting.polygons import Polygons, merge_polygons
from hexmend_app.scene.geometry import plane_sides
from hexmend_app.scene.geometry.edge_flags import clipped, edge_flags, normals_of, set_edge_flags, set_normals
from hexmend_app.scene.layers.surface import coloured, colours_of, hexes_of

#: Tolerance for nodes on a plane, as a fraction of the mesh size; larger than the rounding errors of a box cut.
_TOLERANCE = 1e-8


def sections(
    points: np.ndarray, hexes: np.ndarray, keep: np.ndarray | None, cut: Cut, colours: np.ndarray
) -> pv.PolyData:
    """Return the sections of hexes by planes, as polygons in the colours of the hexes.

    The section by each plane is clipped by the other planes. Only hexes that a plane crosses or touches visibly are
    passed to VTK, which are a few percent. VTK treats nodes on the plane as beyond it, so if two hexes share a face in
    the plane, the remaining hex yields the polygon. Polygons are counter-clockwise as seen from beyond the plane.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    keep : (m,) bool, optional
        True for shown hexes; None for all.
    cut : Cut
        A cut by planes, a box or a slab.
    colours : (m, 3) uint8
    """
    planes = cut.sides
    touched = plane_sides.touched(points, hexes, *half_spaces(planes), cut.notch)
    if keep is not None:
        touched &= keep[:, None]
    parts, owners = [], []
    for i, plane in enumerate(planes):
        crossing = np.flatnonzero(touched[:, i])
        if len(crossing):
            section, owner = _section(points, hexes, crossing, plane)
            visible = section.before(*half_spaces((*planes[:i], *planes[i + 1 :]), beyond=cut.notch))
            parts.append(visible.facing(np.array(plane.normal)))
            owners.append(owner[visible.owner])
    if not sum(map(len, parts)):
        return pv.PolyData()
    owner = np.concatenate(owners)
    return coloured(merge_polygons(parts).data(), colours[owner], owner)


def remaining_hexes(points: np.ndarray, hexes: np.ndarray, cut: Cut) -> np.ndarray:
    """Return True for hexes that a cut leaves at least in part, (m,) bool; nodes on its planes alone do not count.

    Parameters are those of `sections`.
    """
    tolerance = _TOLERANCE * float(np.ptp(points, axis=0).max())
    beyond = [(plane.signed_distance(points) > -tolerance)[hexes].all(axis=1) for plane in cut.sides]
    return ~(np.all(beyond, axis=0) if cut.notch else np.any(beyond, axis=0))


def _section(points: np.ndarray, hexes: np.ndarray, crossing: np.ndarray, plane: Plane) -> tuple[Polygons, np.ndarray]:
    """Return the polygons in which a plane cuts the hexes `crossing`, (j,) int, and the hex of each polygon."""
    nodes, cells = np.unique(hexes[crossing], return_inverse=True)
    grid = pv.UnstructuredGrid({pv.CellType.HEXAHEDRON: cells.reshape(-1, 8)}, points[nodes])
    grid.cell_data["hex"] = crossing
    cutter = vtkPlaneCutter()
    cutter.SetInputData(grid)
    cutter.SetPlane(vtk_plane_of(plane))
    cutter.ComputeNormalsOff()
    cutter.Update()
    found = pv.wrap(cutter.GetOutput())
    if not found.n_cells:
        return Polygons.of(pv.PolyData()), crossing[:0]
    return Polygons.of(found), np.asarray(found.cell_data["hex"])


def remaining_skin(skin: pv.PolyData, cut: Cut) -> pv.PolyData:
    """Return the part of a skin that is not cut away, with its colours."""
    if not skin.GetNumberOfCells():
        return skin
    whole, planes = Polygons.of(skin), cut.sides
    if cut.notch:  # before the first plane; beyond the first and before the second; and so on
        cells = [
            [np.concatenate(both) for both in zip(half_spaces(planes[:i], True), half_spaces((plane,)), strict=True)]
            for i, plane in enumerate(planes)
        ]
        left = merge_polygons([whole.before(*half_spaces) for half_spaces in cells])
    else:
        left = whole.before(*half_spaces(planes))
    data = coloured(left.data(), colours_of(skin)[left.owner], hexes_of(skin)[left.owner])
    flags = edge_flags(skin)
    if flags is not None and len(left):
        edges, normals = clipped(whole, flags[whole.places], normals_of(skin)[whole.places], left)
        set_edge_flags(data, edges)
        set_normals(data, normals)
    return data


def half_spaces(planes: Sequence[Plane], beyond: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Return normals, (k, 3), and offsets, (k,), of the half-spaces in front of planes, or beyond them."""
    sign = -1.0 if beyond else 1.0
    normals = np.array([plane.normal for plane in planes]).reshape(-1, 3)
    return sign * normals, sign * np.array([plane.equation[1] for plane in planes])


def vtk_plane_of(plane: Plane) -> vtkPlane:
    vtk_plane = vtkPlane()
    vtk_plane.SetNormal(plane.normal)
    vtk_plane.SetOrigin(plane.point)
    return vtk_plane
