"""Smooth cuts: sections of hexes by planes, and the remaining skin."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pyvista as pv
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkPlaneCutter

from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order.curved_geometry import hex_nodes
from hexmend.mesh.solid_cells import HEXAHEDRON, rows_by_kind
from hexmend_app.picture.cut import Cut
from hexmend_app.picture.cut_shapes import Plane
from hexmend_app.scene.geometry.coloured_polygons import coloured, colours_of, hexes_of
from hexmend_app.scene.geometry.curved_elements import evaluate_hexes
from hexmend_app.scene.geometry.polygons import Polygons, merge_polygons
from hexmend_app.state.mesh.inspection import all_mid_nodes

#: Tolerances as fractions of the mesh size: for points on a plane, below the distance of the sides of a box from nodes
#: on them, and for hexes that only touch a plane, above it.
_ON_PLANE, _TOUCHING = 1e-10, 1e-8

#: Types of VTK's cells by their numbers of nodes.
_VTK_TYPES = {8: pv.CellType.HEXAHEDRON, 6: pv.CellType.WEDGE, 5: pv.CellType.PYRAMID, 4: pv.CellType.TETRA}

#: Eight bytes that are 1.
_ALL_BELOW = 0x0101010101010101

#: Fraction of the extent of the nodes of a curved hex by which the hex may reach beyond them.
_MARGIN = 0.5


def sections(
    mesh: Mesh, keep: np.ndarray | None, cut: Cut, colours: np.ndarray, divisions: int | None = None
) -> pv.PolyData:
    """Return the sections of cells by planes, as polygons in the colours of the cells; curved ones have edge flags.

    Only hexes that a plane crosses are passed to VTK, which are a few percent. The section by each plane is clipped by
    the other planes. Points on a plane count as beyond it in all hexes that share them, so that a face in the plane is
    drawn once. Polygons are counter-clockwise as seen from beyond the plane.

    Parameters
    ----------
    mesh : Mesh
    keep : (m,) bool, optional
        True for shown hexes; None for all.
    cut : Cut
        A cut by planes, a box or a slab.
    colours : (m, 3) uint8
    divisions : int, optional
        Number of small hexes along each edge into which a hex with mid-nodes is divided; None cuts flat hexes.
    """
    planes, parts = cut.sides, []
    for i, plane in enumerate(planes):
        section = _section(mesh, keep, plane, divisions)
        visible = section.before(*half_spaces((*planes[:i], *planes[i + 1 :]), beyond=cut.notch))
        if len(visible):
            parts.append(visible)
    if not parts:
        return pv.PolyData()
    merged = merge_polygons(parts)
    return coloured(merged.data(), colours[merged.owner], merged.owner)


def remaining_hexes(points: np.ndarray, hexes: np.ndarray, cut: Cut) -> np.ndarray:
    """Return True for hexes that a cut leaves at least in part, (m,) bool; nodes on its planes alone do not count.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    cut : Cut
    """
    tolerance = _TOUCHING * float(np.ptp(points, axis=0).max())
    beyond = [(plane.signed_distance(points) > -tolerance)[hexes].all(axis=1) for plane in cut.sides]
    return ~(np.all(beyond, axis=0) if cut.notch else np.any(beyond, axis=0))


def remaining_points(points: np.ndarray, cut: Cut) -> np.ndarray:
    """Return True for points, (k, 3), that a smooth cut leaves, (k,) bool; other cuts leave all."""
    return ~cut.hidden(points) if cut.smooth else np.ones(len(points), dtype=bool)


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
    return coloured(left.data(), colours_of(skin)[left.owner], hexes_of(skin)[left.owner])


def half_spaces(planes: Sequence[Plane], beyond: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Return normals, (k, 3), and offsets, (k,), of the half-spaces in front of planes, or beyond them."""
    sign = -1.0 if beyond else 1.0
    normals = np.array([plane.normal for plane in planes]).reshape(-1, 3)
    return sign * normals, sign * np.array([plane.equation[1] for plane in planes])


