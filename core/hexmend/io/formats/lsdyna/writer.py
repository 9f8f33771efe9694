"""Writer of LS-DYNA's keyword files: nodes, solids by parts, and sets."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.io.base import numbering
from hexmend.io.base.content import from_mesh
from hexmend.io.base.lower_order import lost_mid_nodes, reduce_order
from hexmend.io.coordinates.text_coordinates import number_texts
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh

#: Places of the nodes of a solid among the eight of a hex.
_PLACES = {
    "hex": [*range(8)], "tetra": [0, 1, 2, 3, 3, 3, 3, 3], "pyramid": [0, 1, 2, 3, 4, 4, 4, 4],
    "wedge": [0, 2, 5, 3, 1, 1, 4, 4],
}  # fmt: skip
_EXACT = 15


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write nodes, solids in a part for each combination of element sets, and sets.

    Raises
    ------
    FileError
        For more nodes or elements than numbers of 8 digits.
    """
    content = reduce_order(from_mesh(mesh), _PLACES)
    node_ids, element_ids = numbering.ids_of_columns(path, content)
    with open(path, "w", encoding="utf-8") as file:
        file.write("*KEYWORD\n$ Written by Hexmend\n*NODE\n")
        for number, point in zip(node_ids.tolist(), content.points, strict=True):
            file.write(f"{number:8d}" + "".join(f"{text.decode():>16}" for text in number_texts(point, _EXACT)) + "\n")
        file.write("*PART\npart 1\n         1\n*ELEMENT_SOLID\n")
        for block, ids in zip(content.blocks, element_ids, strict=True):
            nodes = node_ids[block.nodes][:, _PLACES[block.kind]]
            for row in np.column_stack([ids, np.ones_like(ids), nodes]).tolist():
                file.write("".join(f"{one:8d}" for one in row) + "\n")
        sets = [("NODE_LIST", name, node_ids[members]) for name, members in content.node_sets.items()]
        for name in dict.fromkeys(name for block in content.blocks for name in block.sets):
            parts = zip(content.blocks, element_ids, strict=True)
            sets.append(("SOLID", name, np.concatenate([ids[b.sets[name]] for b, ids in parts if name in b.sets])))
        for name, rows in mesh.side_sets.items():
            sets.append(("SEGMENT", name, node_ids[mesh.hexes[rows[:, :1], FACES[rows[:, 1]]]]))
        for number, (kind, name, members) in enumerate(sets, 1):
            file.write(f"*SET_{kind}_TITLE\n{_title(name)}\n{number:10d}\n")
            width = 4 if kind == "SEGMENT" else 8
            flat = members.ravel().tolist()
            lines = (flat[k : k + width] for k in range(0, len(flat), width))
            file.writelines("".join(f"{one:10d}" for one in line) + "\n" for line in lines)
        file.write("*END\n")


def limitations(mesh: Mesh) -> list[str]:
    """List the ids, digits and mid-nodes of a mesh that a file cannot hold, in words."""
    left = numbering.unsupported_ids(mesh, numbering.COLUMN_LIMIT)
    texts = number_texts(mesh.points.ravel(), _EXACT)
    if [float(text) for text in texts] != mesh.points.ravel().tolist():
        left.append("last digits of coordinates (a field holds 9 to 14)")
    return left + lost_mid_nodes(mesh, _PLACES)


def _title(name: str) -> str:
    return " ".join(name.split())[:80]
