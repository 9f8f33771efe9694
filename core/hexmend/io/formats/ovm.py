"""OpenVolumeMesh's format in decimals (.ovm): polyhedra given by half-faces; those of six quads are hexes.

Properties of vertices and cells are data; those named "set:..." are sets, as in VTK's formats. Edge e has the
half-edges 2e and, reversed, 2e + 1; face f has the half-faces 2f and 2f + 1.

Writing of OpenVolumeMesh's format in decimals: each edge and face once, and cells as lists of half-faces.

The half-faces of a hex come in pairs, z- and z+ before x- and x+, as in OpenVolumeMesh's own hexahedral meshes.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import BinaryIO

import numpy as np

from hexmend.io.base.capabilities import altered_names, make_unique
from hexmend.io.base.content import from_mesh as content_of
from hexmend.io.base.cursor import ByteCursor, quoted, read_text_bytes
from hexmend.io.base.decimals import format_rows, row_chunks
from hexmend.io.base.fixed_marks import with_marks
from hexmend.io.base.format import Capability, register
from hexmend.io.base.lower_order import lost_mid_nodes, reduce_order
from hexmend.io.base.numbering import first_out_of_range, runs
from hexmend.io.base.polyhedra import LOOPS, RaggedArray, cells_from_faces, check_distinct_nodes, faces_from_cells
from hexmend.io.base.remedies import unread_note
from hexmend.io.formats.vtk.grid import TYPE_BY_KIND, WIDTH_BY_TYPE, Grid, from_content, to_mesh
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import count_phrase

_DATA = {Capability.NODE_DATA, Capability.HEX_DATA, Capability.IDS}
_SETS = {Capability.NODE_SETS, Capability.HEX_SETS, Capability.FIXED_NODES}
_LETTER = re.compile(rb"[A-Za-z]")
_PROPERTY = re.compile(r'([A-Z]+Prop)\s+(.+?)\s+"?([^"]*?)"?\s*\Z', re.IGNORECASE)
_VECTOR = re.compile(r"(?:vec|Vec|Vector)([234])(d|f|i|ui)\Z")
#: Section that must precede properties.
_REQUIRED_SECTION = {"VPROP": "Vertices", "CPROP": "Polyhedra"}
_REALS = ("double", "float")
_Data = dict[str, np.ndarray]
_INTEGERS = ("int", "unsigned int", "uint", "long", "unsigned long", "ulong", "short", "bool", "char", "unsigned char")


def read(path: Path) -> Mesh:
    """Read a mesh of polyhedra."""
    cursor = ByteCursor(path, read_text_bytes(path))
    if cursor.next_line().upper() != "OVM ASCII":
        raise cursor.error("does not begin with OVM ASCII", "Save it as an ASCII OpenVolumeMesh file.")
    points, edges = np.zeros((0, 3)), np.zeros((0, 2), np.int64)
    faces = cells = RaggedArray(np.zeros(1, np.int64), np.zeros(0, np.int64))
    seen: set[object] = set()
    node_data: _Data = {}
    cell_data: _Data = {}
    notes: list[str] = []
    while not cursor.at_end:
        line, key = cursor.location, cursor.next_line()
        section, named = key.upper(), _PROPERTY.match(key)
        mark = (
            (named[1].upper(), *named.groups()[1:]) if named else section
        )  # names are case-sensitive, sections are not
        if mark in seen:
            raise cursor.error(f"holds {quoted(key)} twice, again at {line}")
        seen.add(mark)
        if section == "VERTICES":
            points = cursor.read_numbers("Vertices", _count(cursor, "Vertices"), 3, np.float64)
        elif section == "EDGES":
            edges = cursor.read_numbers("Edges", _count(cursor, "Edges"), 2, np.int64)
            _check(cursor, "Edges", edges, len(points))
        elif section == "FACES":
            faces = _read_lists(cursor, "Faces", 2 * len(edges))
        elif section == "POLYHEDRA":
            cells = _read_lists(cursor, "Polyhedra", 2 * len(faces))
        elif found := _PROPERTY.match(key):
            first = _REQUIRED_SECTION.get(found[1].upper())
            if first is not None and first.upper() not in seen:
                raise cursor.error(f"{quoted(key)} precedes {first} ({line})")
            _read_property(cursor, found, {"VPROP": (node_data, len(points)), "CPROP": (cell_data, len(cells))}, notes)
        else:
            raise cursor.error(f"{quoted(key)} was found where a section should begin ({line})")
    if "POLYHEDRA" not in seen:
        raise cursor.error("ends without Polyhedra")
    loops = RaggedArray(faces.start, edges[faces.values >> 1, faces.values & 1])  # first node of each half-edge
    found = cells_from_faces(loops, RaggedArray(cells.start, cells.values >> 1), (cells.values & 1) == 1)
    others = len(cells) - sum(len(which) for which, _ in found.values())
    if "hex" not in found and others:
        raise cursor.error(f"holds no hexahedra, but {others:,} other polyhedra", "Hexmend works on hexahedra only.")
    if others:
        notes.append(unread_note(count_phrase(others, "polyhedron of another kind", "polyhedra of other kinds")))
    return to_mesh(path, _grid(points, found, node_data, cell_data, notes))


def _grid(points: np.ndarray, found: dict, node_data: _Data, cell_data: _Data, notes: list[str]) -> Grid:
    """Make a grid of the cells that `cells_from_faces` has found."""
    which = np.concatenate([np.zeros(0, np.int64), *(which for which, _ in found.values())])
    types = np.concatenate([np.full(len(which), TYPE_BY_KIND[kind]) for kind, (which, _) in found.items()] or [which])
    start = np.cumsum([0, *(WIDTH_BY_TYPE[number] for number in types.tolist())])
    nodes = np.concatenate([np.zeros(0, np.int64), *(nodes.ravel() for _, nodes in found.values())])
    cell_data = {name: values[which] for name, values in cell_data.items()}
    return Grid(points, types, start, nodes, node_data, cell_data, notes=tuple(notes))


def _read_lists(cursor: ByteCursor, name: str, limit: int) -> RaggedArray:
    """Read rows that begin with their length; their numbers are from 0 to limit - 1."""
    count = _count(cursor, name)
    letter = _LETTER.search(cursor.data, cursor.pos)
    values = cursor.read_numbers_to(name, letter.start() if letter else len(cursor.data), np.int64)
    rows, whole = RaggedArray.of_counted_rows(values)
    if len(rows) != count or not whole:
        raise cursor.error(f"{name} holds {len(rows)} whole rows of {count} before {cursor.location}")
    _check(cursor, name, rows.values, limit)
    return rows


def _read_property(
    cursor: ByteCursor, head: re.Match[str], targets: dict[str, tuple[_Data, int]], notes: list[str]
) -> None:
    """Read a property of vertices or cells; those of other entities or types are skipped, and a note says so."""
    entity, type, name = head[1], head[2], head[3]
    vector = _VECTOR.match(type)
    if entity.upper() in targets and (vector or type in _REALS + _INTEGERS):
        data, count = targets[entity.upper()]
        width = int(vector[1]) if vector else 1
        real = vector[2] in "df" if vector else type in _REALS
        values = cursor.read_numbers(f"{entity} {quoted(name)}", count, width, np.float64 if real else np.int64)
        data[name] = values if vector else values[:, 0]
        return
    notes.append(unread_note(f"the property {quoted(name)} ({entity} {quoted(type)[1:-1]})"))
    while not cursor.at_end:
        before = cursor.pos
        if _PROPERTY.match(cursor.next_line()):
            cursor.pos = before
            return


def _count(cursor: ByteCursor, name: str) -> int:
    return cursor.parse_count(cursor.next_line(), f"the number of {name}")


def _check(cursor: ByteCursor, name: str, values: np.ndarray, limit: int) -> None:
    outside = first_out_of_range(values, limit)
    if outside is not None:
        raise cursor.error(f"{name} refer to {outside}: expected numbers from 0 to {limit - 1}")


#: Kinds of cells that are written.
_KINDS = frozenset(LOOPS)


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write vertices, edges, faces, polyhedra and properties; mid-nodes are left out."""
    content = reduce_order(replace(content_of(mesh), node_data=with_marks(mesh)), _KINDS)
    check_distinct_nodes(path, content.blocks, "OpenVolumeMesh cannot store its faces")
    loops, halves = faces_from_cells([(block.kind, block.nodes) for block in content.blocks])
    edges, around = _edges(loops, len(content.points))
    grid = from_content(content)
    with open(path, "wb") as file:
        file.write(b"OVM ASCII\n")
        _write_rows(file, "Vertices", content.points)
        _write_rows(file, "Edges", edges)
        _write_lists(file, "Faces", around)
        _write_lists(file, "Polyhedra", halves)
        _write_properties(file, "VProp", grid.node_data)
        _write_properties(file, "CProp", grid.cell_data)


