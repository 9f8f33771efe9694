"""Nastran's bulk data (.bdf, .nas, .dat): grid points and elements, whose properties are sets."""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import count
from pathlib import Path

import numpy as np

from hexmend.cells import CELL_KINDS
from hexmend.errors import FileError
from hexmend.io.content import HEX_KINDS, ID, Block, Content, from_mesh
from hexmend.io.content import to_mesh as mesh_of
from hexmend.io.format import FORMATS, Format, Holds
from hexmend.io.nastran_bulk import Bulk
from hexmend.io.numbering import element_numbers, ids_lost, node_numbers, places
from hexmend.io.reduced import middles_lost, reduced
from hexmend.io.source import shown, text_of
from hexmend.mesh import Mesh

#: What the elements of a name are, of first and second order.
_KINDS = {
    "CHEXA": ("hex", "hex20"), "CTETRA": ("tetra", "tetra10"), "CPENTA": ("wedge", "wedge15"),
    "CPYRAM": ("pyramid", "pyramid13"), "CPYRA": ("pyramid", "pyramid13"), "CQUAD4": ("quad", ""),
    "CQUADR": ("quad", ""), "CSHEAR": ("quad", ""), "CQUAD8": ("quad", "quad8"), "CQUAD": ("quad", "quad9"),
    "CTRIA3": ("triangle", ""), "CTRIAR": ("triangle", ""), "CTRIA6": ("triangle", "triangle6"),
    "CBAR": ("line", ""), "CBEAM": ("line", ""), "CROD": ("line", ""), "CTUBE": ("line", ""), "PLOTEL": ("line", ""),
}  # fmt: skip
_NAMES = {
    "hex": "CHEXA", "hex20": "CHEXA", "tetra": "CTETRA", "tetra10": "CTETRA", "wedge": "CPENTA", "wedge15": "CPENTA",
    "pyramid": "CPYRAM", "pyramid13": "CPYRAM", "quad": "CQUAD4", "quad8": "CQUAD8", "quad9": "CQUAD",
    "triangle": "CTRIA3", "triangle6": "CTRIA6", "line": "CROD",
}  # fmt: skip

#: VTK's order of nodes: nodes[ORDER[kind]] of Nastran's, in which upright edges come before those above.
ORDER = {
    "hex20": [*range(12), 16, 17, 18, 19, 12, 13, 14, 15],
    "wedge15": [*range(9), 12, 13, 14, 9, 10, 11],
}
_PROPERTY = re.compile(r"property ([1-9][0-9]{0,7})\Z")


def read(path: Path) -> Mesh:
    """Read grid points and elements; the elements of a property are the set "property N"."""
    bulk = Bulk(path, text_of(path).decode("latin-1").replace("\r\n", "\n").replace("\r", "\n"))
    ids: list[int] = []
    points: list[list[float]] = []
    rows: dict[str, list[list[int]]] = {}
    other: dict[str, int] = {}
    partial = 0
    for line, name, fields in bulk.cards():
        if name in ("GRID", "GRDSET"):
            if bulk.whole(fields[1], line, name):
                raise bulk.error(
                    f"{name} in line {line} is in the coordinate system {fields[1]}: expected 0, x, y and z",
                    "Write the file with all grid points in the basic coordinate system.",
                )
            if name == "GRID":
                ids.append(bulk.whole(fields[0], line, name))
                points.append([bulk.real(word, line, name) for word in [*fields, ""][2:5]])
        elif name in _KINDS:
            kind, row, whole = _element(bulk, line, name, fields)
            rows.setdefault(kind, []).append(row)
            partial += not whole
        elif name.startswith("INCLUDE"):
            raise bulk.error(f"INCLUDE in line {line} takes what follows from another file", "Put its content there.")
        elif name != "ENDDATA":
            other[name] = other.get(name, 0) + 1
    if not ids:
        raise bulk.error("has no GRID", "Is it a file of Nastran's bulk data? Check its suffix.")
    notes = []
    if partial:
        notes.append(f"{partial:,} elements have some of their mid-nodes only: they are read with their corners.")
    if other:
        words = ", ".join(f"{count:,} {shown(name)[1:-1]}" for name, count in list(other.items())[:6])
        notes.append(f"Other cards ({words}{', ...' if len(other) > 6 else ''}) are left out.")
    tags = np.array(ids, np.int64)
    blocks = [_block(path, kind, np.array(rows[kind], np.int64), tags) for kind in rows]
    blocks.sort(key=lambda block: (block.kind not in HEX_KINDS, HEX_KINDS.get(block.kind, 0)))
    return mesh_of(path, Content(np.array(points), tuple(blocks), {ID: tags}, notes=tuple(notes)))


def _element(bulk: Bulk, line: int, name: str, fields: list[str]) -> tuple[str, list[int], bool]:
    """The kind of an element, its number, property and nodes, and whether it has all or none of its mid-nodes."""
    small, large = _KINDS[name]
    first = 1 if name == "PLOTEL" else 2
    property = bulk.whole(fields[1], line, name) if first == 2 else 0
    width = _width(small)
    longest = _width(large) if large else width
    nodes = [bulk.whole(word, line, name) for word in fields[first : first + longest]]
    if len(nodes) < width or 0 in nodes[:width]:
        raise bulk.error(
            f"{name} in line {line} has {sum(map(bool, nodes[:width]))} nodes: expected {width}",
            "Write the file again with the program that made it: it is damaged or cut short.",
        )
    more = sum(map(bool, nodes[width:]))
    kind = large if large and more == longest - width else small
    head = [bulk.whole(fields[0], line, name), property]
    return kind, head + nodes[: longest if kind == large else width], kind == large or not more


