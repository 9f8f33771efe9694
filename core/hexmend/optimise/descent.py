"""One step of all free nodes down an energy: a direction, and as far along it as it descends."""

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
    """A step that was taken.

    Parameters
    ----------
    x : (n, 3) float64
        Where it led, in mean edge lengths.
    value, slope : float
        Energy before the step, and its slope along the direction.
    gradient_norm : float
        Before the step.
    found : SearchDirection
        The direction.
    alpha : float
        Step length; 0 where none descends, and x is where it was.
    cuts : int
        Of the line search.
    """

    x: np.ndarray
    value: float
    slope: float
    gradient_norm: float
    found: SearchDirection
    alpha: float
    cuts: int

    def diagnostics(self, delta: float) -> dict[str, float | int]:
        """What a `Step` tells of it."""
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
    """Take one step from x (n, 3); None where the energy or its gradient is infinite.

    A direction that does not descend is replaced by steepest descent.

    Parameters
    ----------
    reach : float
        How far a node may go, in mean lengths of its edges: the few that a direction throws far off do not cut the step
        of all others.
    """
    value = energy.value(x, delta)
    if not np.isfinite(value):
        return None
    gradient = energy.gradient(x, delta)
    length = norm(gradient)
    if not np.isfinite(length):
        return None
    if perfect(energy, value, delta):
        return Descent(x, value, 0.0, length, SearchDirection(np.zeros_like(gradient)), 0.0, 0)
    hessian = energy.hessian(x, delta)
    found = find(value, gradient, hessian)  # A.2, A.3, A.4
    if not np.isfinite(found.p).all():
        found = steepest_descent(value, gradient, hessian)
    shorten_to_range(found.p, energy.unit)
    if np.isfinite(reach):
        ring = energy.mesh.topology.rings
        shorten(found.p, x, ring.start, ring.items, energy.nodes, reach)
        restrain(energy, x, delta, found.p)
    slope = energy.directional_derivative(x, delta, found.p, gradient)
    if not slope < 0:
        found = steepest_descent(value, gradient, hessian)
        shorten_to_range(found.p, energy.unit)
        if np.isfinite(reach):
            restrain(energy, x, delta, found.p)
        slope = energy.directional_derivative(x, delta, found.p, gradient)
    for trial in range(TRIALS):
        alpha, cuts = search(lambda alpha: energy.value(energy.moved(x, found.p, alpha), delta), value, slope)  # A.5
        there = energy.moved(x, found.p, alpha)
        strayed = energy.infeasible_nodes(x, there)
        if strayed is None:
            return Descent(there, value, slope, length, found, alpha, cuts)
        found.p[strayed[energy.nodes]] *= 0.5 if trial < TRIALS // 2 else 0.0
        slope, search = energy.directional_derivative(x, delta, found.p, gradient), search.with_initial_step(alpha)
    return Descent(x, value, slope, length, found, 0.0, cuts)


#: The longest coordinate of a step, in the mesh's own unit of length: squares of what is further leave the range of
#: numbers.
LONGEST = 1e100


def shorten_to_range(step: np.ndarray, unit: float) -> None:
    """Shorten a step (k, 3), in lengths of so many units of the mesh, where it leads out of the range of numbers."""
    size = float(np.abs(step).max(initial=0.0))
    if size > LONGEST / unit:
        step *= LONGEST / unit / size


#: How often nodes that stray are held back before there is no step; half of these times their way is halved, then they
#: stay.
TRIALS = 6

#: By how many roundings the eta of a cube may differ from 0.
ROUNDING = 8

#: What a step may make of a hex's energy, as a factor and a summand, and how often it is halved around the others; of
#: what share of its step on a node stays where it is that would stray: it is at the end of its room.
WORSE, MORE, HALVINGS, STAYS = 2.0, 1.0, 8, 0.25


def restrain(energy: MeshEnergy, x: np.ndarray, delta: float, step: np.ndarray) -> None:
    """Halve the steps of nodes that stray or whose hexes would be spoilt, again and again: the rest need not wait.

    Parameters
    ----------
    energy : MeshEnergy
    x : (n, 3) float64
        Where the nodes are, in mean edge lengths.
    delta : float
    step : (k, 3) float64
        Of the free nodes; changed.
    """
    hexes, share = energy.mesh.hexes, np.ones(energy.mesh.n_nodes)
    limit = WORSE * energies(x, hexes, delta, energy.left_out) + MORE
    for _ in range(HALVINGS):
        there = energy.moved(x, share[energy.nodes, None] * step)
        spoilt = ~(energies(there, hexes, delta, energy.left_out) <= limit)
        strayed = energy.infeasible_nodes(x, there)
        halved = np.zeros(len(x), dtype=bool) if strayed is None else strayed.copy()
        share[halved & (share <= STAYS)] = 0.0
        halved[hexes[spoilt]] = True
        if not halved.any():
            break
        share[halved] *= 0.5
    else:
        if strayed is not None:
            share[strayed] = 0.0  # step by step they would go out of their room all the same
    step *= share[energy.nodes, None]


def perfect(energy: MeshEnergy, value: float, delta: float) -> bool:
    """Whether every hex is a cube but for rounding, so that gradient and Hessian are nothing but noise."""
    eta, power = ROUNDING * np.finfo(float).eps, energy.power
    highest = power.of(eta) if delta == 0 else eta**power.p  # softened, a hex may have less energy than a cube
    return bool(value <= energy.mesh.n_hexes * highest)
