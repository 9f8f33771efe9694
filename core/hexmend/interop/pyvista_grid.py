"""Conversion of meshes to and from PyVista's unstructured grids; no other module of the core names PyVista."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np

from hexmend.errors import MeshError
from hexmend.interop.meshio_mesh import convert_to_mesh, import_library, with_side_marks
from hexmend.io.formats.vtk.grid import Grid, from_mesh, to_mesh
from hexmend.io.formats.vtk.merge_grids import merge_grids
from hexmend.mesh.mesh import Mesh

#: Kinds of NumPy types that PyVista's grids can hold: bool, int, float, complex and str.
_KINDS = "biufcU"
#: Kinds that they cannot hold: bytes, dates, durations, Python objects and records.
_UNSUPPORTED_KINDS = "SMmOV"


def to_pyvista(mesh: Mesh) -> Any:
    """Convert a mesh to a PyVista grid: hexes, cells of other kinds, data and sets.

    Point data and cell data are those of the nodes and the cells. A node set, element set or side set "inlet" is an
    array too: "set:inlet" of the points or of the cells is 1 for its members, and bit k of "sides:inlet" of a cell
    marks face k. Point data "fixed" are 1 for nodes that are marked as fixed. Data of hexes alone are NaN or 0 for
    other cells. Left out are the name and the notes of the mesh, sets without members and the order of members.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    pyvista.UnstructuredGrid
        A copy: changing it does not change the mesh. Its cells are of VTK's types 12, 25 or 29 for hexes of 8, 20 or
        27 nodes.

    Raises
    ------
    InstallationError
        Where PyVista is not installed.

    Warns
    -----
    UserWarning
        For arrays that PyVista cannot hold, which are left out.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> to_pyvista(make("cube", size=27)).n_cells  # doctest: +SKIP
    27
    """
    pyvista = import_library("pyvista")
    converted = from_mesh(with_side_marks(mesh), _KINDS + _UNSUPPORTED_KINDS)
    grid = pyvista.UnstructuredGrid()
    grid.points = np.array(converted.points)
    cells = pyvista.CellArray.from_arrays(converted.start, converted.nodes, deep=True)
    grid.SetCells(pyvista.convert_array(converted.types, deep=True), cells)
    targets = (grid.point_data, grid.cell_data, grid.field_data)
    tables = zip(targets, (converted.node_data, converted.cell_data, converted.field_data), strict=True)
    arrays = [(target, name, values) for target, table in tables for name, values in table.items()]
    unsupported = [name for target, name, values in arrays if not _set_array(target, name, values)]
    if unsupported:
        warnings.warn(f"arrays that PyVista cannot hold are left out: {', '.join(unsupported)}", stacklevel=2)
    return grid


def from_pyvista(grid: Any, *, as_is: bool = False) -> Mesh:
    """Convert a PyVista data set with hexahedra: its hexes, cells of other kinds, data and sets.

    Arrays named as `to_pyvista` names them become sets and marks of fixed nodes again. Cells of other kinds are handled
    as in a file: see `hexmend.read`.

    Parameters
    ----------
    grid : pyvista.DataSet
        Any data set with hexahedra or voxels: an unstructured grid, a structured grid, an image... VTK's own objects
        are taken too.
    as_is : bool
        Keep hexes that are numbered left-handed; else they are renumbered.

    Returns
    -------
    Mesh
        A copy: changing the grid does not change it. Its `notes` list the changes.

    Raises
    ------
    InstallationError
        Where PyVista is not installed.
    MeshError
        For an object that is no data set or holds no hexahedra, and for cells or points that make no mesh.
    """
    pyvista = import_library("pyvista")
    if not isinstance(grid, pyvista.DataObject) and hasattr(grid, "IsA"):
        grid = pyvista.wrap(grid)
    if not isinstance(grid, pyvista.DataSet):
        hint = ": join its blocks with combine()" if isinstance(grid, pyvista.MultiBlock) else ""
        expected = "expected a PyVista data set with hexahedra, such as an UnstructuredGrid"
        raise MeshError(f"from_pyvista() was given an object of type {type(grid).__name__}{hint}; {expected}")
    if not isinstance(grid, pyvista.UnstructuredGrid):
        grid = grid.cast_to_unstructured_grid()
    start = np.array(grid.cell_offsets if hasattr(type(grid), "cell_offsets") else grid.offset, np.int64)
    nodes, points = np.array(grid.cell_connectivity, np.int64), np.array(grid.points, np.float64)
    fields = {name: _field(values) for name, values in grid.field_data.items()}
    data = _arrays(grid.point_data), _arrays(grid.cell_data), fields
    read = Grid(points, np.array(grid.celltypes), start, nodes, *data)
    return convert_to_mesh("PyVista grid", lambda title: to_mesh(title, merge_grids([read])), as_is)


def _set_array(attributes: Any, name: str, values: object) -> bool:
    """Add a copy of an array to a grid; returns False if PyVista cannot hold it."""
    array = np.asarray(values)
    if array.dtype.kind == "U":
        return _set_texts(attributes, name, array)
    if array.dtype.kind == "f" and array.itemsize < 4:
        array = array.astype(np.float32)
    if array.dtype.kind not in _KINDS or not array.size:
        return not array.size
    array = array.astype(array.dtype.newbyteorder("="), copy=False)
    try:
        attributes.set_array(array.reshape(len(array), -1) if array.ndim > 2 else array, name, deep_copy=True)
    except (TypeError, ValueError):
        return False
    return True


def _set_texts(attributes: Any, name: str, texts: np.ndarray) -> bool:
    """Add texts to a grid through VTK, because PyVista itself accepts ASCII only."""
    if texts.ndim > 1:
        return False
    texts = np.atleast_1d(texts)
    array = import_library("pyvista").convert_string_array(np.array([""]))
    array.SetNumberOfValues(len(texts))
    for index, text in enumerate(texts.tolist()):
        array.SetValue(index, text)
    array.SetName(name)
    attributes.VTKObject.AddArray(array)
    return True


def _arrays(data: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    return {name: np.array(values, subok=False) for name, values in data.items()}


def _field(values: object) -> np.ndarray | list[str]:
    """Convert field data to the form of the file readers: numbers as an array, texts as a list."""
    array = np.atleast_1d(np.array(values, subok=False))
    return [str(text) for text in array.ravel()] if array.dtype.kind == "U" else array
