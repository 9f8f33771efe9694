"""Third stage of mend: the least value of a measure is raised, one group of corners after another.

`MaxMinOptimiser` ends where some corners let the least rise no further. They are frozen, and the corners above them are
raised in turn.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np

from hexmend.iteration import ActiveSet, Step
from hexmend.optimise.maxmin.slp import MaxMinOptimiser
from hexmend.optimise.maxmin.slp_config import SLP
from hexmend.optimise.maxmin.slp_step import ActiveCorners


@dataclass(frozen=True)
class MaxMinConfig:
    """Settings of the stage and of the return to the surface; scaled Jacobians are in [-1, 1].

    Parameters
    ----------
    barrier_safe : float
        Minimum scaled Jacobian above which the energy's barrier can be used.
    acceptable : float
        Minimum scaled Jacobian below which nodes leave their curves and the surface, and groups are frozen.
    programs_per_iteration : int
        Number of linear programs per iteration of the run.
    fruitless_groups : int
        Groups on end that may bring nothing before no further one is frozen; after half of them nodes around those that
        leave the surface leave it, too.
    max_groups, max_groups_off_surface : int
        Groups of corners that are raised one after another, at most; the second while nodes leave the surface.
    surface_share : float
        Share of the surface tolerance that the boundary uses at most while nodes slide; see `first_share`.
    first_share : float
        Share of a small tolerance that the boundary may use, up to the first of `bands`: it begins as a larger one.
    bands : tuple of float
        Narrower bands, in mean edge lengths, in which the least is raised first; a wider one follows where it raises
        the least by `worth_widening`. They are the same for all tolerances; the last band is `surface_share` of the
        tolerance.
    distinct : float
        Share of the width of a band up to which a narrower one is tried before it.
    worth_widening : float
        Gain of the least, as a share of it or of 0.1, from which on quads of a boundary that slides may be further from
        its surface.
    worth_detour : float
        The same of a detour, from which on the next one is no wider.
    worth_leaving : float
        The same where nodes that have left the surface may be further from it, though the least is acceptable.
    off_surface_tolerances : tuple of float
        Distances, in mean edge lengths, to which nodes that left the surface return while the least stays acceptable.
    off_surface_limit : float
        Initial limit on the distance of released nodes from the surface, in mean edge lengths.
    off_surface_factor : float
        Multiple of `acceptable` at which the phase off the surface ends; the return to the band loses part of it.
    returned_share : float
        A boundary back in its band is raised further there if its least has fallen by no more than one minus this
        share of the least so far.
    detours : int
        More times that nodes leave the band, at most, while the least is below `acceptable`.
    detour_factors : tuple of float
        Width of the band in such a detour, as a multiple: the next one where a detour has brought nothing.
    at_band : float
        Share of the width from which on the band has limited a detour.
    target_growth : float
        Factor of the least at which a detour ends, with the next width.
    detour_programs, programs_between : int
        Linear programs outside the band, at most, and within it before the next detour.
    regained : float
        By how much the least may be lower after the shape was improved above it; half of what counts in the choice of
        the best iterate.
    share_in_reach : float
        Share of the best result that the central path has to reach, so that linear programs can exceed that.
    trial_iterations : int
        Iterations in which the more promising of two starts has to come as high as the other, at most.
    shape_patience : int
        Iterations in which the least may be lower than at another start before the optimum of shape is given up.
    untangling_iterations : int
        Iterations by which programs untangle a mesh whose boundary slides, before the barrier does.
    """

    barrier_safe: float = 0.02
    acceptable: float = SLP.acceptable
    programs_per_iteration: int = 3
    fruitless_groups: int = 6
    max_groups: int = 10
    max_groups_off_surface: int = 30
    surface_share: float = 1 / 3
    first_share: float = 0.45
    bands: tuple[float, ...] = (0.045, 0.1, 1 / 3)
    distinct: float = 0.95
    worth_widening: float = 0.01
    worth_detour: float = 0.05
    worth_leaving: float = 0.25
    off_surface_tolerances: tuple[float, ...] = (1 / 30, 0.1, 0.3)
    off_surface_limit: float = 1.5
    off_surface_factor: float = 1.2
    returned_share: float = 0.5
    detours: int = 8
    detour_factors: tuple[float, ...] = (2.0, 3.0, 4.0)
    at_band: float = 0.95
    target_growth: float = 1.3
    detour_programs: int = 90
    programs_between: int = 60
    regained: float = 5e-6
    share_in_reach: float = 0.9
    trial_iterations: int = 10
    shape_patience: int = 5
    untangling_iterations: int = 10


MAXMIN = MaxMinConfig()
#: No corner limits the least.
NO_CORNERS = ActiveCorners(np.inf, np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64))


def maximise_minimum(
    optimiser: MaxMinOptimiser,
    target: float = np.inf,
    release_below: float = -np.inf,
    groups: int = 1,
    infeasible: bool = False,
    give_up_below: float = -np.inf,
    max_programs: float = np.inf,
    config: MaxMinConfig = MAXMIN,
    patient_below: float = -np.inf,
) -> Generator[Step, None, ActiveCorners | None]:
    """Raise the least value of the corners that can be moved; groups after the first take as many programs, at most.

    Parameters
    ----------
    optimiser : MaxMinOptimiser
    target : float
        Ends where the least has reached it; groups below it are frozen, and the corners above them raised further.
    release_below : float
        Where a group is stuck below it, nodes leave their curves or the surface, if any can, before it is frozen.
    groups, max_programs : int, float
        Groups that are raised, and linear programs, at most.
    infeasible : bool
        Of the steps: see `Step`.
    give_up_below, patient_below : float
        Ends where a group is stuck below the first; below the second a program that promises little does not end it.
    config : MaxMinConfig

    Yields
    ------
    Step
        The initial points, then the first accepted step and every `config.programs_per_iteration`-th after it.

    Returns
    -------
    ActiveCorners or None
        The first group that was stuck: it limits the least of all. None if none was after `max_programs`.
    """
    yield Step(optimiser.points, {"least": optimiser.least}, intermediate=True, infeasible=infeasible)
    begin, reached, fruitless, first = optimiser.programs, -np.inf, 0, None
    end = begin + max_programs
    while True:
        active = yield from _raise_group(optimiser, target, infeasible, end, config, patient_below)
        if active is None or not active.hexes.size or active.least >= target:
            break
        releasable = active.least < release_below
        if optimiser.programs > end:
            return first or (None if releasable else active)
        fruitless, reached = fruitless + 1 if active.least < reached + SLP.min_gain else 0, active.least
        if releasable and optimiser.release(active, fruitless >= config.fruitless_groups // 2):
            continue
        if active.least < give_up_below:
            break
        if first is None:
            first, end = active, min(end, 2 * optimiser.programs - begin)
        groups -= 1
        if active.least >= config.acceptable or not groups or fruitless > config.fruitless_groups:
            break
        optimiser.freeze(active)
    return first or active


def _raise_group(
    optimiser: MaxMinOptimiser,
    target: float,
    infeasible: bool,
    last_program: float,
    config: MaxMinConfig,
    patient_below: float,
) -> Generator[Step, None, ActiveCorners | None]:
    """Raise the least until a group is stuck, which is returned; None where so many programs were not enough."""
    for number, step in enumerate(optimiser.steps(target, patient_below)):
        if isinstance(step, ActiveCorners):
            return step
        if number % config.programs_per_iteration == 0:
            yield step.step(infeasible)
        if optimiser.programs > last_program:
            return None
    return None


def active_set(optimiser: MaxMinOptimiser, active: ActiveCorners) -> ActiveSet:
    """Corners that let the least rise no further, and hexes with corners that are locked below them."""
    nodes = optimiser.mesh.hexes[active.hexes, active.corners].astype(np.int64)
    locked = locked_below(optimiser, active) // 8
    return ActiveSet(active.hexes, nodes, np.array(list(dict.fromkeys(locked.tolist())), dtype=np.int64))


def locked_below(optimiser: MaxMinOptimiser, active: ActiveCorners) -> np.ndarray:
    """Corners, 8 * hex + corner, that fixed nodes lock below the least, the lowest first; none without active ones."""
    return optimiser.corners.locked_below(active.least if active.hexes.size else -np.inf)