def limitations(mesh: Mesh) -> list[str]:
    """Describe data without a type of the format, names that are altered, and mid-nodes that are lost."""
    grid = from_content(replace(content_of(mesh), node_data=with_marks(mesh)))
    phrases = []
    for kind, data in (("point data", grid.node_data), ("cell data", grid.cell_data)):
        odd = sorted(name for name, values in data.items() if _type(np.asarray(values)) is None)
        phrases += [f"{kind} of more than 4 columns, or no numbers ({', '.join(odd)})"] if odd else []
        phrases += altered_names(_titles(data), f"{kind} and sets")
    return phrases + lost_mid_nodes(mesh, _KINDS)


def _edges(loops: np.ndarray, count: int) -> tuple[np.ndarray, RaggedArray]:
    """Nodes of the edges, (e, 2), and the half-edges of each face: 2 k, or 2 k + 1 for edge k reversed."""
    widths = (loops >= 0).sum(axis=1)
    inside = np.arange(4) < widths[:, None]
    begin = loops[inside]
    end = np.where(np.arange(1, 5) < widths[:, None], np.roll(loops, -1, axis=1), loops[:, :1])[inside]
    low, high = np.minimum(begin, end), np.maximum(begin, end)
    _, first, which = np.unique(low * count + high, return_index=True, return_inverse=True)
    number = np.argsort(np.argsort(first))[which]  # in the order of the faces
    pairs = np.column_stack([begin, end])[np.sort(first)]
    return pairs, RaggedArray(np.concatenate([[0], np.cumsum(widths)]), 2 * number + (pairs[number, 0] != begin))


