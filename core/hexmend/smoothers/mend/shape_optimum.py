"""Second stage of mend: the optimum of shape, the minimum of (3.3) behind the barrier (Wilson 5.2.4)."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np

from hexmend.arrays import BLOCK, largest_norm
from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.iteration import Outcome, Step
from hexmend.smoothers.mend.local_sweeps import local_sweeps
from hexmend.smoothers.mend.newton_steps import DEFLATED_NEWTON, NewtonConfig


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
    negligible_move, negligible_fall : float
        Where another stage follows, this one ends when no node moves further than the first, in mean edge lengths or in
        lengths of its target, and the objective falls by less than the second, as a share of it.
    large : int
        Free nodes from which on `NewtonConfig.for_large_mesh` holds and, where another stage follows, this one ends too
        as soon as a slope that falls once more as much as it did counts as zero: a step takes seconds there, and no
        figure shows what it gains.
    small_move : float
        Longest move of a node with which a large mesh may end so, in the lengths above.
    short : float
        Share of its direction below which a step is short: the barrier of a few hexes stops all nodes.
    short_steps : int
        Successive short steps after which the stage ends; 0 for any number.
    rounding : float
        Slope, as a share of the energy, up to which it counts as zero.
    newton : NewtonConfig
        Of the steps of all nodes.
    """

    poor: float = 3.0
    sweeps: int = 5
    converged: float = 1e-3
    window: int = 5
    min_fall: float = 2e-3
    min_fall_omitting: float = 2e-2
    negligible_move: float = 1e-4
    negligible_fall: float = 1e-3
    large: int = 400_000
    small_move: float = 1e-2
    short: float = 0.01
    short_steps: int = 0
    rounding: float = 1e-10
    newton: NewtonConfig = DEFLATED_NEWTON


@dataclass(frozen=True, eq=False)
class ShapeOptimum:
    """Result of the stage: points (n, 3) and outcome; the outcome is None before p is raised."""

    points: np.ndarray
    outcome: Outcome | None


def optimise_shape(
    energy: MeshEnergy, points: np.ndarray, max_p: float, intermediate: bool, config: ShapeOptimumConfig
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

    Yields
    ------
    Step
        After each step of all nodes.
    """
    while True:
        steps = _minimise(energy, points, energy.norm.p < max_p, intermediate, config)
        del points  # large meshes have no memory for those before the first step
        reached = yield from steps
        if reached.outcome is not None:
            energy.release_workspace()
            return reached
        points, (p, offset) = reached.points, energy.norm
        energy = energy.with_objective(ObjectiveNorm(min(2 * p, max_p), offset), energy.omitted)


def _minimise(
    energy: MeshEnergy, points: np.ndarray, p_will_rise: bool, intermediate: bool, config: ShapeOptimumConfig
) -> Generator[Step, None, ShapeOptimum]:
    """Minimise the energy with one p; if p rises afterwards, only until no node moves far."""
    is_large = energy.ranks.sum(energy.nodes.size) >= config.large
    newton = config.newton.for_large_mesh() if is_large else config.newton
    omitted, direction, before = energy.omitted, newton.direction(), 0.0
    may_end = is_large and intermediate and not p_will_rise
    min_fall = config.min_fall_omitting if energy.ranks.any(omitted) else config.min_fall
    x, full_step = energy.to_edge_units(points), False
    values: list[float] = []
    short = 0
    while True:
        if not full_step:  # after a full step no hex has limited the line search
            poor = energy.hex_energies(x) > config.poor
            if energy.ranks.any(poor):
                x = local_sweeps(energy, x, poor, omitted, 0.0, config.sweeps)
        descent = newton.step(energy, x, 0.0, direction)
        if descent is None or (descent.alpha == 0 and (descent.slope < 0 or intermediate)):
            break
        values.append(descent.value - energy.cube_value)
        judged = (energy.faceted or energy.limits_moves) and len(values) > config.window
        if judged and values[-config.window] - values[-1] < min_fall * values[-1]:
            return ShapeOptimum(points, Outcome.NO_IMPROVEMENT)
        diagnostics, full_step = descent.diagnostics(0.0) | {"p": energy.norm.p}, descent.backtracks == 0
        x, slope = descent.x, -descent.slope
        short = short + 1 if descent.alpha < config.short else 0
        is_last = may_end and full_step and slope**2 <= config.rounding * descent.value * before
        before = slope if full_step else 0.0
        del descent  # large meshes have no memory for its direction
        move, relative_move = _largest_moves(energy, points, x)
        points = energy.to_mesh_units(x)
        yield Step(points, diagnostics, intermediate=p_will_rise or intermediate, norm=energy.norm)
        if p_will_rise and move < config.converged:
            break
        crawls = len(values) > 1 and values[-2] - values[-1] < config.negligible_fall * values[-1]
        if intermediate and crawls and relative_move < config.negligible_move:
            return ShapeOptimum(points, Outcome.CONVERGED)
        if is_last and relative_move < config.small_move:
            return ShapeOptimum(points, Outcome.CONVERGED)
        if 0 < config.short_steps == short:
            return ShapeOptimum(points, None if p_will_rise else Outcome.NO_IMPROVEMENT)
    if config.short_steps and not values:  # the start is the optimum: it was the last iteration that moved nodes
        yield Step(points, intermediate=p_will_rise or intermediate, norm=energy.norm)
    if p_will_rise:
        return ShapeOptimum(points, None)
    # At the optimum a step would gain less than rounding; slope and value are 0 where all hexes are cubes.
    converged = descent is not None and -descent.slope <= config.rounding * descent.value
    return ShapeOptimum(points, Outcome.CONVERGED if converged else Outcome.NO_DESCENT)


def _largest_moves(energy: MeshEnergy, points: np.ndarray, x: np.ndarray) -> tuple[float, float]:
    """Return the longest move from points (n, 3) to x (n, 3), in mean edge lengths, and in lengths of the target."""
    move = 0.0
    for first in range(0, len(x), BLOCK):
        rows = slice(first, first + BLOCK)
        move = float(np.maximum(move, largest_norm(x[rows] - points[rows] / energy.unit)))  # which keeps NaN
    move = energy.ranks.greatest(move)
    if energy.node_lengths is None:
        return move, move
    moves = (x[energy.nodes] - points[energy.nodes] / energy.unit) / energy.node_lengths
    return move, energy.ranks.greatest(largest_norm(moves))
