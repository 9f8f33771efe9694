"""Gmsh's element types: their kinds, numbers of nodes and node order (*Gmsh Reference Manual*, "Node ordering")."""

from __future__ import annotations

from pathlib import Path

from hexmend.errors import FileError
from hexmend.io.base.cell_kinds import node_count

#: Kind of cell of every element type that is read.
KIND_OF_TYPE = {
    15: "vertex", 1: "line", 8: "line3", 2: "triangle", 9: "triangle6", 3: "quad", 16: "quad8", 10: "quad9",
    4: "tetra", 11: "tetra10", 6: "wedge", 18: "wedge15", 7: "pyramid", 19: "pyramid13",
    5: "hex", 17: "hex20", 12: "hex27",
}  # fmt: skip
TYPE_OF_KIND = {kind: type for type, kind in KIND_OF_TYPE.items()}

#: Number of nodes of the element types that are left out.
_OTHER_NODE_COUNTS = {13: 18, 14: 14, 20: 9, 21: 10, 22: 12, 23: 15, 24: 15, 25: 21, 26: 4, 27: 5, 28: 6}
_OTHER_NODE_COUNTS |= {29: 20, 30: 35, 31: 56, 36: 16, 37: 25, 38: 36, 90: 40, 91: 75, 92: 64, 93: 125}

#: VTK's node order: vtk = gmsh[ORDER[kind]]. Gmsh orders edges by their lower corner, and the faces of a hex as z-, y-,
#: x-, x+, y+, z+.
ORDER = {
    "hex20": [*range(8), 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15],
    "hex27": [*range(8), 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26],
    "tetra10": [0, 1, 2, 3, 4, 5, 6, 7, 9, 8],
    "wedge15": [0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11],
    "pyramid13": [0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12],
}


def nodes_per_element(path: Path, type: int) -> int:
    """Number of nodes of an element type.

    Raises
    ------
    FileError
        For a type that Gmsh does not have.
    """
    if type in KIND_OF_TYPE:
        return node_count(KIND_OF_TYPE[type])
    if type not in _OTHER_NODE_COUNTS:
        problem = f"has elements of the type {type}, which is unknown"
        raise FileError(path, problem, "Write it with elements of order 1 or 2.")
    return _OTHER_NODE_COUNTS[type]
