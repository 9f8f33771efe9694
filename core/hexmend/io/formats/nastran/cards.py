"""Element cards of Nastran's bulk data, their node order, and real numbers in fields of 16 columns.

Writer of Nastran's bulk data: GRID* cards in 16 columns, element cards in 8.
"""

from __future__ import annotations

import re
from itertools import count
from pathlib import Path

import numpy as np

from hexmend.io.base import numbering
from hexmend.io.base.content import VERTICAL_EDGES_FIRST, Block, from_mesh, from_vtk_order, node_count
from hexmend.io.base.lower_order import lost_mid_nodes, reduce_order
from hexmend.mesh.mesh import Mesh

#: Card by which the elements of each kind are written.
CARD_OF_KIND = {
    "hex": "CHEXA", "hex20": "CHEXA", "tetra": "CTETRA", "tetra10": "CTETRA", "wedge": "CPENTA", "wedge15": "CPENTA",
    "pyramid": "CPYRAM", "pyramid13": "CPYRAM", "quad": "CQUAD4", "quad8": "CQUAD8", "quad9": "CQUAD",
    "triangle": "CTRIA3", "triangle6": "CTRIA6", "line": "CROD",
}  # fmt: skip

#: Kinds of first and second order that the elements of a card may be; "" where it has no second order.
KINDS_OF_CARD = {
    "CHEXA": ("hex", "hex20"), "CTETRA": ("tetra", "tetra10"), "CPENTA": ("wedge", "wedge15"),
    "CPYRAM": ("pyramid", "pyramid13"), "CPYRA": ("pyramid", "pyramid13"), "CQUAD4": ("quad", ""),
    "CQUADR": ("quad", ""), "CSHEAR": ("quad", ""), "CQUAD8": ("quad", "quad8"), "CQUAD": ("quad", "quad9"),
    "CTRIA3": ("triangle", ""), "CTRIAR": ("triangle", ""), "CTRIA6": ("triangle", "triangle6"),
    "CBAR": ("line", ""), "CBEAM": ("line", ""), "CROD": ("line", ""), "CTUBE": ("line", ""), "PLOTEL": ("line", ""),
}  # fmt: skip

#: Solid elements, whose cards have nothing behind the nodes.
SOLIDS = ("CHEXA", "CTETRA", "CPENTA", "CPYRAM", "CPYRA")

#: Cards that are not read but hold or join grid points, and the first field that may name one.
NODES_OF_CARD = {
    "CBUSH": 2, "CBUSH1D": 2, "CELAS1": 2, "CELAS2": 2, "CELAS3": 2, "CELAS4": 2, "CDAMP1": 2, "CDAMP2": 2, "CGAP": 2,
    "CONM1": 1, "CONM2": 1, "CMASS1": 2, "CMASS2": 2, "RBAR": 1, "RBE1": 1, "RBE2": 1, "RBE3": 2, "RROD": 1,
}  # fmt: skip
#: Other cards by which bodies touch or are joined.
JOINING = {"MPC", "BCTSET", "BCONP", "BCTABLE", "BGSET", "CONTACT", "TIE"}

#: Name of the element set that holds the elements of a property; group 1 is the property's number (PID).
PROPERTY_SET = re.compile(r"property ([1-9][0-9]{0,7})\Z")


def element_layout(card: str) -> tuple[int, str, str, int, int]:
    """Layout of an element card: position of its nodes, kinds of first and second order, and their node counts.

    Without a second order the two node counts are equal.
    """
    linear, quadratic = KINDS_OF_CARD[card]
    n_corners = node_count(linear)
    first = 1 if card == "PLOTEL" else 2  # PLOTEL has no property
    return first, linear, quadratic, n_corners, node_count(quadratic) if quadratic else n_corners


