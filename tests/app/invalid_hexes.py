"""Hexes that are invalid inside although det J is positive at their corners, built from formulas."""

import numpy as np

from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import NODE_POSITIONS

_CENTRED = UNIT_CUBE - [0.5, 0.5, 0.0]

#: Corners of a hex whose top is turned by 180 degrees, twice as long and half as wide: at the height z, det J is
#: (1 - 3 z) (1 - 1.5 z), which is negative between z = 1/3 and z = 2/3, and 1 at all corners.
FOLDED = np.where(_CENTRED[:, 2:] > 0, _CENTRED * [-2.0, -0.5, 1.0], _CENTRED)

#: Three hexes apart from each other: a cube, an inverted one (its corner 6 is pushed through it), and a folded one.
VALID, INVERTED, INSIDE = range(3)
_PUSHED = np.where(np.arange(8)[:, None] == 6, -0.8, _CENTRED)
THREE = Mesh(
    np.concatenate([_CENTRED, _PUSHED + [3.0, 0.0, 0.0], FOLDED + [6.0, 0.0, 0.0]]),
    np.arange(24, dtype=np.int32).reshape(3, 8),
)

#: A cube of second order whose inner nodes are moved along x, to x + 1.2 x (1 - x): det J is 2.2 - 2.4 x, negative beyond
#: x = 11/12, where the moved position is 121/120.
BENT = Mesh(
    NODE_POSITIONS + 1.2 * (NODE_POSITIONS * (1 - NODE_POSITIONS)) * [1.0, 0.0, 0.0],
    np.arange(8, dtype=np.int32)[None],
    mid_nodes=np.arange(8, 27, dtype=np.int32)[None],
)