def _write_rows(file: BinaryIO, name: str, rows: np.ndarray) -> None:
    file.write(f"{name}\n{len(rows)}\n".encode())
    for part in row_chunks(len(rows)):
        file.write(format_rows(rows[part]))


def _write_lists(file: BinaryIO, name: str, lists: RaggedArray) -> None:
    file.write(f"{name}\n{len(lists)}\n".encode())
    for part in runs(lists.lengths):
        rows = lists.values[lists.start[part.start] : lists.start[part.stop]].reshape(part.stop - part.start, -1)
        file.write(format_rows(np.column_stack([np.full(len(rows), rows.shape[1]), rows])))


def _write_properties(file: BinaryIO, entity: str, data: Mapping[str, np.ndarray]) -> None:
    titles = _titles(data)
    for name, values in data.items():
        array = np.asarray(values)
        kind = _type(array)
        if kind is not None:
            file.write(f'{entity} {kind} "{titles[name]}"\n'.encode("utf-8", "replace"))
            for part in row_chunks(len(array)):
                file.write(format_rows(array[part].astype(np.int64) if array.dtype.kind == "b" else array[part]))


def _type(values: np.ndarray) -> str | None:
    """Name of the type of an array in the format; None if there is none."""
    if values.dtype.kind not in "biuf" or values.ndim > 2 or (values.ndim == 2 and not 1 <= values.shape[1] <= 4):
        return None
    real, limit = values.dtype.kind == "f", np.iinfo(np.int32)
    small = real or not values.size or (values.min() >= limit.min and values.max() <= limit.max)
    if values.ndim == 2 and values.shape[1] > 1:
        return f"vec{values.shape[1]}{'d' if real else 'i'}" if small else None
    if real:
        return "double"
    return "int" if small else "long" if int(values.max()) <= np.iinfo(np.int64).max else None


def _titles(data: Mapping[str, np.ndarray]) -> dict[str, str]:
    """Names as they are written: between quotes, in one line."""

    def form(name: str, suffix: str) -> str:
        clean = "".join(letter if letter.isprintable() else " " for letter in name.replace('"', "'"))
        return (clean.strip() or "property") + suffix

    return make_unique(data, form)


register(
    name="ovm",
    title="OpenVolumeMesh",
    suffixes=(".ovm",),
    encodings=("ascii",),
    read=read,
    write=write,
    capabilities=frozenset({*_DATA, *_SETS, Capability.OTHER_CELLS}),
    limitations=limitations,
    matches=lambda head: head[:9].upper() == b"OVM ASCII",
)
