"""ExodusII's elements: what its types are called here, and the order of their nodes and sides.

Sjaardema et al., *EXODUS: A Finite Element Data Model*, Sandia National Laboratories, section 4.8. A hex counts the
nodes of its vertical edges before those of its upper ones, and the node in its inside before those of its faces::

    Exodus, from 1      9-12      13-16       17-20     21        22 23 24 25 26 27
    what it is          lower     vertical    upper     inside    z- z+ x- x+ y- y+
"""

from __future__ import annotations

import re

import numpy as np

#: Where VTK's nodes are among Exodus' ones; kinds that are not named have the same order. vtk = exodus[ORDER[kind]].
ORDER = {
    "hex20": np.array([*range(12), *range(16, 20), *range(12, 16)]),
    "hex27": np.array([*range(12), *range(16, 20), *range(12, 16), 23, 24, 25, 26, 21, 22, 20]),
    "wedge15": np.array([*range(9), 12, 13, 14, 9, 10, 11]),
}

#: The face, of `hexmend.mesh.hexahedron.FACES`, that is a hex's side 1 to 6.
FACE_OF_SIDE = np.array([2, 1, 3, 0, 4, 5])
SIDE_OF_FACE = np.argsort(FACE_OF_SIDE) + 1

#: What types begin with, before the number of nodes, and the kinds that they are by that number; the first kind has the
#: corners alone.
FAMILIES = {
    "HEX": ("hex", "hex20", "hex27"),
    "TET": ("tetra", "tetra10"),
    "WEDGE": ("wedge", "wedge15"),
    "PYR": ("pyramid", "pyramid13"),
    "QUAD": ("quad", "quad8", "quad9"),
    "SHELL": ("quad", "quad8", "quad9"),
    "TRI": ("triangle", "triangle6"),
    "BAR": ("line", "line3"),
    "BEAM": ("line", "line3"),
    "TRUSS": ("line", "line3"),
    "EDGE": ("line", "line3"),
    "SPHERE": ("vertex",),
    "POINT": ("vertex",),
    "CIRCLE": ("vertex",),
}

#: What types of hexes are called; others that begin so, such as HEXSHELL, are something else.
_HEX = re.compile(r"HEX(A|AHEDRON|AHEDRAL|AHEDRA)?[_-]?[0-9]*")


def family_of(type: str, width: int) -> tuple[str, ...]:
    """Kinds of a type of elements with so many nodes, of which the first has the corners alone; none if it is unknown.

    Examples
    --------
    >>> family_of("HEX8", 8), family_of("SHELL3", 3), family_of("BEX_HEX", 8)
    (('hex', 'hex20', 'hex27'), ('triangle', 'triangle6'), ())
    """
    if type.startswith("HEX") and not _HEX.fullmatch(type):
        return ()
    if type.startswith("SHELL") and width in (3, 6):
        return FAMILIES["TRI"]
    return next((kinds for start, kinds in FAMILIES.items() if type.startswith(start)), ())


#: What kinds are written as.
TYPES = {
    "hex": "HEX8", "hex20": "HEX20", "hex27": "HEX27", "tetra": "TETRA4", "tetra10": "TETRA10", "wedge": "WEDGE6",
    "wedge15": "WEDGE15", "pyramid": "PYRAMID5", "pyramid13": "PYRAMID13", "quad": "SHELL4", "quad8": "SHELL8",
    "quad9": "SHELL9", "triangle": "TRI3", "triangle6": "TRI6", "line": "BAR2", "line3": "BAR3", "vertex": "SPHERE",
}  # fmt: skip

#: Name of the property that is 1 of the set of nodes that holds the pins, and 0 of others.
PINS = "hexmend_pins"
