"""Starter decks of Radioss and OpenRadioss (.rad): nodes, solids, shells, parts and groups; coordinates are replaced.

*Altair Radioss Reference Guide*, "Starter Input": blocks /NODE, /BRICK, /BRIC20, /TETRA4, /TETRA10, /PENTA6, /SHELL,
/SH3N, /PART, /GRNOD, /GRBRIC and /SURF/SEG in fields of 10 columns, coordinates in 20.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np

from hexmend.io.base.content import VERTICAL_EDGES_FIRST, to_mesh, to_vtk_order
from hexmend.io.base.cursor import is_number
from hexmend.io.base.format import Capability, register
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.coordinates.joined_files import Inclusion, JoinedFiles, included_files
from hexmend.io.formats.decks.coordinates import DeckCoordinates
from hexmend.io.formats.decks.lines import CardLines, keyword_lines
from hexmend.io.formats.decks.model import DeckModel, solids_by_width
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import count_phrase

_NODE_COLUMNS, _COLUMNS = (10, 20, 20, 20), (10,) * 10
_NODES = ("NODE", "CNODE")
#: Nodes in each line of an element, and kinds by the number of nodes. /BRICK has tetrahedra of four nodes.
_ELEMENTS = {
    "BRICK": ((8,), {8: "hex", 4: "tetra"}), "TSHELL": ((8,), {8: "hex"}),
    "BRIC20": ((8, 8, 4), {20: "hex20", 8: "hex"}), "TETRA4": ((4,), {4: "tetra"}),
    "TETRA10": ((0, 10), {10: "tetra10", 4: "tetra"}), "PENTA6": ((6,), {6: "wedge"}),
    "SHELL": ((4,), {4: "quad", 3: "triangle"}), "SH3N": ((3,), {3: "triangle"}), "QUAD": ((4,), {4: "quad"}),
    "TRIA": ((3,), {3: "triangle"}), "TRUSS": ((2,), {2: "line"}),
}  # fmt: skip
#: Sets of a model, and whether members are first and last numbers, by the beginning of a block.
_SETS = {
    "GRNOD/NODE": ("nodes", False), "GRNOD/NODENS": ("nodes", False), "GRNOD/GENE": ("nodes", True),
    "GRBRIC/BRIC": ("solids", False), "GRBRIC/GENE": ("solids", True), "SURF/SEG": ("faces", False),
}  # fmt: skip
#: Blocks that join bodies, and those that hold nodes: the line behind the keyword, and the fields of that.
_JOINING = ("INTER", "RBODY", "RBE2", "RBE3", "RLINK", "CYL_JOINT", "SPRING", "MPC")
_HOLDING = {"RBODY": (1, 0, 1), "RBE2": (1, 0, 1), "RBE3": (1, 0, 1), "SPRING": (0, 1, 4), "BEAM": (0, 1, 4)}
#: Blocks that no note mentions.
_IGNORED = ("BEGIN", "TITLE", "END")
_INCLUDE = re.compile(rb"^#include[ \t]+(\S[^\n]*?)[ \t]*$", re.MULTILINE | re.IGNORECASE)
_END = re.compile(rb"^/END\b", re.MULTILINE)


def read(path: Path) -> Mesh:
    """Read the blocks that define a mesh; the elements of part N become the set of its title, or "part N".

    Raises
    ------
    FileError
        For a malformed line, and an included file that does not exist.
    MeshError
        From `Mesh`.
    """
    model = DeckModel(path, "/NODE", "a starter deck of Radioss")
    for lines in _blocks(path):
        _read_block(model, lines)
    return to_mesh(path, model.content())


def locate(path: Path) -> DeckCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    nodes = [lines.filled() for lines in _blocks(path) if lines.name.split("/")[1] in _NODES]
    return DeckCoordinates.of_lines(nodes, _NODE_COLUMNS, 1)


def _join(path: Path) -> JoinedFiles:
    return JoinedFiles(path, _inclusions, _END)


def _inclusions(data: bytes) -> Iterator[Inclusion]:
    for found in _INCLUDE.finditer(data):
        name = found[1].decode("utf-8", "replace")
        yield Inclusion(found.start(), *found.span(), "#include", [(name, *found.span(1))])


def _blocks(path: Path) -> Iterator[CardLines]:
    files = _join(path)
    for at, keyword, begin, end in keyword_lines(files.data, b"/", b"#", with_blank=True):
        yield CardLines(f"/{keyword}", files, at, begin, end)


def _read_block(model: DeckModel, lines: CardLines) -> None:
    """Add what a block defines to a model."""
    name, *rest = lines.name[1:].upper().split("/")
    number = next((int(word) for word in rest if is_number(word.strip())), 0)
    of_set = _SETS.get("/".join([name, *rest[:1]]))
    if name in _NODES:
        cards = lines.filled().cards(_NODE_COLUMNS)
        model.nodes.append((cards.integers(0, 1)[:, 0], cards.reals(1, 4)))
    elif name in _ELEMENTS:
        _read_elements(model, lines.filled(), name, number)
    elif name == "PART":
        model.part_names[number] = "".join(lines.texts()[:1])
    elif of_set:
        kind, are_ranges = of_set
        members = lines.rows(slice(1, None)).filled().cards(_COLUMNS).integers(0, 10)
        members = members[:, 1:5] if kind == "faces" else members[members != 0]
        members = members[: len(members) // 2 * 2].reshape(-1, 2) if are_ranges else members
        model.add_set(kind, "".join(lines.texts()[:1]) or f"{name.lower()} {number}", members)
    elif name not in _IGNORED:
        model.others[f"/{'/'.join([name, *rest[:1]]) if rest and not rest[0].isdecimal() else name}"] += 1
        if name in _JOINING:
            model.joining.append(f"/{name}")
        if name in _HOLDING:
            first, low, high = _HOLDING[name]
            cards = lines.rows(slice(first, first + 1 if first else None)).filled().cards(_COLUMNS)
            model.fixed[f"/{name}"].append(cards.integers(low, high).ravel())


def _read_elements(model: DeckModel, lines: CardLines, name: str, part: int) -> None:
    widths, kinds = _ELEMENTS[name]
    step = len(widths)
    if len(lines.begin) % step:
        raise lines.error(f"has {count_phrase(len(lines.begin), 'line')}: expected {step} an element", DAMAGED)
    first = lines.rows(slice(None, None, step)).cards(_COLUMNS).integers(0, 1 + widths[0])
    more = [lines.rows(slice(k, None, step)).cards(_COLUMNS).integers(0, 10) for k in range(1, step)]
    # nodes of a further line begin in its first field, or in the second, below those of the line before
    more = [np.roll(rows, -1, axis=1) if not rows[:, 0].any() else rows for rows in more]
    parts = [first[:, 1:], *(rows[:, :width] for rows, width in zip(more, widths[1:], strict=True))]
    nodes = np.column_stack(parts)
    if name == "SHELL":  # of a triangle
        nodes[nodes[:, 3] == nodes[:, 2], 3] = 0
    partial = (nodes[:, min(kinds) :] != 0).any(axis=1) & ~nodes.all(axis=1) & (step > 1)
    if partial.any():  # a mid-node may be left out
        model.fixed[f"/{name}"].append(nodes[partial].ravel())
        nodes[partial, min(kinds) :] = 0
    n_left = len(nodes)
    for kind, which, own in solids_by_width(nodes, kinds):
        n_left -= len(which)
        own = to_vtk_order(own, kind, VERTICAL_EDGES_FIRST)
        model.add_elements(kind, lines.begin[which * step], first[which, 0], part, own)
    if n_left:
        raise lines.error(f"has {count_phrase(n_left, 'element')} of another number of nodes", DAMAGED)


register(
    name="radioss",
    title="Radioss",
    suffixes=(".rad",),
    encodings=(),
    read=read,
    capabilities=frozenset(Capability) - {Capability.NODE_DATA, Capability.HEX_DATA, Capability.FIELD_DATA},
    exact=False,  # a field of a coordinate has 20 columns
    matches=lambda head: re.match(rb"(?:#[^\n]*\n)*(?:#RADIOSS STARTER|/BEGIN|/NODE\s*\n)", head) is not None,
    locate=locate,
    included=partial(included_files, _join),
)
