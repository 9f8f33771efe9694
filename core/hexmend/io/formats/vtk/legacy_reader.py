"""VTK's legacy format (.vtk), versions 1.0 to 5.1, in decimals and binary."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.capabilities import non_numeric_data
from hexmend.io.base.cursor import ByteCursor, quoted
from hexmend.io.base.format import Capability, Format, register
from hexmend.io.formats.vtk.grid import Grid, to_mesh
from hexmend.io.formats.vtk.legacy_arrays import STRINGS, array, strings_of, unquoted, whole_numbers
from hexmend.io.formats.vtk.legacy_writer import write
from hexmend.mesh.mesh import Mesh

_START = 4096
_DATASETS = {"UNSTRUCTURED_GRID": "an unstructured grid of hexahedra", "POLYDATA": "PolyData, or write it as STL"}
_WIDTHS = {"VECTORS": 3, "NORMALS": 3, "TENSORS": 9, "GLOBAL_IDS": 1, "PEDIGREE_IDS": 1}


def read(path: Path) -> Mesh:
    """Read a legacy file."""
    return to_mesh(path, _Reader(path).grid())


def read_polygons(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The points (n, 3) of a file of the dataset POLYDATA, where each polygon's nodes begin (k + 1,), and these."""
    return _Reader(path).polygons()


