"""The smooth cut: sections of hexes by planes, and the remaining skin."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pyvista as pv
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkPlaneCutter

from hexmend_app.picture.cut_planes import Clip, ClipPlane
from hexmend_app.scene.cutting.polygons import Polygons, together
from hexmend_app.scene.geometry import plane_sides
from hexmend_app.scene.layers.surface import coloured, colours_of, hexes_of

#: Distance from a plane, relative to the mesh, up to which a node is on it; more than a box stands out of itself.
_NEARLY = 1e-8


def sections(
    points: np.ndarray, hexes: np.ndarray, keep: np.ndarray | None, clip: Clip, colours: np.ndarray
) -> pv.PolyData:
    """Return the sections of hexes by planes, as polygons in the colours of the hexes.

    The section by each plane is seen as far as the others leave it open. Only hexes that a plane crosses or touches
    there are handed to VTK, a few in a hundred. To VTK a node on the plane lies beyond it: of two hexes whose common
    face lies in the plane, the one that is kept gives the polygon. All are counter-clockwise as seen from beyond.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    keep : (m,) bool, optional
        Hexes that are shown at all.
    clip : PlaneClip or BoxClip
    colours : (m, 3) uint8
    """
    planes = clip.planes
    touched = plane_sides.touched(points, hexes, *_half_spaces(planes), clip.notch)
    if keep is not None:
        touched &= keep[:, None]
    seen, owners = [], []
    for at, plane in enumerate(planes):
        chosen = np.flatnonzero(touched[:, at])
        if len(chosen):
            part, owner = _section(points, hexes, chosen, plane)
            left = part.before(*_half_spaces((*planes[:at], *planes[at + 1 :]), beyond=clip.notch))
            seen.append(left.facing(np.array(plane.normal)))
            owners.append(owner[left.owner])
    if not sum(map(len, seen)):
        return pv.PolyData()
    shown = np.concatenate(owners)
    return coloured(together(seen).data(), colours[shown], shown)


def left(points: np.ndarray, hexes: np.ndarray, clip: Clip) -> np.ndarray:
    """Return False for hexes that a cut removes whole, or except for nodes on it, (m,) bool.

    Parameters are those of `sections`.
    """
    nearly = _NEARLY * float(np.ptp(points, axis=0).max())
    beyond = [(plane.signed_distance(points) > -nearly)[hexes].all(axis=1) for plane in clip.planes]
    return ~(np.all(beyond, axis=0) if clip.notch else np.any(beyond, axis=0))


def _section(
    points: np.ndarray, hexes: np.ndarray, chosen: np.ndarray, plane: ClipPlane
) -> tuple[Polygons, np.ndarray]:
    """Return the section polygons of some hexes by a plane, and the hex of each."""
    nodes, cells = np.unique(hexes[chosen], return_inverse=True)
    grid = pv.UnstructuredGrid({pv.CellType.HEXAHEDRON: cells.reshape(-1, 8)}, points[nodes])
    grid.cell_data["hex"] = chosen
    cutter = vtkPlaneCutter()
    cutter.SetInputData(grid)
    cutter.SetPlane(_vtk(plane))
    cutter.ComputeNormalsOff()
    cutter.Update()
    cut = pv.wrap(cutter.GetOutput())
    if not cut.n_cells:
        return Polygons.of(pv.PolyData()), chosen[:0]
    return Polygons.of(cut), np.asarray(cut.cell_data["hex"])


def behind(skin: pv.PolyData, clip: Clip) -> pv.PolyData:
    """Return the part of a skin that is not cut away, with its colours."""
    if not skin.GetNumberOfCells():
        return skin
    whole, planes = Polygons.of(skin), clip.planes
    if clip.notch:  # before the first plane; beyond that, before the second; and so on
        halves = [
            [np.concatenate(both) for both in zip(_half_spaces(planes[:at], True), _half_spaces((plane,)), strict=True)]
            for at, plane in enumerate(planes)
        ]
        left = together([whole.before(*half) for half in halves])
    else:
        left = whole.before(*_half_spaces(planes))
    return coloured(left.data(), colours_of(skin)[left.owner], hexes_of(skin)[left.owner])


def _half_spaces(planes: Sequence[ClipPlane], beyond: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Return normals (k, 3) and offsets (k,) of the half-spaces before planes, or beyond them."""
    sign = -1.0 if beyond else 1.0
    normals = np.array([plane.normal for plane in planes]).reshape(-1, 3)
    return sign * normals, sign * np.array([plane.equation[1] for plane in planes])


def _vtk(plane: ClipPlane) -> vtkPlane:
    answer = vtkPlane()
    answer.SetNormal(plane.normal)
    answer.SetOrigin(plane.origin)
    return answer