def _block(path: Path, kind: str, rows: np.ndarray, tags: np.ndarray) -> Block:
    nodes = places(path, tags, rows[:, 2:], "node")
    numbers = np.unique(rows[:, 1]).tolist()
    sets = {f"property {number}": np.flatnonzero(rows[:, 1] == number) for number in numbers if number > 0}
    return Block(kind, nodes[:, ORDER[kind]] if kind in ORDER else nodes, {ID: rows[:, 0].copy()}, sets)


def _width(kind: str) -> int:
    return HEX_KINDS[kind] if kind in HEX_KINDS else CELL_KINDS[kind].nodes


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write coordinates to 16 columns, and elements of the property that a set "property N" says, or of an unused one.

    Of the nodes of second order those in faces and in the middle of hexes are left out.
    """
    content = reduced(from_mesh(mesh), _NAMES)
    blocks = content.blocks
    tags, numbers = node_numbers(dict(content.node_data), len(content.points)), element_numbers(blocks)
    if max(int(tags.max()), *(int(own.max(initial=0)) for own in numbers)) > 99_999_999:
        raise FileError(path, "a number of a node or element has more than 8 digits", "Write .vtu or .msh instead.")
    used = {number for block in blocks for number in _properties(block)}
    none = next(number for number in count(1) if number not in used)
    with open(path, "w", encoding="ascii") as file:
        file.write("$ Written by Hexmend\nBEGIN BULK\n")
        for tag, (x, y, z) in zip(tags.tolist(), content.points.tolist(), strict=True):
            file.write(f"GRID*   {tag:<16}{'':16}{column(x):<16}{column(y):<16}\n*       {column(z)}\n")
        for block, own in zip(blocks, numbers, strict=True):
            property = np.full(len(block), none)
            for number, members in _properties(block).items():
                property[members] = number
            nodes = tags[block.nodes]
            if block.kind in ORDER:
                nodes = nodes[:, np.argsort(ORDER[block.kind])]
            name = f"{_NAMES[block.kind]:<8}"
            for row in np.column_stack([own, property, nodes]).tolist():
                words = "".join(f"{number:<8}" for number in row)
                lines = [words[k : k + 64] for k in range(0, len(words), 64)]
                file.write(name + "\n+       ".join(lines) + "\n")
        file.write("ENDDATA\n")


def _properties(block: Block) -> dict[int, np.ndarray]:
    """Members of the sets that name properties, by their numbers."""
    found = [(_PROPERTY.match(name), members) for name, members in block.sets.items()]
    return {int(match[1]): np.asarray(members, np.int64) for match, members in found if match}


def _cannot(mesh: Mesh) -> list[str]:
    """Ids that are none here, properties that share elements with later ones, and mid-nodes, in words."""
    losing = set()
    for block in from_mesh(mesh).blocks:
        later = np.zeros(len(block), bool)
        for number, members in reversed(_properties(block).items()):
            if later[members].any():
                losing.add(number)
            later[members] = True
    words = ", ".join(f"property {number}" for number in sorted(losing))
    return ids_lost(mesh) + ([f"element sets that overlap ({words})"] if words else []) + middles_lost(mesh, _NAMES)


def column(value: float) -> str:
    """A real number in 16 columns, with as many digits as they have room for.

    >>> column(0.1), column(1e-300), column(-2 / 3 * 1e-5)
    ('0.1', '1.-300', '-6.66666666667-6')
    """
    text = repr(value)
    if len(text) <= 16 and "e" not in text:
        return text
    room = 14 - (value < 0)  # beside the sign, the first digit and the point
    if 0.01 <= abs(value) < 1e12:
        text = f"{value:.{room - len(str(int(abs(value)))) + 1}f}".rstrip("0")
        if len(text) <= 16:
            return text
    for digits in range(room - 2, 0, -1):
        mantissa, exponent = f"{value:.{digits}e}".split("e")
        power = int(exponent)
        short = f"{mantissa.rstrip('0')}{f'{power:+d}' if power else ''}"
        if len(short) <= 16:
            return short
    raise ValueError(f"{value} has no place in 16 columns")


class _Properties(frozenset):
    """Names of sets that are held: all that name a property."""

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and _PROPERTY.match(name) is not None


_FIRST: Callable[[bytes], re.Match[bytes] | None] = re.compile(
    rb"(?:[ \t]*(?:\$[^\n]*)?\r?\n)*[ \t]*"
    rb"(?:BEGIN[ \t,]*BULK|SOL[ \t]+[0-9A-Z]|CEND|NASTRAN[ \t]|ID[ \t]|GRID\*?[ \t,]+[0-9]|CHEXA\*?[ \t,]+[0-9])",
    re.IGNORECASE,
).match


def _recognised(head: bytes) -> bool:
    return _FIRST(head) is not None


FORMATS.add(
    "nastran",
    Format(
        "nastran",
        "Nastran",
        (".bdf", ".nas", ".dat"),
        ("ascii",),
        read,
        write,
        holds=frozenset({Holds.IDS, Holds.OTHER_CELLS}),
        names=_Properties(),
        recognised=_recognised,
        exact=False,  # a column has room for 12 to 14 digits
        cannot=_cannot,
    ),
)
