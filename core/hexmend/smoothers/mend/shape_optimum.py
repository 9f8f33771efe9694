"""Second stage of mend: the optimum of shape, the minimum of (3.3) behind the barrier (Wilson 5.2.4)."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.iteration import Outcome, Step
from hexmend.optimise.search_direction import TruncatedNewton, TruncatedNewtonConfig
from hexmend.smoothers.mend.newton_steps import newton_step

#: Fall of the objective in so many steps, as a share of it, below which they are the last: of a stage that another one
#: follows, with one p before the next, and where steps are limited: on a faceted surface they go from facet to facet.
NEGLIGIBLE_FALL, STEPS = 2e-3, 4
#: Slope, as a share of the energy, up to which it counts as zero (Dennis and Schnabel 1983).
ROUNDING = float(np.cbrt(np.finfo(float).eps) ** 2)


@dataclass(frozen=True, eq=False)
class ShapeOptimum:
    """Result of the stage: points (n, 3) and outcome; the outcome is None before p is raised."""

    points: np.ndarray
    outcome: Outcome | None


def optimise_shape(
    energy: MeshEnergy, points: np.ndarray, max_p: float, intermediate: bool
) -> Generator[Step, None, ShapeOptimum]:
    """Minimise the energy at delta = 0, then with p doubled again and again up to `max_p`.

    Parameters
    ----------
    energy : MeshEnergy
        With the first p; no corner that is inverted at `points` counts in it.
    points : (n, 3) float64
    max_p : float
        No higher than the first p: minimise once.
    intermediate : bool
        Another stage follows.

    Yields
    ------
    Step
        After each step of all nodes.
    """
    while True:
        steps = _minimise(energy, points, energy.norm.p < max_p, intermediate)
        del points  # large meshes have no memory for those before the first step
        reached = yield from steps
        if reached.outcome is not None:
            energy.release_workspace()
            return reached
        points, (p, offset) = reached.points, energy.norm
        energy = energy.with_objective(ObjectiveNorm(min(2 * p, max_p), offset), energy.omitted)


def _minimise(
    energy: MeshEnergy, points: np.ndarray, p_will_rise: bool, intermediate: bool
) -> Generator[Step, None, ShapeOptimum]:
    """Minimise the energy with one p; if p rises afterwards, only until it hardly falls."""
    direction = TruncatedNewton(TruncatedNewtonConfig(deflated=True))
    x = energy.to_edge_units(points)
    values: list[float] = []
    before = 0.0
    while True:
        descent = newton_step(energy, x, 0.0, direction)
        if descent is None or (descent.alpha == 0 and (descent.slope < 0 or intermediate or p_will_rise)):
            break
        values.append(descent.value - energy.cube_value)
        judged = len(values) > STEPS and (p_will_rise or intermediate or energy.limits_moves)
        if judged and values[-1 - STEPS] - values[-1] < NEGLIGIBLE_FALL * values[-1]:
            ended = Outcome.NO_IMPROVEMENT if energy.limits_moves else Outcome.CONVERGED
            return ShapeOptimum(points, None if p_will_rise else ended)
        x, slope = descent.x, -descent.slope if descent.backtracks == 0 else 0.0
        # A slope that falls once more as much as it did counts as zero.
        is_last = (intermediate or p_will_rise) and 0 < slope**2 < ROUNDING * descent.value * before
        before = slope
        diagnostics = descent.diagnostics(0.0) | {"p": energy.norm.p}
        del descent  # large meshes have no memory for its direction
        points = energy.to_mesh_units(x)
        yield Step(points, diagnostics, intermediate=p_will_rise or intermediate, norm=energy.norm)
        if is_last:
            return ShapeOptimum(points, None if p_will_rise else Outcome.CONVERGED)
    if p_will_rise:
        return ShapeOptimum(points, None)
    # Slope and energy are 0 where all hexes are cubes.
    converged = descent is not None and -descent.slope <= ROUNDING * descent.value
    return ShapeOptimum(points, Outcome.CONVERGED if converged else Outcome.NO_DESCENT)
