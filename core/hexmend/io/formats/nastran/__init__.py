"""Nastran's bulk data (.bdf, .nas, .dat): grid points and elements, whose properties are sets."""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import count
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import Block, from_mesh
from hexmend.io.base.format import Capability, Format, register
from hexmend.io.base.lower_order import lost_mid_nodes, reduce_order
from hexmend.io.base.numbering import element_ids, node_ids, unsupported_ids
from hexmend.mesh.mesh import Mesh

#: What the elements of a kind are called.
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
#: Numbers of nodes and elements are below this: they have 8 digits at most.
_MOST = 100_000_000
_PROPERTY = re.compile(r"property ([1-9][0-9]{0,7})\Z")


def read(path: Path) -> Mesh:
    """Read grid points and elements; the elements of a property are the set "property N"."""
    from hexmend.io.formats.nastran import reader as nastran_read

    return nastran_read.read(path)


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write coordinates to 16 columns, and elements of the property that a set "property N" says, or of an unused one.

    Of the nodes of second order those in faces and in the middle of hexes are left out.
    """
    content = reduce_order(from_mesh(mesh), _NAMES)
    blocks = content.blocks
    tags, numbers = node_ids(dict(content.node_data), len(content.points), _MOST), element_ids(blocks, _MOST)
    if max(int(tags.max()), *(int(own.max(initial=0)) for own in numbers)) >= _MOST:
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


def _limitations(mesh: Mesh) -> list[str]:
    """Ids and digits without a place, properties that share elements with later ones, and mid-nodes, in words."""
    losing = set()
    for block in from_mesh(mesh).blocks:
        later = np.zeros(len(block), bool)
        for number, members in reversed(_properties(block).items()):
            if later[members].any():
                losing.add(number)
            later[members] = True
    words = ", ".join(f"property {number}" for number in sorted(losing))
    left = unsupported_ids(mesh, _MOST) + ([f"element sets that overlap ({words})"] if words else [])
    if not all(map(_is_exact, mesh.points.ravel().tolist())):
        left.append("last digits of coordinates (a column has a place for 12 to 14)")
    return left + lost_mid_nodes(mesh, _NAMES)


def _is_exact(value: float) -> bool:
    """Whether a real number has all its digits in 16 columns."""
    text = column(value)
    sign = max(text.rfind("+"), text.rfind("-"))  # that of the exponent, which has no letter
    return float(f"{text[:sign]}e{text[sign:]}" if sign > 0 else text) == value


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


def _matches(head: bytes) -> bool:
    return _FIRST(head) is not None


register(
    Format(
        name="nastran",
        title="Nastran",
        suffixes=(".bdf", ".nas", ".dat"),
        encodings=("ascii",),
        read=read,
        write=write,
        capabilities=frozenset(
            {
                Capability.IDS,
                Capability.OTHER_CELLS,
            }
        ),
        stored_names=_Properties(),
        limitations=_limitations,
        exact=False,  # a column has room for 12 to 14 digits
        matches=_matches,
    )
)
