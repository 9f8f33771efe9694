"""Writer of Nastran's bulk data: GRID* cards in 16 columns, element cards in 8."""

from __future__ import annotations

from itertools import count
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base import numbering
from hexmend.io.base.content import Block, from_mesh, from_vtk_order
from hexmend.io.base.lower_order import lost_mid_nodes, reduce_order
from hexmend.io.formats.nastran.cards import CARD_OF_KIND, ORDER, PROPERTY_SET, is_exact, real_field
from hexmend.mesh.mesh import Mesh

#: Numbers of nodes and elements are below this: a field of 8 columns holds 8 digits.
_ID_LIMIT = 100_000_000


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
    node_ids = numbering.node_ids(dict(content.node_data), len(content.points), _ID_LIMIT)
    element_ids = numbering.element_ids(blocks, _ID_LIMIT)
    if max(int(node_ids.max()), *(int(ids.max(initial=0)) for ids in element_ids)) >= _ID_LIMIT:
        raise FileError(path, "a number of a node or element has more than 8 digits", "Write .vtu or .msh instead.")
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
            nodes = from_vtk_order(node_ids[block.nodes], block.kind, ORDER)
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
    left = numbering.unsupported_ids(mesh, _ID_LIMIT) + ([f"element sets that overlap ({words})"] if words else [])
    if not all(map(is_exact, mesh.points.ravel().tolist())):
        left.append("last digits of coordinates (a field holds 12 to 14)")
    return left + lost_mid_nodes(mesh, CARD_OF_KIND)


def _properties(block: Block) -> dict[int, np.ndarray]:
    """Members of the sets that are named after a property, by its number."""
    found = [(PROPERTY_SET.match(name), members) for name, members in block.sets.items()]
    return {int(match[1]): np.asarray(members, np.int64) for match, members in found if match}
