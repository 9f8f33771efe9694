"""Writing of VTKHDF, version 2.2: one part without compression, as fast as the disk (VTK's manual)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from hexmend.io.base.capabilities import non_numeric_data
from hexmend.io.base.fixed_marks import with_marks
from hexmend.io.base.hdf5_output import writable_file
from hexmend.io.base.unique_names import altered_names, make_unique
from hexmend.io.formats.vtk.grid import from_mesh
from hexmend.io.formats.vtk.vtu_writer import writable
from hexmend.io.storage.file_progress import report
from hexmend.mesh.mesh import Mesh

_VERSION = (2, 2)


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write a mesh; sets and fixed nodes become arrays as in VTU.

    Raises
    ------
    FileError
        For an array of a type that VTK does not have.
    """
    grid = from_mesh(mesh, "biuf")
    with writable_file(path) as file:
        root = file.create_group("VTKHDF", track_order=True)
        root.attrs["Version"] = _VERSION
        root.attrs["Type"] = np.bytes_("UnstructuredGrid")
        counts = {"Points": len(grid.points), "Cells": len(grid.types), "ConnectivityIds": len(grid.nodes)}
        for name, count in counts.items():
            root[f"NumberOf{name}"] = np.array([count])
        root["Points"], root["Types"] = grid.points, grid.types.astype(np.uint8, copy=False)
        report(0.2)
        root.create_dataset("Connectivity", data=grid.nodes, dtype=np.int64)
        report(0.8)
        root["Offsets"] = grid.start
        sections = {"PointData": grid.node_data, "CellData": grid.cell_data, "FieldData": grid.field_data}
        for section, arrays in sections.items():
            _write_arrays(path, root.create_group(section, track_order=True), arrays)


def names_not_kept(mesh: Mesh) -> list[str]:
    """Describe what the file cannot hold as it is: data that are not numbers, and names with a slash."""
    groups = with_marks(mesh), mesh.hex_data, mesh.field_data, *(cells.data for cells in mesh.cells)
    sets = mesh.node_sets, mesh.hex_sets, *(cells.sets for cells in mesh.cells)
    names = (name for group in (*groups, *sets) for name in group)
    return non_numeric_data(mesh) + altered_names(_titles(names), "data and sets")


def _write_arrays(path: Path, group: object, arrays: Mapping[str, object]) -> None:
    """Write arrays of numbers, of at most two dimensions, and lists of texts; VTK cannot read empty ones."""
    import h5py

    titles, text = _titles(arrays), h5py.string_dtype("ascii")  # as VTK reads it, though the bytes are UTF-8
    for name, values in arrays.items():
        values = writable(path, name, values)
        if isinstance(values, list):
            rows = [line.replace("\0", "").encode("utf-8", "replace") for line in values]
            if rows:
                group.create_dataset(titles[name], data=np.array(rows, dtype=object), dtype=text)
        elif values.size:
            group[titles[name]] = values if values.ndim < 3 else values.reshape(len(values), -1)


def _titles(names: Iterable[str]) -> dict[str, str]:
    """Names of arrays as HDF5 allows them: without slashes and zeros, and not of dots alone."""
    return make_unique(names, _title)


def _title(name: str, suffix: str) -> str:
    text = name.replace("/", "_").replace("\0", "").encode("utf-8", "replace").decode()
    return (text if text.strip(".") else f"_{text}") + suffix
