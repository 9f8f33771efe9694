"""VTK's legacy format (.vtk), versions 1.0 to 5.1, in decimals and binary."""

from __future__ import annotations

import re
from codecs import BOM_UTF8
from collections.abc import Mapping
from pathlib import Path
from urllib.parse import unquote

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.capabilities import non_numeric_data
from hexmend.io.base.cursor import ByteCursor, quoted
from hexmend.io.base.format import Capability, register
from hexmend.io.base.polyhedra import RaggedArray
from hexmend.io.base.remedies import MemoryBudget, check_suffix, unread_note
from hexmend.io.formats.vtk.grid import POLYHEDRON, Grid, to_mesh, with_polyhedra_converted
from hexmend.io.formats.vtk.legacy_arrays import STRINGS, read_array, read_integers, read_strings, split_cells, write
from hexmend.io.formats.vtk.structured import grid_points, structured_cells
from hexmend.io.storage.binary_rows import FileBytes
from hexmend.mesh.mesh import Mesh

#: Bytes in which the first line must end.
_HEAD = 4096
_REMEDIES = {"UNSTRUCTURED_GRID": "an unstructured grid of hexahedra", "POLYDATA": "PolyData, or write it as STL"}
#: Data sets whose hexes follow from their DIMENSIONS, and their coordinates along x, y and z.
_STRUCTURED = ("STRUCTURED_GRID", "RECTILINEAR_GRID", "STRUCTURED_POINTS")
_AXES = ("X_COORDINATES", "Y_COORDINATES", "Z_COORDINATES")
#: Number of components of attributes that do not state it.
_WIDTHS = {"VECTORS": 3, "NORMALS": 3, "TENSORS": 9, "GLOBAL_IDS": 1, "PEDIGREE_IDS": 1}


def read(path: Path) -> Mesh:
    """Read an unstructured grid."""
    return to_mesh(path, _LegacyReader(path).read_grid())