def _section(mesh: Mesh, keep: np.ndarray | None, plane: Plane, divisions: int | None) -> Polygons:
    """Return the polygons in which a plane cuts cells; the owners are the cells."""
    distances = plane.signed_distance(mesh.points)
    tolerance = _ON_PLANE * float(np.abs(distances).max())
    crossing = _crossing(mesh, keep, distances, tolerance, divisions is not None)
    parts = [Polygons.of(pv.PolyData())]
    for kind, rows in rows_by_kind(mesh.elements[crossing]):
        cells = crossing[rows]
        nodes = mesh.elements[cells, : kind.nodes]
        if divisions is None or kind is not HEXAHEDRON:
            at, pieces = np.zeros((kind.nodes, 3)), np.arange(kind.nodes)[None]
            points = mesh.points[nodes]
        else:
            at, pieces = _lattice(divisions)
            points = evaluate_hexes(hex_nodes(mesh.points, nodes, mesh.mid_nodes[cells]), at)
        found = _cut_pieces(points, pieces, at, plane, tolerance)
        if not found.GetNumberOfCells():
            continue
        section = Polygons.of(found).facing(np.array(plane.normal))
        section = replace(section, owner=cells[np.asarray(found.cell_data["cell"])])
        if divisions is not None:
            flags = _on_faces(section, np.asarray(found.point_data["at"]))
            normals = np.broadcast_to(np.array(plane.normal, dtype=np.float32), (len(flags), 3))
            section = replace(section, flags=flags, normals=normals)
        parts.append(section)
    return merge_polygons(parts[1:] or parts)


def _cut_pieces(points: np.ndarray, pieces: np.ndarray, at: np.ndarray, plane: Plane, tolerance: float) -> pv.PolyData:
    """Cut the pieces (d, nodes) of each of some cells by a plane, which the polygons name as "cell".

    Parameters
    ----------
    points : (k, g, 3) float64
        Points of each cell.
    at : (g, 3) float64
        Position of each point in the unit cube of its cell; interpolated in the polygons.
    """
    distances = plane.signed_distance(points.reshape(-1, 3)).reshape(points.shape[:2])
    on = np.abs(distances) < tolerance
    points[on] += (tolerance - distances[on])[:, None] * np.array(plane.normal)
    below = (distances < -tolerance)[:, pieces].sum(axis=2)
    which, piece = np.nonzero((below > 0) & (below < pieces.shape[1]))
    if not len(which):
        return pv.PolyData()
    corners = which[:, None] * len(at) + pieces[piece]
    grid = pv.UnstructuredGrid({_VTK_TYPES[pieces.shape[1]]: corners}, points.reshape(-1, 3))
    grid.cell_data["cell"] = which
    grid.point_data["at"] = np.tile(at, (len(points), 1))
    return _cut_by_vtk(grid, plane)


def _crossing(mesh: Mesh, keep: np.ndarray | None, distances: np.ndarray, tolerance: float, curved: bool) -> np.ndarray:
    """Return the shown hexes that a plane crosses or, if they are curved, may cross, (k,) int64."""
    if curved:
        low = high = distances[mesh.elements[:, 0]]
        for nodes in (*mesh.elements.T[1:], *all_mid_nodes(mesh).T):
            here = np.where(nodes >= 0, distances[nodes], low)
            low, high = np.minimum(low, here), np.maximum(high, here)
        margin = _MARGIN * (high - low)
        crossed = (low - margin < 0) & (high + margin > 0)
    else:
        # The eight corners of a cell as a number.
        below = (distances < -tolerance)[mesh.elements].view(np.uint64).ravel()
        crossed = (below != 0) & (below != _ALL_BELOW)
    return np.flatnonzero(crossed if keep is None else crossed & keep)


def _cut_by_vtk(grid: pv.UnstructuredGrid, plane: Plane) -> pv.PolyData:
    vtk_plane = vtkPlane()
    vtk_plane.SetNormal(plane.normal)
    vtk_plane.SetOrigin(plane.point)
    cutter = vtkPlaneCutter()
    cutter.SetInputData(grid)
    cutter.SetPlane(vtk_plane)
    cutter.ComputeNormalsOff()
    cutter.InterpolateAttributesOn()
    cutter.Update()
    return pv.wrap(cutter.GetOutput())


def _on_faces(section: Polygons, at: np.ndarray) -> np.ndarray:
    """Return True for corners of polygons whose edge to the next corner lies on a face of its hex, (c,) bool.

    Parameters
    ----------
    section : Polygons
    at : (p, 3) float64
        Position of each point in the unit cube of its hex.
    """
    ends = np.stack([at, 1 - at], axis=1).reshape(-1, 6)[section.places] < 1e-9
    return (ends & ends[section.following]).any(axis=1)


def _lattice(divisions: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the points of a lattice of the unit cube, (g, 3), and the small hexes between them, (divisions^3, 8)."""
    side = divisions + 1
    at = np.stack(np.meshgrid(*[np.arange(side)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    strides = np.array([side * side, side, 1])
    first = at[(at < divisions).all(axis=1)] @ strides
    return at / divisions, first[:, None] + UNIT_CUBE.astype(np.int64) @ strides
