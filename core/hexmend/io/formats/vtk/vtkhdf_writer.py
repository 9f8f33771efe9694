"""Writing of VTKHDF, version 2.2: one part without compression, as fast as the disk (VTK's manual)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from hexmend.io.base.capabilities import non_numeric_data
from hexmend.io.base.unique_names import altered_names, make_unique
from hexmend.io.formats.vtk.grid import from_mesh
from hexmend.mesh.mesh import Mesh

_VERSION = (2, 2)
#: Kinds of numbers, by NumPy's letters, that the format holds.
_KINDS = "biuf"


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write a mesh; sets and fixed nodes become arrays as in VTU."""
    import h5py

    grid = from_mesh(mesh, _KINDS)
    with h5py.File(path, "w", track_order=True) as file:
        root = file.create_group("VTKHDF", track_order=True)
        root.attrs["Version"] = _VERSION
        root.attrs["Type"] = np.bytes_("UnstructuredGrid")
        counts = {"Points": len(grid.points), "Cells": len(grid.types), "ConnectivityIds": len(grid.nodes)}
        for name, count in counts.items():
            root[f"NumberOf{name}"] = np.array([count])
        root["Points"], root["Types"] = grid.points, grid.types.astype(np.uint8, copy=False)
        root.create_dataset("Connectivity", data=grid.nodes, dtype=np.int64)
        root["Offsets"] = grid.start
        for section, arrays in (("PointData", grid.node_data), ("CellData", grid.cell_data)):
            _write_arrays(root.create_group(section, track_order=True), arrays)
        _write_arrays(root.create_group("FieldData", track_order=True), dict(_fields(grid.field_data)))


def names_not_kept(mesh: Mesh) -> list[str]:
    """Describe what the file cannot hold as it is: data that are no numbers, and names with a slash."""
    grid = from_mesh(mesh, _KINDS)
    names = (*grid.node_data, *grid.cell_data, *mesh.field_data)
    return non_numeric_data(mesh) + altered_names(_titles(names), "data and sets")


def _write_arrays(group: object, arrays: Mapping[str, np.ndarray | list[str]]) -> None:
    import h5py

    titles, text = _titles(arrays), h5py.string_dtype("ascii")  # as VTK reads it, though the bytes are UTF-8
    for name, values in arrays.items():
        if isinstance(values, list):
            rows = np.array([line.replace("\0", "").encode("utf-8", "replace") for line in values], dtype=object)
            group.create_dataset(titles[name], data=rows, dtype=text)
        else:
            array = np.asarray(values)
            group[titles[name]] = array.astype(np.uint8) if array.dtype.kind == "b" else array


def _fields(data: Mapping[str, object]) -> Iterable[tuple[str, np.ndarray | list[str]]]:
    """Yield the field data that are numbers or texts; a text becomes a list."""
    for name, values in data.items():
        if isinstance(values, str):
            yield name, [values]
        elif isinstance(values, list | tuple) and all(isinstance(text, str) for text in values):
            yield name, list(values)
        else:
            array = np.atleast_1d(values)
            if array.dtype.kind == "U":
                yield name, [str(text) for text in array.ravel()]
            elif array.dtype.kind in _KINDS:
                yield name, array


def _titles(names: Iterable[str]) -> dict[str, str]:
    """Names of arrays as HDF5 allows them: without slashes and zeros, and not of dots alone."""
    return make_unique(names, _title)


def _title(name: str, suffix: str) -> str:
    plain = name.replace("/", "_").replace("\0", "").encode("utf-8", "replace").decode()
    return (plain if plain.strip(".") else f"_{plain}") + suffix
