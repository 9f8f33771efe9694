"""VTK's format on HDF5 (.vtkhdf): unstructured grids, of several time steps the first; read only.

The group VTKHDF holds the counts of each part (NumberOfPoints, NumberOfCells, NumberOfConnectivityIds) and the arrays
of all parts one behind the other: Points, Types, Connectivity, Offsets (each part's from 0, one more than cells), and
those of the groups PointData and CellData. (VTK's manual, "VTKHDF File Format"; measured with VTK 9.7's writer.)
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base import hdf5
from hexmend.io.base.content import Content, to_mesh
from hexmend.io.base.format import Format, register
from hexmend.io.base.memory_budget import MemoryBudget
from hexmend.io.formats.vtk.grid import Grid, to_content
from hexmend.io.formats.vtk.merge_grids import merge_grids
from hexmend.mesh.mesh import Mesh

_DAMAGED = "Write the file again with the program that made it: it is damaged or cut short."
#: Chunks that any file may have; and what one takes at least, in bytes: its entry in the index.
_CHUNKS, _CHUNK = 1000, 24


def read(path: Path) -> Mesh:
    """Read a VTKHDF file, in a process of its own; its parts are put together without their ghost cells."""
    return to_mesh(path, hdf5.read_content("hexmend.io.formats.vtk.vtkhdf:content", path))


def content(path: Path) -> Content:
    """What a VTKHDF file holds."""
    try:
        with hdf5.open_file(path) as file:
            root = _group(file, "VTKHDF")
            if root is None:
                raise FileError(path, "has no group VTKHDF", "Is it a VTKHDF file? Check its suffix.")
            grids = _Reader(path, root).grids()
    except (FileError, MemoryError):
        raise
    except Exception as error:  # each of the library's failures is another one
        detail = " ".join(str(error).split()) or type(error).__name__
        raise FileError(path, f"cannot be read as VTKHDF ({detail[:120]})", _DAMAGED) from None
    return to_content(path, merge_grids(grids))


class _Reader:
    """Takes the group apart.

    Parameters
    ----------
    path : Path
    root : h5py.Group
    """

    def __init__(self, path: Path, root):
        self.path, self.root = path, root
        self.budget = MemoryBudget(path, path.stat().st_size)
        self.notes: list[str] = []

    def grids(self) -> list[Grid]:
        """The parts of the first time step."""
        kind = self.root.attrs.get("Type", b"")
        kind = kind.decode("ascii", "replace") if isinstance(kind, bytes) else str(kind)
        if kind != "UnstructuredGrid":
            raise FileError(self.path, f"is of the type {kind[:40]!r}: expected UnstructuredGrid", "Convert it.")
        counts = {name: self._values(self.root, f"NumberOf{name}") for name in ("Points", "Cells", "ConnectivityIds")}
        parts = len(counts["Points"])
        begins = {"Points": 0, "Cells": 0, "ConnectivityIds": 0}
        first = 0
        steps = _group(self.root, "Steps")
        if steps is not None:
            count = int(steps.attrs.get("NSteps", 1))
            if count > 1:
                self.notes.append(f"Of its {count} time steps the first is read.")
            first = self._first(steps, "PartOffsets", 0)
            parts = self._first(steps, "NumberOfParts", max(1, parts // max(1, count)))
            begins = {
                "Points": self._first(steps, "PointOffsets", 0),
                "Cells": self._first(steps, "CellOffsets", 0),
                "ConnectivityIds": self._first(steps, "ConnectivityIdOffsets", 0),
            }
        known = {len(rows) for rows in counts.values()}
        if (
            len(known) > 1
            or parts < 1
            or first + parts > min(known)
            or any((rows < 0).any() for rows in counts.values())
        ):
            raise FileError(self.path, f"has not the counts of its {parts} parts", _DAMAGED)
        grids = []
        for part in range(first, first + parts):
            sizes = {name: int(rows[part]) for name, rows in counts.items()}
            grids.append(self._grid(sizes, begins, part - first))
            begins = {name: begins[name] + size for name, size in sizes.items()}
        strings = self._fields()
        grids[0] = Grid(**{**vars(grids[0]), "field_data": strings, "notes": tuple(self.notes)})
        return grids

    def _grid(self, sizes: dict[str, int], begins: dict[str, int], part: int) -> Grid:
        points, cells = (slice(begins[name], begins[name] + sizes[name]) for name in ("Points", "Cells"))
        ids = slice(begins["ConnectivityIds"], begins["ConnectivityIds"] + sizes["ConnectivityIds"])
        start = self._whole("Offsets", slice(cells.start + part, cells.stop + part + 1))
        if start[0] != 0 or start[-1] != sizes["ConnectivityIds"] or (np.diff(start) < 0).any():
            raise FileError(
                self.path, f"its Offsets of part {part} do not rise from 0 to {ids.stop - ids.start}", _DAMAGED
            )
        places = self._values(self.root, "Points", points)
        if places.ndim != 2 or places.shape[1] != 3:
            raise FileError(self.path, f"its Points have the shape {places.shape}: expected (n, 3)", _DAMAGED)
        return Grid(
            places.astype(np.float64, copy=False),
            self._whole("Types", cells),
            start,
            self._whole("Connectivity", ids),
            self._data("PointData", points),
            self._data("CellData", cells),
        )

    def _first(self, steps, name: str, default: int) -> int:
        return int(self._values(steps, name).ravel()[0]) if name in steps else default

    def _whole(self, name: str, rows: slice) -> np.ndarray:
        values = self._values(self.root, name, rows)
        if values.dtype.kind not in "iu" or values.ndim != 1:
            raise FileError(self.path, f"its {name} are {values.dtype}: expected whole numbers", _DAMAGED)
        return values.astype(np.int64)

    def _data(self, section: str, rows: slice) -> dict[str, np.ndarray]:
        group = _group(self.root, section)
        found = {}
        for name in group or ():
            if group[name].dtype.kind in "biuf":
                found[name] = self._values(group, name, rows)
            else:
                note = f"{section} {name!r} is not of numbers, and left out."
                self.notes += [note] if note not in self.notes else []
        return found

    def _fields(self) -> dict[str, object]:
        answer: dict[str, object] = {}
        group = _group(self.root, "FieldData")
        for name in group or ():
            if group[name].dtype.kind in "biuf":
                answer[name] = self._values(group, name)
            else:
                answer[name] = self._strings(group, name)
        return answer

    def _strings(self, group, name: str) -> list[str]:
        values = self._checked(group, name)
        answer = []
        for k in range(values.size):
            one = values[()] if values.ndim == 0 else values[np.unravel_index(k, values.shape)]
            self.budget.charge(len(one), name)
            answer.append(one.decode("utf-8", "replace") if isinstance(one, bytes) else str(one))
        return answer

    def _values(self, group, name: str, rows: slice | None = None) -> np.ndarray:
        """Rows of a dataset, in the machine's byte order."""
        found = self._checked(group, name)
        if rows is not None and (found.ndim < 1 or rows.stop > len(found) or rows.start < 0):
            raise FileError(self.path, f"its {name} ends after {found.shape} rows: expected {rows.stop}", _DAMAGED)
        count = found.size if rows is None else (rows.stop - rows.start) * int(np.prod(found.shape[1:]))
        self.budget.charge(count * found.dtype.itemsize, name)
        values = np.asarray(found[()] if rows is None else found[rows])
        return values.astype(values.dtype.newbyteorder("="), copy=False)

    def _checked(self, group, name: str):
        """A dataset, which has no more chunks than fit into the file."""
        import h5py

        found = group.get(name)
        if not isinstance(found, h5py.Dataset):
            raise FileError(self.path, f"has no array {name!r}", _DAMAGED)
        chunks = math.prod(
            -(-size // max(1, width)) for size, width in zip(found.shape, found.chunks or (), strict=False)
        )
        if chunks > _CHUNKS + self.budget.size // _CHUNK:
            raise FileError(
                self.path, f"its array {name!r} has {chunks:,} chunks, more than fit into the file", _DAMAGED
            )
        return found


def _group(parent, name: str):
    """A group, or None."""
    import h5py

    found = parent.get(name)
    return found if isinstance(found, h5py.Group) else None


register(
    Format(
        name="vtkhdf",
        title="VTKHDF",
        suffixes=(".vtkhdf",),
        encodings=(),
        read=read,
        matches=lambda head: head.startswith(hdf5.MAGIC) and b"VTKHDF" in head,
    )
)
