"""Newton step of all free nodes at once, which every stage of mend takes."""

from __future__ import annotations

import numpy as np

from hexmend.energy import MeshEnergy
from hexmend.kernels.line_search import LineSearch
from hexmend.optimise.descent import Descent, descend
from hexmend.optimise.search_direction import DampedDirection

_SEARCH = LineSearch(backtrack_factor=0.5)
#: How far a step may take a node, in mean lengths of the node's edges.
_MAX_STEP = 1.0


def newton_step(energy: MeshEnergy, x: np.ndarray, delta: float, direction: DampedDirection) -> Descent | None:
    """Take a step from x (n, 3), in mean edge lengths; None where the energy is infinite there."""
    return descend(energy, x, delta, direction, _SEARCH, _MAX_STEP)
