"""CGNS files of the ADF kind, read by VTK; the core itself reads those on HDF5, with more of their data."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import Block, Content, concatenate_data, to_mesh
from hexmend.io.base.format import Format
from hexmend.io.formats.cgns import ADF_MARK
from hexmend.io.formats.cgns.reader import JOIN_HINT
from hexmend.io.formats.cgns.structured import structured_hexes
from hexmend.io.formats.vtk.grid import KIND_BY_TYPE, WIDTH_BY_TYPE
from hexmend.io.storage import subprocess_reader
from hexmend.mesh.mesh import Mesh
from hexmend_app.formats.adf_links import check_links


def read(path: Path) -> Mesh:
    """Read a CGNS file by VTK, in a subprocess, since the library may crash on a damaged one."""
    return to_mesh(path, subprocess_reader.run_reader("hexmend_app.formats.cgns_adf:content", path))


def content(path: Path) -> Content:
    """Read the content of a file by VTK: zones of three dimensions, with their solutions."""
    from vtkmodules.vtkIOCGNSReader import vtkCGNSReader

    check_links(path)
    reader = vtkCGNSReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    reader.EnableAllBases()
    reader.EnableAllPointArrays()
    reader.EnableAllCellArrays()
    reader.Update()
    zones = [zone for zone in _leaves(reader.GetOutput()) if zone[1].GetNumberOfCells()]
    if not zones:
        raise FileError(
            path, "VTK finds no cells in it", "Write the file again with the program that made it, or on HDF5."
        )
    notes = ["Of a CGNS file of the ADF kind, boundary conditions are left out; adf2hdf makes a file that has them."]
    if len(zones) > 1:
        notes.append(f"{len(zones)} zones are read as one mesh; VTK does not report where they meet. {JOIN_HINT}")
    points, blocks, data, first = [], [], [], 0
    for name, zone in zones:
        here = _array(zone.GetPoints().GetData()).astype(np.float64)
        for block in _blocks(zone, here):
            sets = {name: np.arange(len(block))} if len(zones) > 1 and name else {}
            blocks.append(Block(block.kind, block.nodes + first, block.data, sets))
        points.append(here)
        data.append(_arrays(zone.GetPointData()))
        first += len(here)
    node_data = concatenate_data(data, [len(part) for part in points])
    return Content(np.concatenate(points), tuple(blocks), node_data, notes=tuple(notes))


def recognised(head: bytes) -> bool:
    """Return True if a file begins like CGNS of the ADF kind."""
    return ADF_MARK in head[:64]


def _leaves(data: object, name: str = "") -> list[tuple[str, object]]:
    """Names and grids of the leaves of a multi-block dataset."""
    if not data.IsA("vtkMultiBlockDataSet"):
        return [(name, data)]
    found = []
    for k in range(data.GetNumberOfBlocks()):
        block, more = data.GetBlock(k), data.GetMetaData(k) if data.HasMetaData(k) else None
        if block is not None:
            found += _leaves(block, more.Get(data.NAME()) if more is not None and more.Has(data.NAME()) else name)
    return found


def _blocks(zone: object, points: np.ndarray) -> list[Block]:
    """Blocks of the cells of a grid, one for each kind."""
    data = _arrays(zone.GetCellData())
    if zone.IsA("vtkStructuredGrid"):
        count = np.zeros(3, np.int32)
        zone.GetDimensions(count)
        return [Block("hex", structured_hexes(points, count.astype(np.int64))[0], data)] if (count > 1).all() else []
    if not zone.IsA("vtkUnstructuredGrid"):
        return []
    types, start = _array(zone.GetCellTypes()), _array(zone.GetCells().GetOffsetsArray()).astype(np.int64)
    nodes, answer = _array(zone.GetCells().GetConnectivityArray()).astype(np.int64), []
    for number in dict.fromkeys(types.tolist()):
        chosen = np.flatnonzero(types == number)
        if number in KIND_BY_TYPE and (np.diff(start)[chosen] == WIDTH_BY_TYPE[number]).all():
            rows = nodes[start[chosen][:, None] + np.arange(WIDTH_BY_TYPE[number])]
            answer.append(Block(KIND_BY_TYPE[number], rows, {name: values[chosen] for name, values in data.items()}))
    return answer


def _arrays(of: object) -> dict[str, np.ndarray]:
    """Numeric arrays of point or cell data, without those that VTK adds."""
    arrays = [of.GetArray(k) for k in range(of.GetNumberOfArrays())]
    return {one.GetName(): _array(one) for one in arrays if one is not None and not one.GetName().startswith("vtk")}


def _array(values: object) -> np.ndarray:
    from vtkmodules.util.numpy_support import vtk_to_numpy

    return np.array(vtk_to_numpy(values))


def matches(head: bytes) -> bool:
    """Return True if a file begins as CGNS files of the ADF kind do."""
    return ADF_MARK in head[:64]


FORMAT = Format(name="cgns-adf", title="CGNS (ADF)", suffixes=(".cgns",), encodings=(), read=read, matches=matches)
