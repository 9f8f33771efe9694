"""Step of all free nodes down an energy: a search direction, and a line search along it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.arrays import norm
from hexmend.energy import MeshEnergy, energies
from hexmend.kernels.line_search import LineSearch
from hexmend.kernels.step_limits import shorten
from hexmend.optimise.search_direction import Direction, SearchDirection, steepest_descent


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
    found : SearchDirection
        The direction.
    alpha : float
        Step length; 0 where no step descends and x is unchanged.
    cuts : int
        Backtracks of the line search.
    """

    x: np.ndarray
    value: float
    slope: float
    gradient_norm: float
    found: SearchDirection
    alpha: float
    cuts: int

    def diagnostics(self, delta: float) -> dict[str, float | int]:
        """Diagnostics of a `Step`."""
        return {
            "delta": delta,
            "gradient_norm": self.gradient_norm,
            "step_length": self.alpha,
            "cuts": self.cuts,
            "solver_iterations": self.found.solver_iterations,
            "shift": self.found.shift,
        }


def descend(
    energy: MeshEnergy,
    x: np.ndarray,
    delta: float,
    find: Direction,
    search: LineSearch,
    reach: float = np.inf,
) -> Descent | None:
    """Take one step.

    A direction that does not descend is replaced by steepest descent.

    Parameters
    ----------
    energy : MeshEnergy
    x : (n, 3) float64
        Points in mean edge lengths.
    delta : float
        In cubes of the mean edge length.
    find : Direction
        Search direction: Algorithm A.2, A.3 or A.4.
    search : LineSearch
        Line search: Algorithm A.5.
    reach : float
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
    length = norm(gradient)
    if not np.isfinite(length):
        return None
    if is_perfect(energy, value, delta):
        return Descent(x, value, 0.0, length, SearchDirection(np.zeros_like(gradient)), 0.0, 0)
    hessian = energy.hessian(x, delta)
    found = find(value, gradient, hessian)  # A.2, A.3, A.4
    if not np.isfinite(found.p).all():
        found = steepest_descent(value, gradient, hessian)
    slope = _limit(energy, x, delta, found.p, gradient, reach)
    if not slope < 0:
        found = steepest_descent(value, gradient, hessian)
        slope = _limit(energy, x, delta, found.p, gradient, reach, by_edges=False)
    for trial in range(MAX_SEARCHES):
        alpha, cuts = search(lambda alpha: energy.value(energy.moved(x, found.p, alpha), delta), value, slope)  # A.5
        there = energy.moved(x, found.p, alpha)
        infeasible = energy.infeasible_nodes(x, there)
        if infeasible is None:
            return Descent(there, value, slope, length, found, alpha, cuts)
        found.p[infeasible[energy.nodes]] *= 0.5 if trial < MAX_SEARCHES // 2 else 0.0
        slope, search = energy.directional_derivative(x, delta, found.p, gradient), search.with_initial_step(alpha)
    return Descent(x, value, slope, length, found, 0.0, cuts)


def _limit(
    energy: MeshEnergy,
    x: np.ndarray,
    delta: float,
    step: np.ndarray,
    gradient: np.ndarray,
    reach: float,
    by_edges: bool = True,
) -> float:
    """Limit a step (k, 3), changed, to the range of numbers, the reach and the hexes around; returns its slope."""
    shorten_to_range(step, energy.unit)
    if np.isfinite(reach):
        if by_edges:
            ring = energy.mesh.topology.rings
            shorten(step, x, ring.start, ring.items, energy.nodes, reach)
        halve_harmful_steps(energy, x, delta, step)
    return energy.directional_derivative(x, delta, step, gradient)


#: Largest coordinate of a step, in the mesh's own unit of length: squares of larger ones overflow.
MAX_STEP = 1e100


def shorten_to_range(step: np.ndarray, unit: float) -> None:
    """Shorten a step (k, 3), changed, that would overflow; `unit` is its unit of length in units of the mesh."""
    size = float(np.abs(step).max(initial=0.0))
    if size > MAX_STEP / unit:
        step *= MAX_STEP / unit / size


#: Line searches before no step is taken. After each of the first half the steps of infeasible nodes are halved, later
#: they are set to 0.
MAX_SEARCHES = 6

#: Rounding errors by which the eta of a cube may differ from 0.
ROUNDING = 8

#: Bound of a hex's energy after a step: a factor of the energy before, and a summand.
GROWTH_FACTOR, GROWTH_SUMMAND = 2.0, 1.0
#: How often steps are halved around hexes above that bound.
HALVINGS = 8
#: Share of its step from which on an infeasible node stays: it has come to the end of its band.
STAY_BELOW = 0.25


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
    hexes, share = energy.mesh.hexes, np.ones(energy.mesh.n_nodes)
    limit = GROWTH_FACTOR * energies(x, hexes, delta, energy.left_out) + GROWTH_SUMMAND
    for _ in range(HALVINGS):
        there = energy.moved(x, share[energy.nodes, None] * step)
        worsened = ~(energies(there, hexes, delta, energy.left_out) <= limit)
        infeasible = energy.infeasible_nodes(x, there)
        halved = np.zeros(len(x), dtype=bool) if infeasible is None else infeasible.copy()
        share[halved & (share <= STAY_BELOW)] = 0.0
        halved[hexes[worsened]] = True
        if not halved.any():
            break
        share[halved] *= 0.5
    else:
        if infeasible is not None:
            share[infeasible] = 0.0  # in many steps they would leave their band all the same
    step *= share[energy.nodes, None]


def is_perfect(energy: MeshEnergy, value: float, delta: float) -> bool:
    """Return True if every hex is a cube but for rounding: gradient and Hessian are noise then."""
    eta, power = ROUNDING * np.finfo(float).eps, energy.power
    highest = power.of(eta) if delta == 0 else eta**power.p  # softened, a hex may have less energy than a cube
    return bool(value <= energy.mesh.n_hexes * highest)
