"""Step of all free nodes down an energy: a search direction, and a line search along it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from hexmend.arrays import differing_rows
from hexmend.energy import Hessian, MeshEnergy
from hexmend.energy.ranks import ONE_RANK, Ranks
from hexmend.kernels.line_search import LineSearch
from hexmend.kernels.step_limits import shorten
from hexmend.mesh.topology.components import any_of_rows
from hexmend.optimise.search_direction import (
    NEGLIGIBLE,
    DampedDirection,
    DirectionMethod,
    SearchDirection,
    TruncatedNewtonConfig,
    steepest_descent,
)


@dataclass(frozen=True)
class DescentConfig:
    """Limits of a step of all free nodes.

    Parameters
    ----------
    trials : int
        Line searches before no step is taken. After each of the first half the steps of infeasible nodes are halved,
        later they are set to 0. Also the number of times that steps are halved around hexes above their bound, at most.
    growth_factor, growth_summand : float
        Bound of a hex's energy after a step: a factor of the energy before, and a summand.
    """

    trials: int = TruncatedNewtonConfig.max_damping_increases // 2
    growth_factor: float = 2.0
    growth_summand: float = 1.0

    @property
    def short(self) -> float:
        """Step length that counts as short: the line search has halved it so many times."""
        return 0.5**self.trials


DESCENT = DescentConfig()
#: Largest coordinate of a step, in the unit of length of the mesh: squares of larger ones overflow.
LARGEST_COORDINATE = float(np.cbrt(np.finfo(float).max))


@dataclass(frozen=True, eq=False)
class Descent:
    """Step down an energy.

    Parameters
    ----------
    x : (n, 3) float64
        Points after the step, in mean edge lengths.
    value, slope : float
        Energy before the step, and its slope along the direction.
    gradient_norm : float
        Before the step.
    direction : SearchDirection
    alpha : float
        Step length; 0 where no step descends and x is unchanged.
    backtracks : int
        Of the line search.
    """

    x: np.ndarray
    value: float
    slope: float
    gradient_norm: float
    direction: SearchDirection
    alpha: float
    backtracks: int

    def diagnostics(self, delta: float) -> dict[str, float | int]:
        """Diagnostics of a `Step`."""
        return {
            "delta": delta,
            "gradient_norm": self.gradient_norm,
            "step_length": self.alpha,
            "backtracks": self.backtracks,
            "solver_iterations": self.direction.solver_iterations,
            "shift": self.direction.shift,
        }


def descend(
    energy: MeshEnergy,
    x: np.ndarray,
    delta: float,
    direction: DirectionMethod,
    search: LineSearch,
    max_step: float = np.inf,
) -> Descent | None:
    """Take one step; a direction that does not descend is damped where it can be, or replaced by steepest descent.

    Parameters
    ----------
    energy : MeshEnergy
    x : (n, 3) float64
        Points in mean edge lengths.
    delta : float
        In cubes of the mean edge length.
    direction : DirectionMethod
        Algorithm A.2, A.3 or A.4.
    search : LineSearch
        Line search: Algorithm A.5.
    max_step : float
        Longest move of a node, in mean lengths of its edges: the few nodes that a direction throws far away do not
        shorten the step of all others.

    Returns
    -------
    Descent or None
        None where the energy or its gradient is infinite.
    """
    value = energy.value(x, delta)
    if not np.isfinite(value):
        return None
    gradient = energy.gradient(x, delta)
    length = energy.ranks.norm(gradient)
    if not np.isfinite(length):
        return None
    if is_perfect(energy, value, delta):
        return Descent(x, value, 0.0, length, SearchDirection(np.zeros_like(gradient)), 0.0, 0)
    hessian = energy.hessian(x, delta)

    def along(found: SearchDirection, is_last: bool = False) -> Descent | None:
        """Take a step; None where the limits leave no descent, unless there is no other direction."""
        slope = _limit(energy, x, delta, found.vector, gradient, max_step, by_edges=not is_last)
        if not (slope < 0 or is_last):
            return None
        return _search(energy, x, delta, Descent(x, value, slope, length, found, 0.0, 0), gradient, search)

    found = direction(value, gradient, hessian)  # A.2, A.3, A.4
    if energy.ranks.any(~np.isfinite(found.vector)):
        found = steepest_descent(value, gradient, hessian)
    taken = along(found)
    while _is_poor(taken) and (damped := _damped(energy, delta, direction, gradient, hessian)):
        found = replace(damped, solver_iterations=found.solver_iterations + damped.solver_iterations)
        if not energy.ranks.any(~np.isfinite(found.vector)):
            taken = _lower(energy, delta, taken, along(found))
    return taken or along(steepest_descent(value, gradient, hessian), is_last=True)


def _search(
    energy: MeshEnergy, x: np.ndarray, delta: float, start: Descent, gradient: np.ndarray, search: LineSearch
) -> Descent:
    """Search along the direction of `start`, whose steps are shortened at nodes that they take where they may not."""
    found, slope = start.direction, start.slope
    for trial in range(DESCENT.trials):
        line = _Line(energy, x, delta, found.vector)
        alpha, backtracks = search(line.value, start.value, slope)  # A.5
        moved = line.points(alpha)
        infeasible = energy.infeasible_nodes(x, moved)
        if infeasible is None:
            return replace(start, x=moved, slope=slope, alpha=alpha, backtracks=backtracks)
        found.vector[infeasible[energy.nodes]] *= 0.5 if trial < DESCENT.trials // 2 else 0.0
        slope, search = energy.directional_derivative(x, delta, found.vector, gradient), search.with_initial_step(alpha)
    return replace(start, slope=slope, backtracks=backtracks)


def _is_poor(taken: Descent | None) -> bool:
    """Return True if there is no step, or the step is short although the energy falls along it."""
    return taken is None or (taken.alpha < DESCENT.short and -taken.slope > NEGLIGIBLE * abs(taken.value))


def _lower(energy: MeshEnergy, delta: float, one: Descent | None, other: Descent | None) -> Descent | None:
    """Return the step that ends lower."""
    if one is None or other is None:
        return one or other
    return other if energy.value(other.x, delta) < energy.value(one.x, delta) else one


def _damped(
    energy: MeshEnergy, delta: float, direction: DirectionMethod, gradient: np.ndarray, hessian: Hessian
) -> SearchDirection | None:
    """Return a direction that is damped more than the last.

    None with a barrier for inverted hexes (delta > 0) and for other methods than Newton's: steepest descent follows.
    """
    return direction.damped(gradient, hessian) if delta == 0 and isinstance(direction, DampedDirection) else None


class _Line:
    """Points along a step (k, 3) from x (n, 3); the points of the last trial are kept."""

    def __init__(self, energy: MeshEnergy, x: np.ndarray, delta: float, step: np.ndarray):
        self._energy, self._x, self._delta, self._step = energy, x, delta, step
        self._last: tuple[float, np.ndarray] | None = None

    def points(self, alpha: float) -> np.ndarray:
        """Return the points after a step of length alpha, (n, 3)."""
        if self._last is None or self._last[0] != alpha:
            self._last = None  # large meshes have no memory for both
            self._last = alpha, self._energy.moved(self._x, self._step, alpha)
        return self._last[1]

    def value(self, alpha: float) -> float:
        """Compute the energy at `points`."""
        return self._energy.value(self.points(alpha), self._delta)


def _limit(
    energy: MeshEnergy,
    x: np.ndarray,
    delta: float,
    step: np.ndarray,
    gradient: np.ndarray,
    max_step: float,
    by_edges: bool = True,
) -> float:
    """Limit a step (k, 3), changed, to the range of numbers, `max_step` and the hexes around; returns its slope."""
    shorten_to_range(step, energy.unit, energy.ranks)
    if np.isfinite(max_step):
        if by_edges:
            shorten(step, x, energy.mesh.topology.hex_mesh, energy.nodes, max_step)
        halve_harmful_steps(energy, x, delta, step)
    return energy.directional_derivative(x, delta, step, gradient)


def shorten_to_range(step: np.ndarray, unit: float, ranks: Ranks = ONE_RANK) -> None:
    """Shorten a step (k, 3), changed, that would overflow; `unit` is its unit of length in units of the mesh."""
    size = ranks.greatest(float(max(step.max(initial=0.0), -step.min(initial=0.0))))
    if size > LARGEST_COORDINATE / unit:
        step *= LARGEST_COORDINATE / unit / size


def halve_harmful_steps(energy: MeshEnergy, x: np.ndarray, delta: float, step: np.ndarray) -> None:
    """Halve the steps of infeasible nodes, and of nodes whose hexes would get much worse, so that others keep theirs.

    Parameters
    ----------
    energy : MeshEnergy
    x : (n, 3) float64
        Points in mean edge lengths.
    delta : float
    step : (k, 3) float64
        Of the free nodes, in mean edge lengths; changed.
    """
    hexes = energy.mesh.elements
    limit = energy.with_barriers(x, delta)
    limit *= DESCENT.growth_factor
    limit += DESCENT.growth_summand
    worsened, halved, moved, changed = np.zeros(len(hexes), dtype=bool), None, None, None
    for trial in range(DESCENT.trials):
        before = None if energy.motion.has_parts and not energy.limits_moves else moved
        del moved  # large meshes have no memory for two
        moved = energy.moved(x, step)
        if trial > 0:
            changed = halved if before is None else differing_rows(before, moved)
        at = None if changed is None else np.flatnonzero(any_of_rows(changed, hexes))
        some = slice(None) if at is None else at
        worsened[some] = ~(energy.with_barriers(moved, delta, at) <= limit[some])
        infeasible = energy.infeasible_nodes(x, moved, changed)
        halved = np.zeros(len(x), dtype=bool) if infeasible is None else infeasible.copy()
        halved[hexes.take(np.flatnonzero(worsened), axis=0)] = True
        halved = energy.with_tied(halved)
        if not energy.ranks.any(halved):
            break
        step[halved.take(energy.nodes)] *= 0.5
    else:
        if infeasible is not None:
            step[infeasible[energy.nodes]] = 0.0  # in many steps they would leave their band all the same


def is_perfect(energy: MeshEnergy, value: float, delta: float) -> bool:
    """Return True if every hex is a cube but for rounding, and no floor: gradient and Hessian are noise then."""
    if energy.barrier is not None:
        return False
    eta = 8 * np.finfo(float).eps  # of each of a hex's corners
    # Softened, a hex may have less energy than a cube.
    highest = energy.norm.contribution(eta) if delta == 0 else eta**energy.norm.p
    count = energy.n_hexes if energy.surface is None else energy.n_hexes + energy.surface.total_weight
    return bool(value <= count * highest)