class _Reader:
    """Takes a file apart, section by section."""

    def __init__(self, path: Path):
        with open(path, "rb") as file:
            start = file.read(_START)
            if not re.match(rb"\s*#\s*vtk\s+datafile", start, re.IGNORECASE):
                first = start.split(b"\n", 1)[0].decode("utf-8", errors="replace").strip()
                raise FileError(
                    path,
                    f"line 1 is {quoted(first)}: expected '# vtk DataFile Version ...'",
                    "Is it a VTK file? Check its suffix.",
                )
            file.seek(0)
            self.source = ByteCursor(path, file.read())
        self.found: dict[str, np.ndarray] = {}
        self.data: dict[str, dict[str, np.ndarray]] = {"POINT_DATA": {}, "CELL_DATA": {}}
        self.fields: dict[str, np.ndarray | list[str]] = {}
        self.section = ""  # of data, which the arrays belong to
        self.rows = 0
        self.left: dict[str, None] = {}

    def grid(self) -> Grid:
        self._read("UNSTRUCTURED_GRID", ("POINTS", "CELLS", "CELL_TYPES"))
        types = self.found["CELL_TYPES"]
        start, nodes = self._cells(types)
        notes = (f"Arrays that are not of numbers, one row a node or cell, are left out: {', '.join(self.left)}.",)
        return Grid(
            self.found["POINTS"],
            types,
            start,
            nodes,
            self.data["POINT_DATA"],
            self.data["CELL_DATA"],
            self.fields,
            notes if self.left else (),
        )

    def polygons(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        self._read("POLYDATA", ("POINTS",))
        if "CELL_TYPES" not in self.found:  # points or lines alone
            return self.found["POINTS"], np.zeros(1, np.int64), np.empty(0, np.int64)
        return self.found["POINTS"], *self._cells(self.found["CELL_TYPES"])

    def _read(self, dataset: str, needed: tuple[str, ...]) -> None:
        source = self.source
        source.next_line()  # the first, which was looked at
        source.rest_of_line()  # the title
        kind = source.next_line().upper()
        if kind not in ("ASCII", "BINARY"):
            raise source.error(f"line 3 is {quoted(kind)}: expected ASCII or BINARY")
        source.is_text = kind == "ASCII"
        words = source.next_line().upper().split()
        if words != ["DATASET", dataset]:
            what = words[1] if len(words) > 1 and words[0] == "DATASET" else "missing"
            remedy = f"Convert it to {_DATASETS[dataset]}."
            raise source.error(f"its dataset is {what}: expected {dataset}", remedy)
        while not source.at_end:
            words = source.next_line().split()
            if dataset == "POLYDATA" and words[0].upper() in self.data:
                break
            self._section(words)
        for name in needed:
            if name not in self.found:
                raise source.error(f"has no section {name}")

    def _section(self, words: list[str]) -> None:
        source, key = self.source, words[0].upper()
        mark = source.pos
        if key in self.found or (key == "CELLS" and "CELL_TYPES" in self.found):
            raise source.error(f"has a second section {key} before {source.location}")
        try:
            if key == "POINTS":
                self.found[key] = array(
                    source, key, source.parse_count(words[1], "the number of points"), 3, words[2]
                ).astype(float)
            elif key == "CELLS":
                self._cells_section(
                    source.parse_count(words[1], "the number of cells"), source.parse_count(words[2], "their size")
                )
            elif key == "POLYGONS":
                count = source.parse_count(words[1], "the number of polygons")
                self._cells_section(count, source.parse_count(words[2], "their size"))
                self.found["CELL_TYPES"] = np.zeros(count - ("OFFSETS" in self.found), np.uint8)
            elif key in ("VERTICES", "LINES"):
                self._cells_section(
                    source.parse_count(words[1], "the number of cells"), source.parse_count(words[2], "their size")
                )
                for name in ("CELLS", "OFFSETS"):
                    self.found.pop(name, None)  # they are left out
            elif key == "TRIANGLE_STRIPS":
                raise source.error("holds triangle strips: expected polygons", "Convert them to triangles.")
            elif key == "CELL_TYPES":
                self.found[key] = array(source, key, source.parse_count(words[1], "the number of cells"), 1, "int")[
                    :, 0
                ]
            elif key in self.data:
                self.section, self.rows = key, source.parse_count(words[1], "the number of rows")
                self._check_rows(key)
            elif key == "SCALARS":
                width = source.parse_count(words[3], "the number of components") if len(words) > 3 else 1
                before = source.pos
                if not source.next_line().upper().startswith("LOOKUP_TABLE"):
                    source.pos = before
                self._keep(words[1], array(source, f"SCALARS {words[1]}", self.rows, width, words[2]))
            elif key in _WIDTHS:
                self._keep(words[1], array(source, f"{key} {words[1]}", self.rows, _WIDTHS[key], words[2]))
            elif key == "TEXTURE_COORDINATES":
                self._keep(
                    words[1], array(source, key, self.rows, source.parse_count(words[2], "the dimension"), words[3])
                )
            elif key == "COLOR_SCALARS":
                kind = "float" if source.is_text else "unsigned_char"
                self._keep(
                    words[1], array(source, key, self.rows, source.parse_count(words[2], "the number of values"), kind)
                )
            elif key == "LOOKUP_TABLE":
                kind = "float" if source.is_text else "unsigned_char"
                array(source, key, source.parse_count(words[2], "the size of the table"), 4, kind)
            elif key == "FIELD":
                for _ in range(source.parse_count(words[2], "the number of arrays")):
                    self._field()
            elif key == "METADATA":
                while source.rest_of_line():
                    pass
            else:
                place = source.location_of(mark)
                raise source.error(f"the line before {place} begins with {quoted(words[0])}: expected a section")
        except IndexError:
            heading = quoted(" ".join(words))
            raise source.error(f"the heading {heading} before {source.location_of(mark)} is incomplete") from None

    def _field(self) -> None:
        source = self.source
        words = source.next_line().split()
        while words and words[0].upper() == "METADATA":
            while source.rest_of_line():
                pass
            words = source.next_line().split()
        if len(words) < 4:
            raise source.error(f"an array's heading before {source.location} lacks some of name, width, rows and type")
        width = source.parse_count(words[1], "the number of components")
        rows = source.parse_count(words[2], "the number of rows")
        if words[3].lower() in STRINGS:
            strings = strings_of(source, rows * width)
            if self.section:
                self.left[unquoted(words[0])] = None
            else:
                self.fields[self._name(words[0], self.fields)] = strings
            return
        values = array(source, f"array {words[0]}", rows, width, words[3])
        if not self.section:
            self.fields[self._name(words[0], self.fields)] = values[:, 0] if width == 1 else values
        elif rows == self.rows:
            self._keep(words[0], values)
        else:
            self.left[unquoted(words[0])] = None

    def _keep(self, name: str, values: np.ndarray) -> None:
        target = self.data.get(self.section)
        if target is None:
            raise self.source.error(f"the array {quoted(name)} stands before POINT_DATA and CELL_DATA")
        target[self._name(name, target)] = values[:, 0] if values.shape[1] == 1 else values

    def _name(self, name: str, target: Mapping[str, object]) -> str:
        """The name of an array; another where that is taken."""
        name = unquoted(name)
        return name if name not in target else f"{name} ({len(target) + 1})"

    def _check_rows(self, key: str) -> None:
        have = len(self.found.get("POINTS" if key == "POINT_DATA" else "CELL_TYPES", ()))
        if have != self.rows:
            raise self.source.error(f"{key} has {self.rows} rows: expected {have}")

    def _cells_section(self, count: int, size: int) -> None:
        source = self.source
        mark = source.pos
        words = source.next_line().split()
        if words and words[0].upper() == "OFFSETS":  # version 5
            self.found["OFFSETS"] = whole_numbers(source, "OFFSETS", count, words[1]).astype(np.int64)
            words = source.next_line().split()
            if not words or words[0].upper() != "CONNECTIVITY":
                raise source.error(f"CELLS goes on with {quoted(' '.join(words))}: expected CONNECTIVITY")
            self.found["CELLS"] = whole_numbers(source, "CONNECTIVITY", size, words[1])
        else:
            source.pos = mark
            if count > size:
                raise source.error(f"{count} cells of {size} numbers are announced before {source.location}")
            shape = (count, 9) if size == 9 * count else (size, 1)
            self.found["CELLS"] = array(source, "CELLS", *shape, "int").ravel()

    def _cells(self, types: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Start of each cell and all cells' nodes."""
        flat, count = self.found["CELLS"].astype(np.int64), len(types)
        if "OFFSETS" in self.found:
            start = self.found["OFFSETS"]
            if len(start) != count + 1 or start[0] != 0 or start[-1] != len(flat) or (np.diff(start) < 0).any():
                raise self.source.error(
                    f"CELLS has {len(start)} OFFSETS for {count} cells of CELL_TYPES: expected {count + 1}, rising"
                )
            return start, flat
        widths = np.empty(count, np.int64)
        if len(flat) == 9 * count and (flat[::9] == 8).all():
            widths[:] = 8
        else:
            at = 0
            for i in range(count):
                if at >= len(flat) or flat[at] < 0:
                    raise self.source.error(f"CELLS ends in cell {i} of the {count} that CELL_TYPES names")
                widths[i] = flat[at]
                at += 1 + int(flat[at])
            if at != len(flat):
                raise self.source.error(f"CELLS holds {len(flat)} numbers: its {count} cells need {at}")
        start = np.concatenate([[0], np.cumsum(widths)])
        keep = np.ones(len(flat), dtype=bool)
        keep[start[:-1] + np.arange(count)] = False
        return start, flat[keep]


register(
    Format(
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
)
