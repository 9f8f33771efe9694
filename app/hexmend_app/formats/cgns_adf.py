"""Reader of CGNS files based on ADF, by VTK; the core reads files based on HDF5, with more of their data."""

from __future__ import annotations

import mmap
import struct
from pathlib import Path
from typing import Any

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import Block, Content, concatenate_data, to_mesh
from hexmend.io.base.format import Format
from hexmend.io.formats.cgns import ADF_MARK
from hexmend.io.formats.cgns.reader import JOIN_HINT
from hexmend.io.formats.cgns.structured import structured_hexes
from hexmend.io.formats.vtk.grid import KIND_BY_TYPE, WIDTH_BY_TYPE
from hexmend.io.storage import subprocess_reader
from hexmend.mesh.materials import STRUCTURED_BLOCKS
from hexmend.mesh.mesh import Mesh

#: Position and text of the file signature; the CGNS library treats all other files as HDF5.
_SIGNATURE = slice(4, 24), b"ADF Database Version"
#: Signature and length of a node header, in bytes: its name is at 4, its type at 96 ("LK" for a link), the number of
#: data chunks at 226, and their block and offset at 230.
_NODE, _HEADER = b"NoDe", 246
#: Length of a block, and offset of the text in the data of a link, in bytes.
_BLOCK, _TEXT_OFFSET = 4096, 16


def check_links(path: Path) -> None:
    """Raise `FileError` if a node is a link to another file.

    The text of a link consists of a file name, ">", and a path in the file; the name is empty for links within a file.
    """
    with open(path, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        if data[_SIGNATURE[0]] != _SIGNATURE[1]:
            raise FileError(
                path, "is not a CGNS file based on ADF: its signature is missing", "Write it again, based on HDF5."
            )
        at = data.find(_NODE)
        while at >= 0:
            header = data[at : at + _HEADER]
            if header[96:98] == b"LK" and not _is_internal(data, header, at + _HEADER):
                name = header[4:36].decode("ascii", "replace").strip()
                raise FileError(
                    path,
                    f"its node {name!r} is a link to another file, which is not followed",
                    "Write all data into one file with the program that made it.",
                )
            at = data.find(_NODE, at + 1)


def _is_internal(data: mmap.mmap, header: bytes, end: int) -> bool:
    """Return True if the text of a link immediately follows its header and has no file name."""
    block, offset = divmod(end, _BLOCK)
    addresses = struct.pack("<qi", block, offset), struct.pack(">qi", block, offset), b"%08X%04X" % (block, offset)
    follows = header[226:230] == b"0001" and header[230:242].upper() in {address.upper() for address in addresses}
    return follows and data[end : end + 4] == b"DaTa" and data[end + _TEXT_OFFSET : end + _TEXT_OFFSET + 1] == b">"


def read(path: Path) -> Mesh:
    """Read a CGNS file in a subprocess, because the CGNS library may crash on damaged files."""
    return to_mesh(path, subprocess_reader.run_reader("hexmend_app.formats.cgns_adf:content", path))


def content(path: Path) -> Content:
    """Return the content of a CGNS file: three-dimensional zones with their solutions."""
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
            path, "contains no cells that VTK can read", "Write it again with the program that made it, based on HDF5."
        )
    notes = [
        "Boundary conditions of CGNS files based on ADF are not read; adf2hdf converts the file to one with all data."
    ]
    if len(zones) > 1:
        notes.append(f"{len(zones)} zones are read as one mesh; VTK does not report their connections. {JOIN_HINT}")
    points, blocks, data, first = [], [], [], 0
    for name, zone in zones:
        zone_points = _array(zone.GetPoints().GetData()).astype(np.float64)
        for block in _blocks(zone, zone_points):
            sets = {name: np.arange(len(block))} if len(zones) > 1 and name else {}
            blocks.append(Block(block.kind, block.nodes + first, block.data, sets))
        points.append(zone_points)
        data.append(_arrays(zone.GetPointData()))
        first += len(zone_points)
    node_data = concatenate_data(data, [len(part) for part in points])
    grids = [name for name, zone in zones if name and zone.IsA("vtkStructuredGrid")] if len(zones) > 1 else []
    fields = {STRUCTURED_BLOCKS: grids} if grids else {}  # blocks of a grid are no materials
    return Content(np.concatenate(points), tuple(blocks), node_data, field_data=fields, notes=tuple(notes))


def _leaves(data: Any, name: str = "") -> list[tuple[str, Any]]:
    """Return names and grids of the leaves of a multi-block dataset."""
    if not data.IsA("vtkMultiBlockDataSet"):
        return [(name, data)]
    leaves = []
    for k in range(data.GetNumberOfBlocks()):
        block, metadata = data.GetBlock(k), data.GetMetaData(k) if data.HasMetaData(k) else None
        if block is not None:
            named = metadata is not None and metadata.Has(data.NAME())
            leaves += _leaves(block, metadata.Get(data.NAME()) if named else name)
    return leaves


def _blocks(zone: Any, points: np.ndarray) -> list[Block]:
    """Return the cells of a grid as one block for each cell type."""
    data = _arrays(zone.GetCellData())
    if zone.IsA("vtkStructuredGrid"):
        count = np.zeros(3, np.int32)
        zone.GetDimensions(count)
        return [Block("hex", structured_hexes(points, count.astype(np.int64))[0], data)] if (count > 1).all() else []
    if not zone.IsA("vtkUnstructuredGrid"):
        return []
    types, start = _array(zone.GetCellTypes()), _array(zone.GetCells().GetOffsetsArray()).astype(np.int64)
    nodes, blocks = _array(zone.GetCells().GetConnectivityArray()).astype(np.int64), []
    for cell_type in dict.fromkeys(types.tolist()):
        cells = np.flatnonzero(types == cell_type)
        if cell_type in KIND_BY_TYPE and (np.diff(start)[cells] == WIDTH_BY_TYPE[cell_type]).all():
            rows = nodes[start[cells][:, None] + np.arange(WIDTH_BY_TYPE[cell_type])]
            blocks.append(Block(KIND_BY_TYPE[cell_type], rows, {name: values[cells] for name, values in data.items()}))
    return blocks


def _arrays(data: Any) -> dict[str, np.ndarray]:
    """Return the numeric arrays of point or cell data by name, without those that VTK adds."""
    arrays = [data.GetArray(k) for k in range(data.GetNumberOfArrays())]
    return {a.GetName(): _array(a) for a in arrays if a is not None and not a.GetName().startswith("vtk")}


def _array(values: object) -> np.ndarray:
    from vtkmodules.util.numpy_support import vtk_to_numpy

    return np.array(vtk_to_numpy(values))


def matches(head: bytes) -> bool:
    """Return True if a file begins like a CGNS file based on ADF."""
    return ADF_MARK in head[:64]


FORMAT = Format(name="cgns-adf", title="CGNS (ADF)", suffixes=(".cgns",), encodings=(), read=read, matches=matches)
