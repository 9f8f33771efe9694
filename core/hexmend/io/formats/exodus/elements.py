"""Element types of ExodusII: their kinds, and the order of their nodes and sides.

Sjaardema et al., *EXODUS: A Finite Element Data Model*, Sandia National Laboratories, section 4.8. A hex counts the
nodes of its vertical edges before those of its upper ones, and the node in its inside before those of its faces::

    Exodus, from 1      9-12      13-16       17-20     21        22 23 24 25 26 27
    edges, faces        lower     vertical    upper     inside    z- z+ x- x+ y- y+
"""

from __future__ import annotations

import re

import numpy as np

#: VTK's node order: vtk = exodus[ORDER[kind]]; kinds without an entry have one order in both.
ORDER = {
    "hex20": np.array([*range(12), *range(16, 20), *range(12, 16)]),
    "hex27": np.array([*range(12), *range(16, 20), *range(12, 16), 23, 24, 25, 26, 21, 22, 20]),
    "wedge15": np.array([*range(9), 12, 13, 14, 9, 10, 11]),
}

#: Face, of `hexmend.mesh.hexahedron.FACES`, of a hex's sides 1 to 6.
FACE_OF_SIDE = np.array([2, 1, 3, 0, 4, 5])
SIDE_OF_FACE = np.argsort(FACE_OF_SIDE) + 1

#: Kinds of an element type by the start of its name; the number of nodes tells them apart, the first has corners alone.
_KINDS = {
    "HEX": ("hex", "hex20", "hex27"), "TET": ("tetra", "tetra10"), "WEDGE": ("wedge", "wedge15"),
    "PYR": ("pyramid", "pyramid13"), "QUAD": ("quad", "quad8", "quad9"), "SHELL": ("quad", "quad8", "quad9"),
    "TRI": ("triangle", "triangle6"),
    **dict.fromkeys(("BAR", "BEAM", "TRUSS", "EDGE"), ("line", "line3")),
    **dict.fromkeys(("SPHERE", "POINT", "CIRCLE"), ("vertex",)),
}  # fmt: skip

#: Names of hexes; others that begin so, such as HEXSHELL, are other elements.
_HEX = re.compile(r"HEX(A|AHEDRON|AHEDRAL|AHEDRA)?[_-]?[0-9]*")


def kinds_of(type: str, n_nodes: int) -> tuple[str, ...]:
    """Kinds that an element type with a number of nodes may be, the first with corners alone; none if it is unknown.

    Examples
    --------
    >>> kinds_of("HEX8", 8), kinds_of("SHELL3", 3), kinds_of("BEX_HEX", 8)
    (('hex', 'hex20', 'hex27'), ('triangle', 'triangle6'), ())
    """
    if type.startswith("HEX") and not _HEX.fullmatch(type):
        return ()
    if type.startswith("SHELL") and n_nodes in (3, 6):
        return _KINDS["TRI"]
    return next((kinds for start, kinds in _KINDS.items() if type.startswith(start)), ())


#: Element type that each kind is written as.
TYPE_OF_KIND = {
    "hex": "HEX8", "hex20": "HEX20", "hex27": "HEX27", "tetra": "TETRA4", "tetra10": "TETRA10", "wedge": "WEDGE6",
    "wedge15": "WEDGE15", "pyramid": "PYRAMID5", "pyramid13": "PYRAMID13", "quad": "SHELL4", "quad8": "SHELL8",
    "quad9": "SHELL9", "triangle": "TRI3", "triangle6": "TRI6", "line": "BAR2", "line3": "BAR3", "vertex": "SPHERE",
}  # fmt: skip

#: Name of the node set property that is 1 for the set of the pinned nodes, and 0 for others.
PINS_PROPERTY = "hexmend_pins"
