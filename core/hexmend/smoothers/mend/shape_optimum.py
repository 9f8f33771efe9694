"""Second stage of mend: the optimum of shape, the minimum of (3.3) behind the barrier (Wilson 5.2.4)."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np

from hexmend.energy import MeshEnergy, ObjectiveNorm, energies
from hexmend.iteration import Outcome, Step
from hexmend.optimise.descent import Descent
from hexmend.smoothers.mend.local_sweeps import local_sweeps
from hexmend.smoothers.mend.newton_steps import NewtonConfig


@dataclass(frozen=True)
class ShapeOptimumConfig:
    """Settings of the stage.

    Parameters
    ----------
    poor : float
        Energy eta from which on a hex is poor: a few of them close to the barrier would shorten the step of all nodes,
        so that local sweeps work around them first.
    sweeps : int
        Sweeps of local Newton steps around poor hexes before a step of all nodes.
    converged : float
        Longest move of a node at which p is raised, in mean edge lengths.
    window : int
        Steps over which the fall of the objective is judged on a faceted surface, where the last steps go from facet
        to facet.
    min_fall, min_fall_omitting : float
        Share of the objective by which it must fall in these steps; the second while corners are omitted, which only
        a later stage can repair.
    """

    poor: float = 3.0
    sweeps: int = 5
    converged: float = 1e-3
    window: int = 5
    min_fall: float = 2e-3
    min_fall_omitting: float = 2e-2


@dataclass(frozen=True, eq=False)
class ShapeOptimum:
    """Result of the stage: points (n, 3) and outcome; the outcome is None before p is raised."""

    points: np.ndarray
    outcome: Outcome | None


def optimise_shape(
    energy: MeshEnergy,
    points: np.ndarray,
    max_p: float,
    intermediate: bool,
    config: ShapeOptimumConfig,
    newton: NewtonConfig,
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
    config : ShapeOptimumConfig
    newton : NewtonConfig

    Yields
    ------
    Step
        After each step of all nodes.
    """
    while True:
        reached = yield from _minimise(energy, points, energy.power.p < max_p, intermediate, config, newton)
        if reached.outcome is not None:
            return reached
        points, (p, offset) = reached.points, energy.power
        energy = energy.with_objective(ObjectiveNorm(min(2 * p, max_p), offset), energy.left_out)


def _minimise(
    energy: MeshEnergy,
    points: np.ndarray,
    rises: bool,
    intermediate: bool,
    config: ShapeOptimumConfig,
    newton: NewtonConfig,
) -> Generator[Step, None, ShapeOptimum]:
    """Minimise the energy with one p; if p `rises` afterwards, only until no node moves far."""
    omitted, hexes, find = energy.left_out, energy.mesh.hexes, newton.direction()
    min_fall = config.min_fall_omitting if omitted.any() else config.min_fall
    x, uncut = energy.to_edge_units(points), False
    values: list[float] = []
    while True:
        if not uncut:  # after a full step no hex has limited the line search
            poor = energies(x, hexes, 0.0, omitted) > config.poor
            if poor.any():
                x = local_sweeps(energy, x, poor, omitted, 0.0, config.sweeps)
        taken = newton.step(energy, x, 0.0, find)
        if taken is None or (taken.alpha == 0 and (taken.slope < 0 or intermediate)):
            break
        values.append(taken.value - energy.least)
        if (
            energy.faceted
            and len(values) > config.window
            and values[-config.window] - values[-1] < min_fall * values[-1]
        ):
            return ShapeOptimum(points, Outcome.NO_IMPROVEMENT)
        move = float(np.sqrt(np.square(taken.x - energy.to_edge_units(points)).sum(axis=1).max()))
        x, points, uncut = taken.x, energy.to_mesh_units(taken.x), taken.cuts == 0
        diagnostics = taken.diagnostics(0.0) | {"p": energy.power.p}
        yield Step(points, diagnostics, intermediate=rises or intermediate, power=energy.power)
        if rises and move < config.converged:
            break
    return ShapeOptimum(points, None if rises else _outcome(taken))


def _outcome(taken: Descent | None) -> Outcome:
    """Outcome where no step descends: at the optimum what a step would gain is less than rounding."""
    at_rounding = taken is not None and -taken.slope <= 1e-10 * taken.value  # both are 0 where all hexes are cubes
    return Outcome.CONVERGED if at_rounding else Outcome.NO_DESCENT