def read_polygons(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Read the polygons of a file with the dataset POLYDATA.

    Returns
    -------
    points : (n, 3) float64
    start : (k + 1,) int64
        Polygon i has the nodes nodes[start[i]:start[i + 1]].
    nodes : (start[-1],) int
    """
    return _LegacyReader(path).read_polygons()


class _LegacyReader:
    """Reader of one file, section by section."""

    def __init__(self, path: Path):
        with open(path, "rb") as file:
            head = file.read(_HEAD).removeprefix(BOM_UTF8)
            if not re.match(rb"\s*#\s*vtk\s+datafile", head, re.IGNORECASE):
                first = head.split(b"\n", 1)[0].decode("utf-8", errors="replace").strip()
                problem = f"line 1 is {quoted(first)}: expected '# vtk DataFile Version ...'"
                raise FileError(path, problem, check_suffix("a VTK file"))
        self.cursor = ByteCursor(path, FileBytes(path))
        self.sections: dict[str, np.ndarray] = {}
        self.data: dict[str, dict[str, np.ndarray]] = {"POINT_DATA": {}, "CELL_DATA": {}}
        self.field_data: dict[str, np.ndarray | list[str]] = {}
        self.data_section = ""  # key in `data` of the arrays that follow
        self.rows = 0  # of these arrays
        self.skipped: dict[str, None] = {}  # names of arrays, in the order of the file

    def read_grid(self) -> Grid:
        self._read("UNSTRUCTURED_GRID", ("POINTS", "CELLS", "CELL_TYPES"))
        types = self.sections["CELL_TYPES"]
        start, nodes = self._cells(types)
        note = unread_note(f"arrays that are not of numbers, one row a node or cell ({', '.join(self.skipped)})")
        data, notes = (*self.data.values(), self.field_data), (note,) if self.skipped else ()
        grid = Grid(self.sections["POINTS"], types, start, nodes, *data, notes)
        chosen = types == POLYHEDRON
        own = nodes[np.repeat(chosen, np.diff(start))].astype(np.int64)
        return with_polyhedra_converted(grid, RaggedArray(np.cumsum([0, *np.diff(start)[chosen]]), own))

    def read_polygons(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        self._read("POLYDATA", ("POINTS",))
        if "CELL_TYPES" not in self.sections:  # points or lines alone
            return self.sections["POINTS"], np.zeros(1, np.int64), np.empty(0, np.int64)
        return self.sections["POINTS"], *self._cells(self.sections["CELL_TYPES"])

    def _read(self, dataset: str, required: tuple[str, ...]) -> None:
        cursor = self.cursor
        cursor.next_line()  # "# vtk DataFile ..."
        cursor.rest_of_line()  # the title
        kind = cursor.next_line().upper()
        if kind not in ("ASCII", "BINARY"):
            raise cursor.error(f"line 3 is {quoted(kind)}: expected ASCII or BINARY")
        cursor.is_text = kind == "ASCII"
        words = cursor.next_line().upper().split()
        self.is_structured = dataset == "UNSTRUCTURED_GRID" and words[1:] and words[1] in _STRUCTURED
        if words != ["DATASET", dataset] and not self.is_structured:
            found = words[1] if len(words) > 1 and words[0] == "DATASET" else "missing"
            raise cursor.error(f"its dataset is {found}: expected {dataset}", f"Convert it to {_REMEDIES[dataset]}.")
        while not cursor.at_end:
            words = cursor.next_line().split()
            if dataset == "POLYDATA" and words[0].upper() in self.data:
                break
            self._read_section(words)
        if self.is_structured:
            self._add_structured_cells()
        for name in required:
            if name not in self.sections:
                raise cursor.error(f"has no section {name}")

    def _read_section(self, heading: list[str]) -> None:
        cursor, key = self.cursor, heading[0].upper()
        mark = cursor.pos
        if key in self.sections or (key == "CELLS" and "CELL_TYPES" in self.sections):
            raise cursor.error(f"has a second section {key} before {cursor.location}")
        try:
            if not (self._read_geometry(key, heading) or self._read_attributes(key, heading)):
                line = cursor.location_of(mark)
                raise cursor.error(f"the line before {line} begins with {quoted(heading[0])}: expected a section")
        except IndexError:
            line = cursor.location_of(mark)
            raise cursor.error(f"the heading {quoted(' '.join(heading))} before {line} is incomplete") from None

    def _read_geometry(self, key: str, heading: list[str]) -> bool:
        """Read a section of points or cells; return False for another section."""
        cursor, count = self.cursor, self.cursor.parse_count
        if key == "POINTS":
            points = read_array(cursor, key, count(heading[1], "the number of points"), 3, heading[2])
            self.sections[key] = points.astype(float, copy=False)
        elif key in ("CELLS", "POLYGONS", "VERTICES", "LINES"):
            cells = count(heading[1], f"the number of {'polygons' if key == 'POLYGONS' else 'cells'}")
            self._read_cells(cells, count(heading[2], "their size"))
            if key == "POLYGONS":
                self.sections["CELL_TYPES"] = np.zeros(cells - ("OFFSETS" in self.sections), np.uint8)
            for name in ("CELLS", "OFFSETS") if key in ("VERTICES", "LINES") else ():  # not used
                self.sections.pop(name, None)
        elif key == "TRIANGLE_STRIPS":
            raise cursor.error("holds triangle strips: expected polygons", "Convert them to triangles.")
        elif key == "DIMENSIONS" or key in _AXES or key in ("ORIGIN", "SPACING", "ASPECT_RATIO"):
            self._read_structure(key, heading)
        elif key == "CELL_TYPES":
            self.sections[key] = read_array(cursor, key, count(heading[1], "the number of cells"), 1, "int")[:, 0]
        else:
            return False
        return True

    def _read_structure(self, key: str, heading: list[str]) -> None:
        """Read a line that tells the nodes of a structured grid; the coordinates of a rectilinear one follow it."""
        if key in _AXES:
            count = self.cursor.parse_count(heading[1], "the number of coordinates")
            self.sections[key] = read_array(self.cursor, key, count, 1, heading[2])[:, 0]
            return
        try:
            self.sections[key] = np.array([float(word) for word in heading[1:4]])
        except ValueError:
            raise self.cursor.error(f"{key} before {self.cursor.location} holds other words than numbers") from None
        if len(self.sections[key]) != 3 or not np.isfinite(self.sections[key]).all():
            raise self.cursor.error(f"{key} before {self.cursor.location} holds no three numbers")

    def _add_structured_cells(self) -> None:
        """Add the cells of a structured grid, and its points where the file does not list them."""
        if "CELL_TYPES" in self.sections:
            return
        counts = self.sections.get("DIMENSIONS", np.zeros(3)).astype(np.int64).tolist()
        if min(counts) < 2:
            raise self.cursor.error(f"has the DIMENSIONS {counts}: expected two nodes or more along x, y and z")
        budget = MemoryBudget(self.cursor.path, len(self.cursor.data))
        budget.charge(88 * counts[0] * counts[1] * counts[2], "its nodes and cells")
        if "POINTS" not in self.sections:
            step = self.sections.get("SPACING", self.sections.get("ASPECT_RATIO", np.ones(3)))
            origin = self.sections.get("ORIGIN", np.zeros(3))
            even = [origin[k] + step[k] * np.arange(counts[k]) for k in range(3)]
            self.sections["POINTS"] = grid_points([self.sections.get(key, even[k]) for k, key in enumerate(_AXES)])
        if len(self.sections["POINTS"]) != np.prod(counts):
            raise self.cursor.error(f"has {len(self.sections['POINTS'])} points: expected {np.prod(counts)}")
        types, start, nodes = structured_cells(counts)
        self.sections |= {"CELL_TYPES": types, "OFFSETS": start, "CELLS": nodes}

    def _read_attributes(self, key: str, heading: list[str]) -> bool:
        """Read a section of point, cell or field data; return False for another section."""
        cursor, count = self.cursor, self.cursor.parse_count
        if key in self.data:
            if self.is_structured:
                self._add_structured_cells()
            self.data_section, self.rows = key, count(heading[1], "the number of rows")
            expected = len(self.sections.get("POINTS" if key == "POINT_DATA" else "CELL_TYPES", ()))
            if expected != self.rows:
                raise cursor.error(f"{key} has {self.rows} rows: expected {expected}")
        elif key == "SCALARS":
            width = count(heading[3], "the number of components") if len(heading) > 3 else 1
            before = cursor.pos
            if not cursor.next_line().upper().startswith("LOOKUP_TABLE"):
                cursor.pos = before
            self._read_data(heading[1], f"SCALARS {heading[1]}", width, heading[2])
        elif key in _WIDTHS:
            self._read_data(heading[1], f"{key} {heading[1]}", _WIDTHS[key], heading[2])
        elif key == "TEXTURE_COORDINATES":
            self._read_data(heading[1], key, count(heading[2], "the dimension"), heading[3])
        elif key == "COLOR_SCALARS":
            self._read_data(heading[1], key, count(heading[2], "the number of values"), self._colour_type())
        elif key == "LOOKUP_TABLE":
            read_array(cursor, key, count(heading[2], "the size of the table"), 4, self._colour_type())
        elif key == "FIELD":
            for _ in range(count(heading[2], "the number of arrays")):
                self._read_field_array()
        elif key == "METADATA":
            self._skip_metadata()
        else:
            return False
        return True

    def _colour_type(self) -> str:
        return "float" if self.cursor.is_text else "unsigned_char"

    def _skip_metadata(self) -> None:
        while self.cursor.rest_of_line():
            pass

    def _read_field_array(self) -> None:
        cursor = self.cursor
        heading = cursor.next_line().split()
        while heading and heading[0].upper() == "METADATA":
            self._skip_metadata()
            heading = cursor.next_line().split()
        if len(heading) < 4:
            raise cursor.error(f"an array's heading before {cursor.location} lacks some of name, width, rows and type")
        width = cursor.parse_count(heading[1], "the number of components")
        rows = cursor.parse_count(heading[2], "the number of rows")
        if heading[3].lower() in STRINGS:
            values = read_strings(cursor, rows * width)
        else:
            values = read_array(cursor, f"array {heading[0]}", rows, width, heading[3])
            if self.data_section and rows == self.rows:
                self._store(heading[0], values)
                return
            values = values[:, 0] if width == 1 else values
        if self.data_section:
            self.skipped[unquote(heading[0])] = None
        else:
            self.field_data[_unused_name(heading[0], self.field_data)] = values

    def _read_data(self, name: str, section: str, width: int, kind: str) -> None:
        self._store(name, read_array(self.cursor, section, self.rows, width, kind))

    def _store(self, name: str, values: np.ndarray) -> None:
        data = self.data.get(self.data_section)
        if data is None:
            raise self.cursor.error(f"the array {quoted(name)} precedes POINT_DATA and CELL_DATA")
        data[_unused_name(name, data)] = values[:, 0] if values.shape[1] == 1 else values

    def _read_cells(self, count: int, size: int) -> None:
        cursor = self.cursor
        mark = cursor.pos
        words = cursor.next_line().split()
        if words and words[0].upper() == "OFFSETS":  # version 5
            self.sections["OFFSETS"] = read_integers(cursor, "OFFSETS", count, words[1]).astype(np.int64)
            words = cursor.next_line().split()
            if not words or words[0].upper() != "CONNECTIVITY":
                raise cursor.error(f"CELLS continues with {quoted(' '.join(words))}: expected CONNECTIVITY")
            self.sections["CELLS"] = read_integers(cursor, "CONNECTIVITY", size, words[1])
        else:
            cursor.pos = mark
            if count > size:
                raise cursor.error(f"{count} cells of {size} numbers are declared before {cursor.location}")
            shape = (count, 9) if size == 9 * count else (size, 1)  # rows of hexahedra give better error messages
            self.sections["CELLS"] = read_array(cursor, "CELLS", *shape, "int").ravel()

    def _cells(self, types: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Start of each cell, (c + 1,) int64, and the nodes of all cells, (start[-1],) int."""
        flat, count = self.sections.pop("CELLS"), len(types)
        flat = flat if flat.dtype in (np.int32, np.int64) else flat.astype(np.int64)
        if "OFFSETS" in self.sections:
            start = self.sections["OFFSETS"]
            if len(start) != count + 1 or start[0] != 0 or start[-1] != len(flat) or (np.diff(start) < 0).any():
                problem = f"CELLS has {len(start)} OFFSETS for {count} cells of CELL_TYPES"
                raise self.cursor.error(f"{problem}: expected {count + 1}, rising")
            return start, flat
        return split_cells(self.cursor, flat, count)


def _unused_name(name: str, data: Mapping[str, object]) -> str:
    name = unquote(name)
    return name if name not in data else f"{name} ({len(data) + 1})"


register(
    name="vtk",
    title="VTK legacy",
    suffixes=(".vtk",),
    encodings=("binary", "ascii"),
    read=read,
    write=write,
    capabilities=frozenset(Capability) - {Capability.SIDE_SETS, Capability.EMPTY_SETS},
    limitations=non_numeric_data,
    matches=lambda head: head[:40].lower().lstrip().startswith(b"# vtk datafile"),
)
