"""Abaqus's element types, and their order of nodes and faces (*Abaqus Elements Guide*)."""

from __future__ import annotations

import re

#: Kinds by a pattern of their types; prefixes such as DC (heat) and suffixes such as R (reduced integration) vary.
_PATTERNS = (
    (r"(?:[A-Z]*C|F)3D(8|20|27)[A-Z]*", {"8": "hex", "20": "hex20", "27": "hex27"}),
    (r"(?:[A-Z]*C|F)3D(4|5|6|10|13|15)[A-Z]*",
     {"4": "tetra", "5": "pyramid", "6": "wedge", "10": "tetra10", "13": "pyramid13", "15": "wedge15"}),
    (r"(?:SC|CSS)(6|8)[A-Z]*", {"6": "wedge", "8": "hex"}),
    (r"(?:S|STRI|M3D|SFM3D|R3D|DS|CPE|CPS|CAX|CPEG|DC2D|AC2D|DCAX|ACAX)(3|4|65|6|8|9)[A-Z0-9]*",
     {"3": "triangle", "4": "quad", "6": "triangle6", "65": "triangle6", "8": "quad8", "9": "quad9"}),
    (r"(?:T3D|T2D|DC1D|RB3D|R2D)(2|3)[A-Z]*", {"2": "line", "3": "line3"}),
    (r"B[23](1|2)[A-Z]*", {"1": "line", "2": "line3"}),
    (r"(MASS)", {"MASS": "vertex"}),
)  # fmt: skip
_COMPILED = [(re.compile(pattern), kinds) for pattern, kinds in _PATTERNS]

#: Type of each kind of cells whose type is not known from a file.
DEFAULT_TYPES = {
    "hex": "C3D8", "hex20": "C3D20", "hex27": "C3D27", "tetra": "C3D4", "tetra10": "C3D10", "wedge": "C3D6",
    "wedge15": "C3D15", "pyramid": "C3D5", "pyramid13": "C3D13", "triangle": "S3", "triangle6": "STRI65",
    "quad": "S4", "quad8": "S8R", "quad9": "S9R5", "line": "T3D2", "line3": "T3D3", "vertex": "MASS",
}  # fmt: skip

#: VTK's node order: vtk = abaqus[ORDER[kind]]. The mid-node of a line lies between its ends; in a hex of 27 nodes the
#: centre comes before the faces S1 to S6. Kinds without an entry have one order in both.
ORDER = {"line3": [0, 2, 1], "hex27": [*range(20), 26, 24, 23, 25, 21, 22, 20]}

#: Face, of `hexmend.mesh.hexahedron.FACES`, of the face identifiers S1 to S6 of a hex.
FACE_OF_SIDE = {"S1": 4, "S2": 5, "S3": 2, "S4": 1, "S5": 3, "S6": 0}
SIDE_OF_FACE = {face: side for side, face in FACE_OF_SIDE.items()}


def kind_of(type: str) -> str | None:
    """Kind of the elements of a type, one of `HEX_KINDS` or `CELL_KINDS`; None for types that are not read.

    Examples
    --------
    >>> kind_of("C3D8R"), kind_of("DC3D20"), kind_of("S4RSW"), kind_of("SPRINGA")
    ('hex', 'hex20', 'quad', None)
    """
    for pattern, kinds in _COMPILED:
        found = pattern.fullmatch(type)
        if found:
            return kinds[found[1]]
    return None
