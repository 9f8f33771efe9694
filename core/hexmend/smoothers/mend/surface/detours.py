"""Fourth stage of mend: nodes leave the surface where sliding along it is not enough, and return to its band."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np

from hexmend.iteration import Step
from hexmend.optimise.maxmin.slp import MaxMinOptimiser
from hexmend.optimise.maxmin.slp_step import ActiveCorners
from hexmend.quality import measure
from hexmend.smoothers.mend.maxmin import MAXMIN, MaxMinConfig, maximise_minimum
from hexmend.smoothers.mend.surface.release import infeasible

_POSITIVE = float(np.finfo(float).tiny)


@dataclass(frozen=True, eq=False)
class MaxMinResult:
    """Result of raising the minimum scaled Jacobian: the optimiser, and the corners that limit it.

    None are named where it was not raised as far as it goes.
    """

    optimiser: MaxMinOptimiser
    active: ActiveCorners | None

    @property
    def least(self) -> float:
        """The least value of the corners that can be moved."""
        return self.optimiser.corners.movable_minimum

    def step(self) -> Step:
        """Step of a smoother to these points."""
        return Step(self.optimiser.points, {"least": self.least}, intermediate=True)

    def is_better_than(self, other: MaxMinResult) -> bool:
        """Return True if fewer hexes are inverted, or the minimum scaled Jacobian of all is higher.

        Where corners that cannot be moved hold that, those that can decide.
        """
        return self._order > other._order

    @property
    def _order(self) -> tuple[int, float, float]:
        quality = measure(self.optimiser.points, self.optimiser.mesh.hexes)
        return -quality.n_inverted, float(quality.scaled_jacobian.min()), self.least

    def gains(self, least: float, share: float = MAXMIN.worth_widening) -> bool:
        """Return True if the least is higher than another by a share of that or of 0.1."""
        return self.least - least >= share * max(least, 0.1)


def raise_within_tolerance(
    optimiser: MaxMinOptimiser,
    max_deviation: float,
    max_programs: float = np.inf,
    config: MaxMinConfig = MAXMIN,
) -> Generator[Step, None, MaxMinResult]:
    """Raise the least of a mesh of which some nodes have left the surface already.

    Parameters
    ----------
    optimiser : MaxMinOptimiser
        Where this begins.
    max_deviation : float
        Distance from the surface that the boundary may have, in the mesh's unit of length; where it is further away,
        that distance.
    max_programs : float
        Linear programs, at most.
    config : MaxMinConfig

    Yields
    ------
    Step

    Returns
    -------
    MaxMinResult
    """
    envelope = optimiser.envelope
    envelope.limit_to(max(max_deviation, envelope.largest_deviation(optimiser.points, max_deviation)))
    with envelope.relaxed(envelope.max_deviation):  # quads at released nodes may go round an edge of the surface
        active = yield from maximise_minimum(
            optimiser,
            release_below=config.acceptable,
            groups=config.max_groups,
            max_programs=max_programs,
            config=config,
        )
    return MaxMinResult(optimiser, active)


def improve_off_surface(
    starts: Sequence[MaxMinOptimiser],
    limits: Sequence[float],
    reached: MaxMinResult,
    wanted: float,
    config: MaxMinConfig = MAXMIN,
    lowest: float = -np.inf,
) -> Generator[Step, None, MaxMinResult]:
    """Raise the least with nodes of the boundary off the surface, then bring them back into its band.

    Where it is still too low, nodes leave the band again from the result on, on detours of limited width and length.

    Parameters
    ----------
    starts : sequence of MaxMinOptimiser
        Where this begins: from the next one where a hex is inverted after the first detour from one.
    limits : sequence of float
        Distances from the surface that the boundary may have, ascending, in the mesh's unit of length: the result has
        the least of them at which it is better than `reached` and no hex is inverted or, if none is there, acceptable.
    reached : MaxMinResult
        The result so far.
    wanted, lowest : float
        Minimum scaled Jacobian from which on, and up to which, no detours follow the first one from each start.
    config : MaxMinConfig

    Yields
    ------
    Step
        Infeasible ones while nodes may be outside the band.

    Returns
    -------
    MaxMinResult
        The better one: this, if it is back in a band, or `reached`.
    """
    far, factors = config.off_surface_limit * starts[0].mesh.mean_edge_length, iter(config.detour_factors)
    target, factor, result = config.off_surface_factor * config.acceptable, next(factors), reached
    for optimiser in starts:
        result, _ = yield from _detour(optimiser, limits, far, target, result, config)
        if result.least > 0:
            break
    if result.least <= lowest:
        return result
    for _ in range(config.detours):
        least = result.least
        if least >= wanted:
            break
        fork = result.optimiser.fork()
        limit = fork.envelope.max_deviation
        if result is reached:
            limit = limits[-1] if least > 0 else limits[0]
        detour = _detour(fork, [limit], factor * limit, target, result, config, config.detour_programs)
        result, was_limited = yield from detour
        if not result.gains(least, config.worth_detour):
            factor, target = next(factors, None), config.target_growth * target
            if factor is None or not was_limited:
                break
    if result is reached:
        yield result.step()
    return (yield from raise_to_the_end(result, config))


def raise_to_the_end(result: MaxMinResult, config: MaxMinConfig = MAXMIN) -> Generator[Step, None, MaxMinResult]:
    """Raise the least as far as it goes within the band that the optimiser has, if that was not done."""
    if result.active is not None:
        return result
    optimiser = result.optimiser
    return (yield from raise_within_tolerance(optimiser, optimiser.envelope.max_deviation, config=config))


def raise_nearer(
    result: MaxMinResult, limits: Sequence[float], config: MaxMinConfig = MAXMIN
) -> Generator[Step, None, MaxMinResult]:
    """Bring the boundary back as near to the surface as no hex is inverted there, and raise the least there.

    Parameters
    ----------
    result : MaxMinResult
        Nodes have left the surface, and no hex is inverted.
    limits : sequence of float
        Smaller distances from the surface that the boundary may have, ascending, in the mesh's unit of length.

    Returns
    -------
    MaxMinResult
        `result` where the boundary does not come back, or the least falls to less than a share of what it was.
    """
    optimiser = result.optimiser.fork()
    with optimiser.envelope.relaxed(optimiser.envelope.max_deviation):
        band = yield from _return_to_bands(optimiser, limits, _POSITIVE, _POSITIVE, config)
    if band is None:
        return result
    nearer = yield from infeasible(raise_within_tolerance(optimiser, band, config.programs_between, config))
    return nearer if nearer.least >= config.returned_share * result.least else result


def _detour(
    optimiser: MaxMinOptimiser,
    limits: Sequence[float],
    far: float,
    target: float,
    reached: MaxMinResult,
    config: MaxMinConfig,
    max_programs: float = np.inf,
) -> Generator[Step, None, tuple[MaxMinResult, bool]]:
    """Raise the least to a target in a band as wide as `far`, and return to a limit; `reached` if that is no gain.

    Returns that, and whether the target or the band has ended the rise: if not, a wider detour goes the same way.
    """
    envelope, least_before = optimiser.envelope, reached.least
    envelope.limit_to(limits[-1])
    enough, share = 0.0 if least_before <= 0 else config.acceptable, config.returned_share
    with envelope.relaxed(far):
        yield from maximise_minimum(
            optimiser,
            target,
            release_below=config.acceptable,
            groups=config.max_groups_off_surface,
            infeasible=True,
            give_up_below=least_before,
            max_programs=max_programs,
            config=config,
        )
        widest = envelope.largest_deviation(optimiser.points)
        was_limited = optimiser.corners.active_minimum >= target or widest >= config.at_band * far
        first_lowest = least_before - (1 - share) * abs(least_before)
        band = yield from _return_to_bands(optimiser, limits, first_lowest, max(least_before, enough), config)
    if band is None:
        return reached, was_limited
    rising = raise_within_tolerance(optimiser, band, config.programs_between, config)
    if not optimiser.corners.movable_minimum < least_before:
        return (yield from rising), was_limited
    result = yield from infeasible(rising, every=1)  # lower at first than what is reached
    if not result.least > least_before:
        return reached, was_limited
    yield result.step()
    return result, was_limited


def _return_to_bands(
    optimiser: MaxMinOptimiser, limits: Sequence[float], first_lowest: float, lowest: float, config: MaxMinConfig
) -> Generator[Step, None, float | None]:
    """Bring the boundary back to limits (ascending), the widest first, as long as the least stays.

    The optimiser ends in the narrowest band that was reached, which is returned; None if none was. In the widest band
    the least has to be at least `first_lowest`, in narrower ones at least `lowest`.
    """
    reached = None
    for limit in reversed(limits):
        for step in islice(optimiser.return_to_band(limit), 0, None, config.programs_per_iteration):
            yield step.step(infeasible=True)
        least = optimiser.corners.movable_minimum
        if not _is_within(optimiser, limit) or least < (lowest if reached else first_lowest):
            break
        reached = limit, optimiser.points
    if reached is None:
        return None
    optimiser.move_to(reached[1])
    return reached[0]


def _is_within(optimiser: MaxMinOptimiser, limit: float) -> bool:
    """Return True if the boundary is in a band and none of its quads is turned over, but at released nodes."""
    envelope, points = optimiser.envelope, optimiser.points
    sliding = envelope.sliding
    turned = sliding.boundary.faces[sliding.flipped_quads(sliding.points, points)]
    if not envelope.released[turned].any(axis=1).all():
        return False
    allowed = limit * (1 + optimiser.config.band_excess)
    return envelope.largest_deviation(points, allowed) <= allowed
