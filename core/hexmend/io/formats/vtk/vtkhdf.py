"""VTK's format on HDF5 (.vtkhdf): unstructured grids, the first of several time steps.

The group VTKHDF holds the counts of each part (NumberOfPoints, NumberOfCells, NumberOfConnectivityIds) and the
concatenated arrays of all parts: Points, Types, Connectivity, Offsets (from 0 for each part, one more than its cells),
and those of the groups PointData and CellData. (VTK's manual, "VTKHDF File Format"; measured with VTK 9.7's writer.)

Writing of VTKHDF, version 2.2: one part without compression, as fast as the disk (VTK's manual).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base import hdf5
from hexmend.io.base.capabilities import altered_names, make_unique, non_numeric_data
from hexmend.io.base.content import Content, to_mesh
from hexmend.io.base.fixed_marks import with_marks
from hexmend.io.base.format import Capability, register
from hexmend.io.base.hdf5 import writable_file
from hexmend.io.base.remedies import DAMAGED, MemoryBudget, check_suffix
from hexmend.io.formats.vtk.grid import Grid, from_mesh, to_content
from hexmend.io.formats.vtk.merge_grids import merge_grids
from hexmend.io.formats.vtk.vtu_writer import writable
from hexmend.io.storage.binary_rows import gather_integers
from hexmend.io.storage.file_progress import report
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import count_phrase

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
    return non_numeric_data(mesh) + altered_names(make_unique(names, _title), "data and sets")


def _write_arrays(path: Path, group: object, arrays: Mapping[str, object]) -> None:
    """Write arrays of numbers, of at most two dimensions, and lists of texts; VTK cannot read empty ones."""
    import h5py

    titles = make_unique(arrays, _title)
    text = h5py.string_dtype("ascii")  # as VTK reads it, though the bytes are UTF-8
    for name, values in arrays.items():
        values = writable(path, name, values)
        if isinstance(values, list):
            rows = [line.replace("\0", "").encode("utf-8", "replace") for line in values]
            if rows:
                group.create_dataset(titles[name], data=np.array(rows, dtype=object), dtype=text)
        elif values.size:
            group[titles[name]] = values if values.ndim < 3 else values.reshape(len(values), -1)


def _title(name: str, suffix: str) -> str:
    """Name of an array as HDF5 allows it: without slashes and zeros, and not of dots alone."""
    text = name.replace("/", "_").replace("\0", "").encode("utf-8", "replace").decode()
    return (text if text.strip(".") else f"_{text}") + suffix


#: Chunks that any file may have, and the smallest size of a further chunk in bytes, that of its entry in the index.
_MIN_CHUNKS, _MIN_CHUNK_BYTES = 1000, 24


def read(path: Path) -> Mesh:
    """Read a VTKHDF file in a subprocess, and merge its parts without their ghost cells."""
    return to_mesh(path, hdf5.read_content("hexmend.io.formats.vtk.vtkhdf:content", path))


def content(path: Path) -> Content:
    """Read the content of a VTKHDF file; for the subprocess."""
    with hdf5.open_file(path) as file:
        root = group_of(file, "VTKHDF")
        if root is None:
            raise FileError(path, "has no group VTKHDF", check_suffix("a VTKHDF file"))
        grids = VTKHDFReader(path, root).read_grids()
    return to_content(path, merge_grids(grids))


class VTKHDFReader:
    """Reader of the group VTKHDF, an h5py.Group."""

    def __init__(self, path: Path, root):
        self.path, self.root = path, root
        self.budget = MemoryBudget(path, path.stat().st_size)
        self.notes: list[str] = []

    def read_grids(self) -> list[Grid]:
        """Read the parts of the first time step."""
        kind = self.root.attrs.get("Type", b"")
        kind = kind.decode("ascii", "replace") if isinstance(kind, bytes) else str(kind)
        if kind != "UnstructuredGrid":
            raise FileError(self.path, f"is of the type {kind[:40]!r}: expected UnstructuredGrid", "Convert it.")
        counts = {name: self._read(self.root, f"NumberOf{name}") for name in ("Points", "Cells", "ConnectivityIds")}
        parts = len(counts["Points"])
        begins, first = dict.fromkeys(counts, 0), 0
        steps = group_of(self.root, "Steps")
        if steps is not None:
            count = int(steps.attrs.get("NSteps", 1))
            if count > 1:
                self.notes.append(f"Of its {count} time steps the first is read.")
            first = self._first_value(steps, "PartOffsets", 0)
            parts = self._first_value(steps, "NumberOfParts", max(1, parts // max(1, count)))
            begins = {name: self._first_value(steps, f"{name.removesuffix('s')}Offsets", 0) for name in counts}
        lengths = {len(rows) for rows in counts.values()}
        negative = any((rows < 0).any() for rows in counts.values())
        if len(lengths) > 1 or parts < 1 or first + parts > min(lengths) or negative:
            raise FileError(self.path, f"does not have the counts of its {count_phrase(parts, 'part')}", DAMAGED)
        grids = []
        for part in range(first, first + parts):
            sizes = {name: int(rows[part]) for name, rows in counts.items()}
            grids.append(self._read_grid(sizes, begins, part - first))
            begins = {name: begins[name] + size for name, size in sizes.items()}
        grids[0] = replace(grids[0], field_data=self.read_field_data(), notes=tuple(self.notes))
        return grids

    def _read_grid(self, sizes: dict[str, int], begins: dict[str, int], part: int) -> Grid:
        points, cells, ids = (slice(begins[name], begins[name] + size) for name, size in sizes.items())
        offsets = self._read_integers("Offsets", slice(cells.start + part, cells.stop + part + 1))
        start = offsets.astype(np.int64, copy=False)
        if start[0] != 0 or start[-1] != sizes["ConnectivityIds"] or (np.diff(start) < 0).any():
            problem = f"its Offsets of part {part} do not rise from 0 to {ids.stop - ids.start}"
            raise FileError(self.path, problem, DAMAGED)
        coordinates = self._read(self.root, "Points", points)
        if coordinates.ndim != 2 or coordinates.shape[1] != 3:
            raise FileError(self.path, f"its Points have the shape {coordinates.shape}: expected (n, 3)", DAMAGED)
        types, nodes = self._read_integers("Types", cells), self._read_integers("Connectivity", ids)
        data = self.read_data("PointData", points), self.read_data("CellData", cells)
        return Grid(coordinates.astype(np.float64, copy=False), types, start, nodes, *data)

    def _first_value(self, steps, name: str, default: int) -> int:
        return int(self._read(steps, name).ravel()[0]) if name in steps else default

    def _read_integers(self, name: str, rows: slice) -> np.ndarray:
        found = self._rows_of(self.root, name, rows)
        if found.dtype.kind not in "iu" or found.ndim != 1:
            raise FileError(self.path, f"its {name} are {found.dtype}: expected whole numbers", DAMAGED)
        if found.dtype.itemsize == 1:
            return found[rows]
        return gather_integers((rows.stop - rows.start,), hdf5.dataset_blocks(found, rows))

    def read_rows(self, name: str, rows: slice) -> np.ndarray:
        """Read rows of an array of the grid, in the machine's byte order."""
        return self._read(self.root, name, rows)

    def read_data(self, section: str, rows: slice) -> dict[str, np.ndarray]:
        """Read rows of the arrays of a section that are of numbers."""
        group = group_of(self.root, section)
        found = {}
        for name in group or ():
            if group[name].dtype.kind in "biuf":
                found[name] = self._read(group, name, rows)
            else:
                note = f"{section} {name!r} is not of numbers, and left out."
                self.notes += [note] if note not in self.notes else []
        return found

    def read_field_data(self) -> dict[str, object]:
        """Read the values of the grid as a whole."""
        group = group_of(self.root, "FieldData") or {}
        readers = {name: self._read if group[name].dtype.kind in "biuf" else self._read_strings for name in group}
        return {name: read(group, name) for name, read in readers.items()}

    def _read_strings(self, group, name: str) -> list[str]:
        values = self._dataset(group, name)
        answer = []
        for k in range(values.size):
            text = values[()] if values.ndim == 0 else values[np.unravel_index(k, values.shape)]
            self.budget.charge(len(text), name)
            answer.append(text.decode("utf-8", "replace") if isinstance(text, bytes) else str(text))
        return answer

    def _read(self, group, name: str, rows: slice | None = None) -> np.ndarray:
        """Read rows of a dataset, in the machine's byte order."""
        if rows is None:
            found = self._dataset(group, name)
            self.budget.charge(found.size * found.dtype.itemsize, name)
            values = np.asarray(found[()])
            return values.astype(values.dtype.newbyteorder("="), copy=False)
        found = self._rows_of(group, name, rows)
        values = np.empty((rows.stop - rows.start, *found.shape[1:]), found.dtype.newbyteorder("="))
        for part, block in hdf5.dataset_blocks(found, rows):
            values[part] = block
        return values

    def _rows_of(self, group, name: str, rows: slice):
        """Return a dataset after a check that it has these rows, which are charged to the budget."""
        found = self._dataset(group, name)
        if found.ndim < 1 or rows.stop > len(found) or rows.start < 0:
            raise FileError(self.path, f"its {name} ends after {found.shape} rows: expected {rows.stop}", DAMAGED)
        count = (rows.stop - rows.start) * int(np.prod(found.shape[1:]))
        self.budget.charge(count * found.dtype.itemsize, name)
        return found

    def _dataset(self, group, name: str):
        """Return a dataset after a check that it has no more chunks than fit into the file."""
        import h5py

        found = group.get(name)
        if not isinstance(found, h5py.Dataset):
            raise FileError(self.path, f"has no array {name!r}", DAMAGED)
        lengths = zip(found.shape, found.chunks or (), strict=False)
        chunks = math.prod(-(-size // max(1, width)) for size, width in lengths)
        if chunks > _MIN_CHUNKS + self.budget.size // _MIN_CHUNK_BYTES:
            problem = f"its array {name!r} has {chunks:,} chunks, more than fit into the file"
            raise FileError(self.path, problem, DAMAGED)
        return found


def group_of(parent, name: str):
    """Return a subgroup, or None."""
    import h5py

    found = parent.get(name)
    return found if isinstance(found, h5py.Group) else None


register(
    name="vtkhdf",
    title="VTKHDF",
    suffixes=(".vtkhdf",),
    encodings=("binary",),
    read=read,
    write=write,
    capabilities=frozenset(Capability) - {Capability.SIDE_SETS, Capability.EMPTY_SETS},
    limitations=names_not_kept,
    matches=lambda head: head.startswith(hdf5.MAGIC) and b"VTKHDF" in head,
)
