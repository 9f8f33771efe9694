"""VTK's legacy format (.vtk), versions 1.0 to 5.1, in decimals and binary."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.carry import Grid, from_mesh, to_mesh
from hexmend.io.decimals import blocks, lines
from hexmend.io.format import FORMATS, Format, Holds
from hexmend.io.source import Source, shown
from hexmend.mesh import Mesh

_TYPES = {
    "bit": "u1", "char": "i1", "signed_char": "i1", "unsigned_char": "u1", "short": "i2", "unsigned_short": "u2",
    "int": "i4", "unsigned_int": "u4", "long": "i8", "unsigned_long": "u8", "vtktypeint64": "i8", "vtktypeuint64": "u8",
    "vtkidtype": "i4", "float": "f4", "double": "f8",
}  # fmt: skip
_NAMES = {
    code: name
    for name, code in _TYPES.items()
    if name not in ("bit", "char", "vtktypeint64", "vtktypeuint64", "vtkidtype")
}
_NAMES["i1"] = "char"
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
        self.source = Source(path, path.read_bytes())
        self.found: dict[str, np.ndarray] = {}
        self.data: dict[str, dict[str, np.ndarray]] = {"POINT_DATA": {}, "CELL_DATA": {}}
        self.target: dict[str, np.ndarray] = {}
        self.rows = 0

    def grid(self) -> Grid:
        self._read("UNSTRUCTURED_GRID", ("POINTS", "CELLS", "CELL_TYPES"))
        types = self.found["CELL_TYPES"]
        start, nodes = self._cells(types)
        return Grid(self.found["POINTS"], types, start, nodes, self.data["POINT_DATA"], self.data["CELL_DATA"])

    def polygons(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        self._read("POLYDATA", ("POINTS",))
        if "CELL_TYPES" not in self.found:  # points or lines alone
            return self.found["POINTS"], np.zeros(1, np.int64), np.empty(0, np.int64)
        return self.found["POINTS"], *self._cells(self.found["CELL_TYPES"])

    def _read(self, dataset: str, needed: tuple[str, ...]) -> None:
        source = self.source
        head = source.raw_line()
        if not re.match(r"#\s*vtk\s+datafile", head, re.IGNORECASE):
            raise source.error(
                f"line 1 is {shown(head)}: expected '# vtk DataFile Version ...'", "Is it a VTK file? Check its suffix."
            )
        source.raw_line()  # the title
        kind = source.line().upper()
        if kind not in ("ASCII", "BINARY"):
            raise source.error(f"line 3 is {shown(kind)}: expected ASCII or BINARY")
        source.text = kind == "ASCII"
        words = source.line().upper().split()
        if words != ["DATASET", dataset]:
            what = words[1] if len(words) > 1 and words[0] == "DATASET" else "missing"
            remedy = f"Convert it to {_DATASETS[dataset]}."
            raise source.error(f"its dataset is {what}: expected {dataset}", remedy)
        while not source.ended:
            words = source.line().split()
            if dataset == "POLYDATA" and words[0].upper() in self.data:
                break
            self._section(words)
        for name in needed:
            if name not in self.found:
                raise source.error(f"has no section {name}")

    def _section(self, words: list[str]) -> None:
        source, key = self.source, words[0].upper()
        line = source.here
        try:
            if key == "POINTS":
                self.found[key] = self._array(key, source.whole(words[1], "the number of points"), 3, words[2]).astype(
                    float
                )
            elif key == "CELLS":
                self._cells_section(source.whole(words[1], "the number of cells"), source.whole(words[2], "their size"))
            elif key == "POLYGONS":
                count = source.whole(words[1], "the number of polygons")
                self._cells_section(count, source.whole(words[2], "their size"))
                self.found["CELL_TYPES"] = np.zeros(count - ("OFFSETS" in self.found), np.uint8)
            elif key in ("VERTICES", "LINES"):
                self._cells_section(source.whole(words[1], "the number of cells"), source.whole(words[2], "their size"))
                self.found.pop("OFFSETS", None)  # they are left out
            elif key == "TRIANGLE_STRIPS":
                raise source.error("holds triangle strips: expected polygons", "Convert them to triangles.")
            elif key == "CELL_TYPES":
                self.found[key] = self._array(key, source.whole(words[1], "the number of cells"), 1, "int")[:, 0]
            elif key in self.data:
                self.target, self.rows = self.data[key], source.whole(words[1], "the number of rows")
                self._check_rows(key)
            elif key == "SCALARS":
                width = source.whole(words[3], "the number of components") if len(words) > 3 else 1
                mark = source.pos
                if not source.line().upper().startswith("LOOKUP_TABLE"):
                    source.pos = mark
                self._keep(words[1], self._array(f"SCALARS {words[1]}", self.rows, width, words[2]))
            elif key in _WIDTHS:
                self._keep(words[1], self._array(f"{key} {words[1]}", self.rows, _WIDTHS[key], words[2]))
            elif key == "TEXTURE_COORDINATES":
                self._keep(words[1], self._array(key, self.rows, source.whole(words[2], "the dimension"), words[3]))
            elif key == "COLOR_SCALARS":
                kind = "float" if source.text else "unsigned_char"
                self._keep(words[1], self._array(key, self.rows, source.whole(words[2], "the number of values"), kind))
            elif key == "LOOKUP_TABLE":
                kind = "float" if source.text else "unsigned_char"
                self._array(key, source.whole(words[2], "the size of the table"), 4, kind)
            elif key == "FIELD":
                for _ in range(source.whole(words[2], "the number of arrays")):
                    self._field()
            elif key == "METADATA":
                while source.raw_line():
                    pass
            else:
                raise source.error(
                    f"the line before {line} begins with {shown(words[0])}: expected a section of the format"
                )
        except IndexError:
            raise source.error(f"the heading {' '.join(words)!r} before {line} is incomplete") from None

    def _field(self) -> None:
        words = self.source.line().split()
        while words and words[0].upper() == "METADATA":
            while self.source.raw_line():
                pass
            words = self.source.line().split()
        if len(words) < 4:
            raise self.source.error(
                f"an array's heading before {self.source.here} is incomplete: expected name, width, rows, type"
            )
        width = self.source.whole(words[1], "the number of components")
        rows = self.source.whole(words[2], "the number of rows")
        values = self._array(f"array {words[0]}", rows, width, words[3])
        if rows == self.rows:
            self._keep(words[0], values)

    def _keep(self, name: str, values: np.ndarray) -> None:
        from urllib.parse import unquote

        self.target[unquote(name)] = values[:, 0] if values.shape[1] == 1 else values

    def _check_rows(self, key: str) -> None:
        have = len(self.found.get("POINTS" if key == "POINT_DATA" else "CELL_TYPES", ()))
        if have != self.rows:
            raise self.source.error(f"{key} has {self.rows} rows: expected {have}")

    def _array(self, section: str, rows: int, width: int, kind: str) -> np.ndarray:
        """Numbers of a VTK type, in the machine's byte order."""
        code = _TYPES.get(kind.lower())
        if code is None:
            raise self.source.error(f"{section} has the type {shown(kind)}: expected {', '.join(_TYPES)}")
        if self.source.text:
            wide = np.float64 if code[0] == "f" else np.uint64 if code == "u8" else np.int64
            values = self.source.decimals(section, rows, width, wide)
            return values if code[0] == "f" else values.astype(code)
        if kind.lower() == "bit":
            bits = np.unpackbits(np.frombuffer(self.source.take((rows * width + 7) // 8, section), np.uint8))
            return bits[: rows * width].reshape(rows, width)
        return self.source.binary(section, rows, width, f">{code}").astype(code)

    def _cells_section(self, count: int, size: int) -> None:
        mark = self.source.pos
        words = self.source.line().split()
        if words and words[0].upper() == "OFFSETS":  # version 5
            self.found["OFFSETS"] = self._array("OFFSETS", count, 1, words[1])[:, 0].astype(np.int64)
            words = self.source.line().split()
            if not words or words[0].upper() != "CONNECTIVITY":
                raise self.source.error(f"CELLS goes on with {shown(' '.join(words))}: expected CONNECTIVITY")
            self.found["CELLS"] = self._array("CONNECTIVITY", size, 1, words[1])[:, 0]
        else:
            self.source.pos = mark
            self.found["CELLS"] = self._array("CELLS", *((count, 9) if size == 9 * count else (size, 1)), "int").ravel()

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


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write version 3.0, which every program reads."""
    from urllib.parse import quote

    grid = from_mesh(mesh)
    ascii = encoding == "ascii"
    with open(path, "wb") as file:

        def numbers(values: np.ndarray, code: str) -> None:
            if ascii:
                for part in blocks(len(values)):
                    file.write(lines(values[part]))
            else:
                file.write(np.ascontiguousarray(values, dtype=f">{code}").tobytes() + b"\n")

        name = mesh.name.replace("\n", " ")[:200] or "mesh"
        kind = "ASCII" if ascii else "BINARY"
        file.write(f"# vtk DataFile Version 3.0\n{name}\n{kind}\nDATASET UNSTRUCTURED_GRID\n".encode())
        file.write(f"POINTS {len(grid.points)} double\n".encode())
        numbers(grid.points, "f8")
        widths = np.diff(grid.start)
        count = len(widths)
        file.write(f"CELLS {count} {count + len(grid.nodes)}\n".encode())
        flat = np.empty(count + len(grid.nodes), np.int32)
        heads = grid.start[:-1] + np.arange(count)
        rest = np.ones(len(flat), dtype=bool)
        rest[heads] = False
        flat[heads], flat[rest] = widths, grid.nodes
        if ascii:
            for begin, end in _of_one_width(widths):
                row = widths[begin] + 1
                numbers(flat[heads[begin] : heads[begin] + (end - begin) * row].reshape(-1, row), "i4")
        else:
            numbers(flat, "i4")
        file.write(f"CELL_TYPES {count}\n".encode())
        numbers(grid.types, "i4")
        for section, rows, data in (
            ("POINT_DATA", len(grid.points), grid.node_data),
            ("CELL_DATA", count, grid.cell_data),
        ):
            if data:
                file.write(f"{section} {rows}\nFIELD FieldData {len(data)}\n".encode())
            for title, values in data.items():
                values = np.asarray(values)
                code = values.dtype.str[1:] if values.dtype.kind != "b" else "u1"
                if code not in _NAMES:
                    raise FileError(
                        path, f"the array {title!r} holds {values.dtype}, which VTK cannot", "Remove the array."
                    )
                flat = values.reshape(rows, -1)
                file.write(f"{quote(title, safe=':')} {flat.shape[1]} {rows} {_NAMES[code]}\n".encode())
                numbers(flat.astype(code), code)


def _of_one_width(widths: np.ndarray) -> list[tuple[int, int]]:
    """First and last but one of each series of cells with the same number of nodes."""
    ends = [*(np.flatnonzero(np.diff(widths)) + 1).tolist(), len(widths)]
    return list(pairwise([0, *ends]))


FORMATS.add(
    "vtk",
    Format(
        "vtk",
        "VTK legacy",
        (".vtk",),
        ("binary", "ascii"),
        read,
        write,
        holds=frozenset(Holds) - {Holds.SIDE_SETS, Holds.FIELD_DATA},
        recognised=lambda head: head[:40].lower().lstrip().startswith(b"# vtk datafile"),
    ),
)
