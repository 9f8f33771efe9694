"""Last stage of mend with the goal time-step: the smallest explicit time step is raised."""

from __future__ import annotations

from collections.abc import Generator, Sequence

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.iteration import Step
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.maxmin.corner_measure import time_step_measure
from hexmend.optimise.maxmin.slp import MaxMinOptimiser
from hexmend.smoothers.mend.maxmin import maximise_minimum
from hexmend.smoothers.mend.surface.detours import MaxMinResult

#: Factor of the rise from which on the stage begins again with a larger unit: its thresholds suit values near 1.
_NEW_UNIT = 2.0


def maximise_time_step(
    mesh: Mesh, candidates: Sequence[np.ndarray], sliding: SlidingBoundary | None, untangled: MaxMinResult | None
) -> Generator[Step, None, MaxMinResult]:
    """Raise the least time step of the corners that can be moved: the least height over the faces, at wave speed 1.

    Parameters
    ----------
    mesh : Mesh
    candidates : sequence of (n, 3) float64
        Points of which the best are the start.
    sliding : SlidingBoundary or None
        None where the boundary is fixed.
    untangled : MaxMinResult or None
        Where the minimum scaled Jacobian of all candidates was too low, the result of raising it: then the start.

    Yields
    ------
    Step

    Returns
    -------
    MaxMinResult
    """
    measure = time_step_measure(1.0)
    if untangled is not None:
        optimiser = untangled.optimiser.measured_by(measure)
    else:
        optimisers = [MaxMinOptimiser(mesh, points, sliding, measure=measure) for points in candidates]
        optimiser = max(optimisers, key=lambda one: one.corners.active_minimum)
    while True:
        least = optimiser.least
        unit = least if 0 < least < np.inf else mesh.mean_edge_length or 1.0
        optimiser = optimiser.measured_by(time_step_measure(unit))
        active = yield from maximise_minimum(optimiser)
        if not _NEW_UNIT * unit < optimiser.least < np.inf:
            return MaxMinResult(optimiser, active)