def real_field(value: float) -> str:
    """Format a real number in at most 16 columns, with as many digits as fit.

    Parameters
    ----------
    value : float

    Returns
    -------
    str

    Raises
    ------
    ValueError
        For NaN and infinities.

    Examples
    --------
    >>> real_field(0.1), real_field(1e-300), real_field(-2 / 3 * 1e-5)
    ('0.1', '1.-300', '-6.66666666667-6')
    """
    text = repr(value)
    if len(text) <= 16 and "e" not in text:
        return text
    digits = 14 - (value < 0)  # besides the sign, the first digit and the point
    if 0.01 <= abs(value) < 1e12:
        text = f"{value:.{digits - len(str(int(abs(value)))) + 1}f}".rstrip("0")
        if len(text) <= 16:
            return text
    for decimals in range(digits - 2, 0, -1):
        mantissa, exponent = f"{value:.{decimals}e}".split("e")
        power = int(exponent)
        short = f"{mantissa.rstrip('0')}{f'{power:+d}' if power else ''}"
        if len(short) <= 16:
            return short
    raise ValueError(f"{value} does not fit into 16 columns")


def is_exact(value: float) -> bool:
    """Return True if a real number keeps all its digits in a field of 16 columns."""
    text = real_field(value)
    sign = max(text.rfind("+"), text.rfind("-"))  # of the exponent, which has no letter
    return float(f"{text[:sign]}e{text[sign:]}" if sign > 0 else text) == value


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write grid points and elements; mid-nodes of faces and of the inside of hexes are left out.

    Elements of a set "property N" have property N, all others an unused one.

    Raises
    ------
    FileError
        For more nodes or elements than numbers of 8 digits.
    """
    content = reduce_order(from_mesh(mesh), CARD_OF_KIND)
    blocks = content.blocks
    node_ids, element_ids = numbering.ids_of_columns(path, content)
    used = {number for block in blocks for number in _properties(block)}
    default = next(number for number in count(1) if number not in used)
    with open(path, "w", encoding="ascii") as file:
        file.write("$ Written by Hexmend\nBEGIN BULK\n")
        for node_id, (x, y, z) in zip(node_ids.tolist(), content.points.tolist(), strict=True):
            file.write(f"GRID*   {node_id:<16}{'':16}{real_field(x):<16}{real_field(y):<16}\n")
            file.write(f"*       {real_field(z)}\n")
        for block, ids in zip(blocks, element_ids, strict=True):
            property_ids = np.full(len(block), default)
            for number, members in _properties(block).items():
                property_ids[members] = number
            nodes = from_vtk_order(node_ids[block.nodes], block.kind, VERTICAL_EDGES_FIRST)
            card = f"{CARD_OF_KIND[block.kind]:<8}"
            for row in np.column_stack([ids, property_ids, nodes]).tolist():
                fields = "".join(f"{number:<8}" for number in row)
                lines = [fields[k : k + 64] for k in range(0, len(fields), 64)]
                file.write(card + "\n+       ".join(lines) + "\n")
        file.write("ENDDATA\n")


def limitations(mesh: Mesh) -> list[str]:
    """List the ids, overlapping properties, digits and mid-nodes of a mesh that a file cannot hold, in words."""
    overlapping = set()
    for block in from_mesh(mesh).blocks:
        in_later = np.zeros(len(block), bool)  # elements of a later property, which the file keeps
        for number, members in reversed(_properties(block).items()):
            if in_later[members].any():
                overlapping.add(number)
            in_later[members] = True
    words = ", ".join(f"property {number}" for number in sorted(overlapping))
    left = numbering.unsupported_ids(mesh, numbering.COLUMN_LIMIT) + (
        [f"element sets that overlap ({words})"] if words else []
    )
    if not all(map(is_exact, mesh.points.ravel().tolist())):
        left.append("last digits of coordinates (a field holds 12 to 14)")
    return left + lost_mid_nodes(mesh, CARD_OF_KIND)


def _properties(block: Block) -> dict[int, np.ndarray]:
    """Members of the sets that are named after a property, by its number."""
    found = [(PROPERTY_SET.match(name), members) for name, members in block.sets.items()]
    return {int(match[1]): np.asarray(members, np.int64) for match, members in found if match}
