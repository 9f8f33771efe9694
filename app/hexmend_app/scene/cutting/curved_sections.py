"""Sections of second-order hexes by planes; each hex is divided into small hexes, which are cut."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkFiltersCore import vtkPlaneCutter

from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order.curved_geometry import hex_nodes
from hexmend_app.picture.cut import Cut
from hexmend_app.picture.cut_shapes import Plane
from hexmend_app.scene.cutting.cut import half_spaces, vtk_plane_of
from hexmend_app.scene.cutting.polygons import Polygons, merge_polygons
from hexmend_app.scene.geometry.curved_elements import evaluate_hexes
from hexmend_app.scene.geometry.edge_flags import clipped, set_edge_flags, set_normals
from hexmend_app.scene.layers.surface import coloured

#: Tolerance for points on a plane, as a fraction of the mesh size: they count as beyond it, in all hexes that share
#: them, so that a face in the plane is drawn once.
_TOLERANCE = 1e-8

#: Fraction of the extent of the nodes of a hex by which the hex may reach beyond them.
_MARGIN = 0.5


def curved_sections(mesh: Mesh, keep: np.ndarray | None, cut: Cut, colours: np.ndarray, divisions: int) -> pv.PolyData:
    """Return the sections of second-order hexes by planes, as polygons with edge flags and normals.

    Parameters
    ----------
    mesh : Mesh
        Mesh with mid-nodes.
    keep : (m,) bool, optional
        True for shown hexes; None for all.
    cut : Cut
        A cut by planes, a box or a slab.
    colours : (m, 3) uint8
    divisions : int
        Number of divisions of each edge.

    Returns
    -------
    pyvista.PolyData
        In the colours of the hexes; polygons are counter-clockwise as seen from beyond the plane.
    """
    planes, size = cut.sides, float(np.ptp(mesh.points, axis=0).max())
    parts, owners, flags, normals = [], [], [], []
    for i, plane in enumerate(planes):
        crossing = _crossing(mesh, keep, plane)
        section, of_section, edges = _section(mesh, crossing, plane, divisions, _TOLERANCE * size)
        if not len(section):
            continue
        facing = np.broadcast_to(np.array(plane.normal, dtype=np.float32), (len(section.places), 3))
        others = (*planes[:i], *planes[i + 1 :])
        visible = section.before(*half_spaces(others, cut.notch)).facing(np.array(plane.normal)) if others else section
        if len(visible):
            edges, facing = clipped(section, edges, facing, visible) if others else (edges, facing)
            parts.append(visible.separated())
            owners.append(of_section[visible.owner])
            flags.append(edges)
            normals.append(facing)
    if not parts:
        return pv.PolyData()
    poly, owner = merge_polygons(parts).data(), np.concatenate(owners)
    set_edge_flags(poly, np.concatenate(flags))
    set_normals(poly, np.concatenate(normals))
    return coloured(poly, colours[owner], owner)


def _crossing(mesh: Mesh, keep: np.ndarray | None, plane: Plane) -> np.ndarray:
    """Return the shown hexes that a plane may cross, (k,) int64."""
    distances = plane.signed_distance(mesh.points)
    low = high = distances[mesh.hexes[:, 0]]
    for nodes in (*mesh.hexes.T[1:], *mesh.mid_nodes.T):
        here = np.where(nodes >= 0, distances[nodes], low)
        low, high = np.minimum(low, here), np.maximum(high, here)
    margin = _MARGIN * (high - low)
    crossed = (low - margin < 0) & (high + margin > 0)
    return np.flatnonzero(crossed if keep is None else crossed & keep)


def _section(
    mesh: Mesh, crossing: np.ndarray, plane: Plane, divisions: int, tolerance: float
) -> tuple[Polygons, np.ndarray, np.ndarray]:
    """Return the sections of hexes, (j,) int64, by a plane, the hex of each, and flags of their edges on its faces."""
    at, cells = _lattice(divisions)
    nodes = hex_nodes(mesh.points, mesh.hexes[crossing], mesh.mid_nodes[crossing])
    points = evaluate_hexes(nodes, at)
    distances = plane.signed_distance(points.reshape(-1, 3)).reshape(points.shape[:2])
    on = np.abs(distances) < tolerance
    points[on] += (tolerance - distances[on])[:, None] * np.array(plane.normal)
    distances[on] = tolerance
    corners = distances[:, cells]
    which, cell = np.nonzero((corners.min(axis=2) < 0) & (corners.max(axis=2) > 0))
    if not len(which):
        return Polygons.of(pv.PolyData()), crossing[:0], np.zeros(0, dtype=bool)
    used, numbers = np.unique(which[:, None] * len(at) + cells[cell], return_inverse=True)
    grid = pv.UnstructuredGrid({pv.CellType.HEXAHEDRON: numbers.reshape(-1, 8)}, points.reshape(-1, 3)[used])
    grid.cell_data["hex"] = crossing[which]
    grid.point_data["at"] = at[used % len(at)]
    cutter = vtkPlaneCutter()
    cutter.SetInputData(grid)
    cutter.SetPlane(vtk_plane_of(plane))
    cutter.ComputeNormalsOff()
    cutter.InterpolateAttributesOn()
    cutter.Update()
    found = pv.wrap(cutter.GetOutput())
    if not found.n_cells:
        return Polygons.of(pv.PolyData()), crossing[:0], np.zeros(0, dtype=bool)
    section = Polygons.of(found).facing(np.array(plane.normal))
    return section, np.asarray(found.cell_data["hex"]), _on_faces(section, np.asarray(found.point_data["at"]))


def _on_faces(section: Polygons, at: np.ndarray) -> np.ndarray:
    """Return True for corners of polygons whose edge to the next corner lies on a face of its hex, (c,) bool.

    Parameters
    ----------
    section : Polygons
    at : (p, 3) float64
        Position of each point in the unit cube of its hex.
    """
    following = np.arange(1, len(section.places) + 1)
    following[section.start[1:] - 1] = section.start[:-1]
    ends = np.stack([at, 1 - at], axis=1).reshape(-1, 6)[section.places] < 1e-9
    return (ends & ends[following]).any(axis=1)


def _lattice(divisions: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the points of a lattice of the unit cube, (g, 3), and the small hexes between them, (divisions^3, 8)."""
    side = divisions + 1
    at = np.stack(np.meshgrid(*[np.arange(side)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    strides = np.array([side * side, side, 1])
    first = at[(at < divisions).all(axis=1)] @ strides
    return at / divisions, first[:, None] + UNIT_CUBE.astype(np.int64) @ strides
