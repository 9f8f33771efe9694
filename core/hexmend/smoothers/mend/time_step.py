"""Stage of mend with the goal time-step: the smallest explicit time step is raised, at wave speed 1 a height."""

from __future__ import annotations

from collections.abc import Generator
from functools import partial

import numpy as np

from hexmend.energy import MeshEnergy
from hexmend.iteration import ActiveSet, Step
from hexmend.optimise.floors.movable_hexes import MovableHeights
from hexmend.smoothers.mend.floors import Floors

#: Factor of the rise from which on the stage begins again with a larger unit.
_NEW_UNIT = 2.0


def raise_time_step(
    energy: MeshEnergy, points: np.ndarray
) -> Generator[Step, None, tuple[np.ndarray, float, ActiveSet]]:
    """Raise the least height of the corners that can be moved from points (n, 3) on.

    Returns
    -------
    points : (n, 3) float64
    least : float
        The time step, in the unit of the mesh.
    active : ActiveSet
    """
    unit = Floors(energy, points, partial(MovableHeights, unit=1.0)).values.jacobian
    unit = unit if 0 < unit < np.inf else 1.0
    while True:
        floors = Floors(energy, points, partial(MovableHeights, unit=unit))
        yield from floors.rise(enough=_NEW_UNIT)
        points, least = floors.points, floors.values.jacobian * unit
        if not _NEW_UNIT * unit <= least < np.inf:
            break
        unit = least
    return points, least * energy.unit, floors.active_set()
