"""Second stage of mend: the optimum of shape, the minimum of (3.3) behind the barrier (Wilson 5.2.4)."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np

from hexmend.energy import MeshEnergy
from hexmend.iteration import Outcome, Step
from hexmend.optimise.search_direction import TruncatedNewton, TruncatedNewtonConfig
from hexmend.smoothers.mend.newton_steps import newton_step

#: Fall of the objective in so many steps, as a share of it, below which they are the last: of a stage that another one
#: follows, and where steps are limited: on a faceted surface they go from facet to facet.
NEGLIGIBLE_FALL, STEPS = 2e-3, 4

#: Slope, as a share of the energy, up to which it counts as zero (Dennis and Schnabel 1983).
ROUNDING = float(np.cbrt(np.finfo(float).eps) ** 2)


@dataclass(frozen=True, eq=False)
class ShapeOptimum:
    """Result of the stage: points (n, 3) and outcome."""

    points: np.ndarray
    outcome: Outcome


def optimise_shape(energy: MeshEnergy, points: np.ndarray, intermediate: bool) -> Generator[Step, None, ShapeOptimum]:
    """Minimise the energy at delta = 0.

    Parameters
    ----------
    energy : MeshEnergy
        No corner that is inverted at `points` counts in it.
    points : (n, 3) float64
    intermediate : bool
        Another stage follows.

    Yields
    ------
    Step
        After each step of all nodes.
    """
    direction = TruncatedNewton(TruncatedNewtonConfig(deflated=True))
    x = energy.to_edge_units(points)
    values: list[float] = []
    before = 0.0
    outcome: Outcome | None = None
    while outcome is None:
        descent = newton_step(energy, x, 0.0, direction)
        if descent is None or (descent.alpha == 0 and (descent.slope < 0 or intermediate)):
            # Slope and energy are 0 where all hexes are cubes.
            converged = descent is not None and -descent.slope <= ROUNDING * descent.value
            outcome = Outcome.CONVERGED if converged else Outcome.NO_DESCENT
            break
        values.append(descent.value - energy.cube_value)
        judged = len(values) > STEPS and (intermediate or energy.limits_moves)
        if judged and values[-1 - STEPS] - values[-1] < NEGLIGIBLE_FALL * values[-1]:
            outcome = Outcome.NO_IMPROVEMENT if energy.limits_moves else Outcome.CONVERGED
            break
        x, slope = descent.x, -descent.slope if descent.backtracks == 0 else 0.0
        # A slope that falls once more as much as it did counts as zero.
        is_last = intermediate and 0 < slope**2 < ROUNDING * descent.value * before
        before = slope
        diagnostics = descent.diagnostics(0.0) | {"p": energy.norm.p}
        del descent  # large meshes have no memory for its direction
        points = energy.to_mesh_units(x)
        yield Step(points, diagnostics, intermediate=intermediate, norm=energy.norm)
        outcome = Outcome.CONVERGED if is_last else None
    energy.release_workspace()
    return ShapeOptimum(points, outcome)
