"""Databases of Ansys MAPDL (.cdb): nodes, elements and components; coordinates are replaced.

*Mechanical APDL Programmer's Reference*, "Coded Database File Commands": NBLOCK, EBLOCK, CMBLOCK, ET and ETBLOCK.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hexmend.io.base.content import to_mesh
from hexmend.io.base.format import Capability, register
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.coordinates.joined_files import JoinedFiles
from hexmend.io.formats.decks.coordinates import DeckCoordinates
from hexmend.io.formats.decks.lines import CardLines, line_ranges
from hexmend.io.formats.decks.model import DeckModel, solids_by_width
from hexmend.mesh.mesh import Mesh

#: Name of a block and what stands behind it, its Fortran format, and its lines.
_BLOCK = re.compile(
    rb"^[ \t]*(NBLOCK|EBLOCK|CMBLOCK|ETBLOCK)\b([^\n]*)\n[ \t]*\(([^)\n]*)\)[^\n]*\n((?:(?:[ \t\d-][^,\n]*+)?\n)*+)",
    re.MULTILINE | re.IGNORECASE,
)
_FIRST = re.compile(rb"^[ \t]*(?:/PREP7|NBLOCK,|/COM,[ \t]*ANSYS)", re.MULTILINE | re.IGNORECASE)
#: Type of element of a number: ET, 1, 185 or ET,1,SOLID185.
_TYPE = re.compile(rb"^[ \t]*ET[ \t]*,[ \t]*(\d{1,9})[ \t]*,[ \t]*[A-Z]*(\d{1,9})", re.MULTILINE | re.IGNORECASE)
_FORMAT = re.compile(rb"(\d+)[ie](\d+)", re.IGNORECASE)
_JOINING = re.compile(rb"^[ \t]*(CE|CP|CERIG|RBE3)[ \t]*,", re.MULTILINE | re.IGNORECASE)
#: Numbers before the nodes of an element, and of them: material, type, number of nodes and number of the element.
_HEAD, _MATERIAL, _ELEMENT_TYPE, _N_NODES, _NUMBER = 11, 0, 1, 8, 10
#: Types of elements that join bodies: contact, target, springs, beams of joints, and MPC184.
_CONTACT = {*range(169, 180), 14, 39, 40, 184, 250}
#: Solid elements by the number of the type; all other elements hold their nodes.
_SOLIDS = {5, 45, 62, 64, 69, 70, 73, 87, 90, 92, 95, 96, 97, 98, 122, 123, 162, 164, 168, 185, 186, 187, 190, 215, 226}
_SOLIDS |= {227, 231, 232, 236, 237, 239, 240, 278, 279, 285, 291, 30, 220, 221}
#: Kinds of solids by their number of nodes, and of hexes of 20 nodes by the first of equal corners, with their nodes.
_KINDS = {8: "hex", 20: "hex20", 10: "tetra10", 4: "tetra"}
_COLLAPSED = {
    (0, 1, 2, 2, 4, 5, 6, 6): ("wedge15", [0, 1, 2, 4, 5, 6, 8, 9, 11, 12, 13, 15, 16, 17, 18]),
    (0, 1, 2, 3, 4, 4, 4, 4): ("pyramid13", [0, 1, 2, 3, 4, 8, 9, 10, 11, 16, 17, 18, 19]),
    (0, 1, 2, 2, 4, 4, 4, 4): ("tetra10", [0, 1, 2, 4, 8, 9, 11, 16, 17, 18]),
}


class _Block(NamedTuple):
    """A block: its name in upper case, the words behind it, the columns of its fields, and its lines."""

    name: str
    words: list[str]
    columns: tuple[int, ...]
    lines: CardLines


def read(path: Path) -> Mesh:
    """Read nodes, solids and components; the elements of material N become the set "material N".

    Raises
    ------
    FileError
        For a malformed block.
    MeshError
        From `Mesh`.
    """
    files, model = JoinedFiles(path), DeckModel(path, "NBLOCK", "a database of Ansys MAPDL")
    types = {int(found[1]): int(found[2]) for found in _TYPE.finditer(files.data)}
    model.joining += dict.fromkeys(found[1].decode().upper() for found in _JOINING.finditer(files.data))
    for block in _blocks(files):
        lines = block.lines
        if block.name == "ETBLOCK":
            types.update(lines.cards(block.columns).integers(0, 2).tolist())
        elif block.name == "NBLOCK":
            cards, first = lines.cards(block.columns), _first_coordinate(block)
            model.nodes.append((cards.integers(0, 1)[:, 0], cards.reals(first, first + 3)))
        elif block.name == "EBLOCK":
            _read_elements(model, block, types)
        elif len(block.words) > 1 and block.words[1].upper()[:4] in ("NODE", "ELEM"):
            numbers = lines.cards(block.columns).integers(0, len(block.columns)).ravel()
            kind = "nodes" if block.words[1].upper().startswith("NODE") else "elements"
            model.add_set(kind, block.words[0], _members(numbers[numbers != 0]))
    return to_mesh(path, model.content(lambda number: f"material {number}" if number else ""))


def locate(path: Path) -> DeckCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    blocks = [block for block in _blocks(JoinedFiles(path)) if block.name == "NBLOCK"]
    parts = [DeckCoordinates.of_lines([block.lines], block.columns, _first_coordinate(block)) for block in blocks]
    return DeckCoordinates.joined(parts)


def _blocks(files: JoinedFiles) -> Iterator[_Block]:
    for found in _BLOCK.finditer(files.data):
        columns = tuple(int(width) for count, width in _FORMAT.findall(found[3]) for _ in range(min(int(count), 99)))
        if not columns or max(columns) > 99:
            raise files.root.error(f"{found[1].decode()} in {files.place(found.start())} has no format", DAMAGED)
        name = found[1].decode().upper()
        lines = CardLines(name, files, found.start(), *line_ranges(files.data, *found.span(4))).filled()
        last = [at for at, text in enumerate(lines.texts()) if text == "-1"]
        words = [word.strip() for word in found[2].decode("latin-1").partition("!")[0].split(",")[1:]]
        yield _Block(name, words, columns, lines.rows(slice(last[0] if last else None)))


def _first_coordinate(block: _Block) -> int:
    """Field of x: fields of reals are wider than those of integers before them."""
    return next((at for at, width in enumerate(block.columns) if width > block.columns[0]), 3)


def _members(numbers: np.ndarray) -> np.ndarray:
    """First and last numbers, (k, 2), of a list in which a negative one is the end of a range from the one before."""
    ends = np.append(numbers[1:] < 0, False)[: len(numbers)]
    following = np.append(-numbers[1:], 0)[: len(numbers)]
    return np.column_stack([numbers, np.where(ends, following, numbers)])[numbers > 0]


def _read_elements(model: DeckModel, block: _Block, types: dict[int, int]) -> None:
    """Add elements: eleven numbers and up to eight nodes in a line, more nodes in the next."""
    if "SOLID" not in [word.upper() for word in block.words]:
        model.others["EBLOCK without SOLID"] += 1
        return
    columns, at, starts = block.columns, 0, []
    numbers = block.lines.cards(columns).integers(0, max(len(columns), _HEAD + 8))
    counts = numbers[:, _N_NODES].tolist()
    while at < len(numbers):
        starts.append(at)
        at += 1 + (counts[at] > 8)
    if at > len(numbers):
        raise block.lines.error("ends within an element", DAMAGED)
    rows = np.array(starts, np.int64)
    head, nodes = numbers[rows, :_HEAD], np.zeros((len(rows), 20), np.int64)
    nodes[:, :8] = numbers[rows, _HEAD : _HEAD + 8]
    long = head[:, _N_NODES] > 8
    nodes[long, 8:] = numbers[rows[long] + 1, :12]
    nodes[np.arange(20) >= head[:, _N_NODES, None]] = 0
    types_of = np.array([types.get(one, 0) for one in head[:, _ELEMENT_TYPE].tolist()], np.int64)
    for number in np.unique(types_of).tolist():
        own = types_of == number
        if number in _SOLIDS or number == 0:
            _add_solids(model, block, rows[own], head[own], nodes[own])
            continue
        name = f"elements of type {number}"
        model.others[name] += int(own.sum())
        model.fixed[name].append(nodes[own].ravel())
        if number in _CONTACT:
            model.joining.append(name)


def _add_solids(model: DeckModel, block: _Block, rows: np.ndarray, head: np.ndarray, nodes: np.ndarray) -> None:
    """Add solids of some rows of lines; those that lack some of their mid-nodes have corners only."""

    def add(kind: str, which: np.ndarray, own: np.ndarray) -> None:
        places = block.lines.begin[rows[which]]
        model.add_elements(kind, places, head[which, _NUMBER], head[which, _MATERIAL], own)

    partial = (nodes[:, :8] != 0).all(axis=1) & (head[:, _N_NODES] > 10) & (nodes == 0).any(axis=1)
    if partial.any():
        model.fixed["solids without some of their mid-nodes"].append(nodes[partial, 8:].ravel())
        nodes = np.where(partial[:, None] & (np.arange(20) >= 8), 0, nodes)
    left = len(nodes)
    for kind, which, own in solids_by_width(nodes, _KINDS):
        left -= len(which)
        if kind == "hex20":
            first = (own[:, :8, None] == own[:, None, :8]).argmax(axis=2)
            for pattern, (name, columns) in _COLLAPSED.items():
                alike = (first == pattern).all(axis=1)
                add(name, which[alike], own[alike][:, columns])
                which, own, first = which[~alike], own[~alike], first[~alike]
        add(kind, which, own)
    if left:
        raise block.lines.error(f"holds {left} solids of other than 4, 8, 10 or 20 nodes", DAMAGED)


register(
    name="ansys",
    title="Ansys MAPDL",
    suffixes=(".cdb",),
    encodings=(),
    read=read,
    capabilities=frozenset(Capability) - {Capability.NODE_DATA, Capability.HEX_DATA, Capability.FIELD_DATA},
    exact=False,  # a field of a coordinate has 16 to 21 columns
    matches=lambda head: _FIRST.search(head) is not None,
    locate=locate,
)
