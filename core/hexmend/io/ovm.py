"""OpenVolumeMesh's format in decimals (.ovm): polyhedra of half-faces, of which those of six quads are hexes.

Edge e is the half-edges 2e and, the other way, 2e + 1; face f the half-faces 2f and 2f + 1.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from hexmend.io.content import Block, Content
from hexmend.io.content import to_mesh as mesh_of
from hexmend.io.format import FORMATS, Format
from hexmend.io.source import Source, shown, text_of
from hexmend.mesh import Mesh

_LETTER = re.compile(rb"[A-Za-z]")
_PROPERTY = re.compile(r'([A-Z]+Prop)\s+(.+?)\s+"?([^"]*?)"?\s*\Z', re.IGNORECASE)
_VECTOR = re.compile(r"(?:vec|Vec|Vector)([234])(d|f|i|ui)\Z")
_REALS = ("double", "float")
_WHOLES = ("int", "unsigned int", "uint", "long", "unsigned long", "ulong", "short", "bool", "char", "unsigned char")


def read(path: Path) -> Mesh:
    """Read a mesh of polyhedra; properties of its vertices and cells are data of nodes and hexes."""
    source = Source(path, text_of(path))
    if source.line().upper() != "OVM ASCII":
        raise source.error("does not begin with OVM ASCII", "Is it an OpenVolumeMesh file? Save it as ASCII.")
    points, edges = np.zeros((0, 3)), np.zeros((0, 2), np.int64)
    faces = cells = _Rows(np.zeros(0, np.int64), np.zeros(0, np.int64))
    seen: set[str] = set()
    node_data: dict[str, np.ndarray] = {}
    cell_data: dict[str, np.ndarray] = {}
    notes: list[str] = []
    while not source.ended:
        line, key = source.here, source.line()
        section = key.upper()
        if section in seen:
            raise source.error(f"holds {shown(key)} twice, again at {line}")
        seen.add(section)
        if section == "VERTICES":
            points = source.decimals("Vertices", _count(source, "Vertices"), 3, np.float64)
        elif section == "EDGES":
            edges = source.decimals("Edges", _count(source, "Edges"), 2, np.int64)
            _check(source, "Edges", edges, len(points))
        elif section == "FACES":
            faces = _rows(source, "Faces", 2 * len(edges))
        elif section == "POLYHEDRA":
            cells = _rows(source, "Polyhedra", 2 * len(faces))
        elif found := _PROPERTY.match(key):
            _property(source, found, {"VPROP": (node_data, len(points)), "CPROP": (cell_data, len(cells))}, notes)
        else:
            raise source.error(f"{shown(key)} stands where a section should begin ({line})")
    if "POLYHEDRA" not in seen:
        raise source.error("ends without Polyhedra")
    which, hexes = _hexes(edges, faces, cells)
    others = len(cells) - len(which)
    if others and len(which):
        notes.append(f"{others:,} polyhedra that are no hexes are left out.")
    elif others:
        raise source.error(f"holds no hexahedra, but {others:,} other polyhedra", "Hexmend works on hexahedra only.")
    block = Block("hex", hexes, {name: values[which] for name, values in cell_data.items()})
    return mesh_of(path, Content(points, (block,), node_data, notes=tuple(notes)))


class _Rows:
    """Rows of different lengths: row k is values[start[k]:start[k] + length[k]]."""

    def __init__(self, values: np.ndarray, start: np.ndarray):
        self.values, self.start = values, start
        self.length = values[start - 1] if len(start) else start

    def __len__(self) -> int:
        return len(self.start)

    def of_length(self, length: int, which: np.ndarray) -> np.ndarray:
        """Some rows, all of one length; (k, length)."""
        return self.values[self.start[which][:, None] + np.arange(length)]


def _rows(source: Source, name: str, limit: int) -> _Rows:
    """Rows that each begin with how many numbers follow, which are from 0 to limit - 1."""
    count = _count(source, name)
    letter = _LETTER.search(source.data, source.pos)
    values = source.decimals_to(name, letter.start() if letter else len(source.data), np.int64)
    starts, at, view = [], 0, memoryview(values)
    while at < values.size and view[at] >= 0:
        starts.append(at + 1)
        at += 1 + view[at]
    if len(starts) != count or at != values.size:
        raise source.error(f"{name} holds {len(starts)} whole rows of {count} before {source.here}")
    inside = np.ones(values.size, bool)
    inside[np.array(starts, np.int64) - 1] = False
    _check(source, name, values[inside], limit)
    return _Rows(values, np.array(starts, np.int64))


def _hexes(edges: np.ndarray, faces: _Rows, cells: _Rows) -> tuple[np.ndarray, np.ndarray]:
    """Cells that are hexes, (m,) int, and their corners, (m, 8)."""
    six = np.flatnonzero(cells.length == 6)
    sides = cells.of_length(6, six)  # half-faces
    quads = (faces.length[sides >> 1] == 4).all(axis=1) if len(faces) else np.zeros(len(six), bool)
    six, sides = six[quads], sides[quads]
    around = faces.of_length(4, (sides >> 1).ravel())  # half-edges
    corners = edges[around >> 1, around & 1].reshape(-1, 6, 4)  # where each of them begins
    corners = np.where((sides & 1)[:, :, None] == 1, corners[:, :, ::-1], corners)  # seen from inside
    begin, end = corners.reshape(-1, 24), np.roll(corners, -1, axis=2).reshape(-1, 24)
    lower = corners[:, 0]
    up = ~(end[:, :, None] == lower[:, None, :]).any(axis=2)
    upper, right = np.zeros_like(lower), np.ones(len(lower), bool)
    for k in range(4):
        there = up & (begin == lower[:, k, None])  # the one edge from a lower corner to an upper one
        right &= there.sum(axis=1) == 1
        upper[:, k] = end[np.arange(len(end)), there.argmax(axis=1)]
    hexes = np.concatenate([lower, upper], axis=1)
    right &= (np.diff(np.sort(hexes, axis=1), axis=1) > 0).all(axis=1)
    return six[right], hexes[right]


def _property(
    source: Source, head: re.Match[str], kept: dict[str, tuple[dict[str, np.ndarray], int]], notes: list[str]
) -> None:
    """Values of a property; those that are no numbers, or of edges and faces, are passed over."""
    entity, type, name = head[1], head[2], head[3]
    vector = _VECTOR.match(type)
    if entity.upper() in kept and (vector or type in _REALS + _WHOLES):
        data, count = kept[entity.upper()]
        width = int(vector[1]) if vector else 1
        real = vector[2] in "df" if vector else type in _REALS
        values = source.decimals(f"{entity} {shown(name)}", count, width, np.float64 if real else np.int64)
        data[name] = values if vector else values[:, 0]
        return
    notes.append(f"The property {shown(name)} ({entity} {shown(type)[1:-1]}) is left out.")
    while not source.ended:
        before = source.pos
        if _PROPERTY.match(source.line()):
            source.pos = before
            return


def _count(source: Source, name: str) -> int:
    return source.whole(source.line(), f"the number of {name}")


def _check(source: Source, name: str, values: np.ndarray, limit: int) -> None:
    if values.size and (values.min() < 0 or values.max() >= limit):
        wrong = int(values[(values < 0) | (values >= limit)].flat[0])
        raise source.error(f"{name} name {wrong}: expected numbers from 0 to {limit - 1}")


def _recognised(head: bytes) -> bool:
    return head[:9].upper() == b"OVM ASCII"


FORMATS.add("ovm", Format("ovm", "OpenVolumeMesh", (".ovm",), (), read, recognised=_recognised))
