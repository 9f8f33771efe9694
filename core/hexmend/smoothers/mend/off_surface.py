"""Fourth stage of mend: nodes leave the surface where sliding along it is not enough, and return to its band."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import dataclass
from itertools import islice

from hexmend.iteration import Step
from hexmend.optimise.maxmin.slp import ActiveCorners, MaxMinOptimiser
from hexmend.smoothers.mend.maxmin import MAXMIN, MaxMinConfig, maximise_minimum


@dataclass(frozen=True, eq=False)
class MaxMinResult:
    """Result of raising the least scaled Jacobian: the optimiser at its end, and the corners that limit it."""

    optimiser: MaxMinOptimiser
    active: ActiveCorners


def raise_within_tolerance(
    optimiser: MaxMinOptimiser, max_deviation: float, config: MaxMinConfig = MAXMIN
) -> Generator[Step, None, MaxMinResult]:
    """Raise the least of a mesh of which some nodes have left the surface already.

    Parameters
    ----------
    optimiser : MaxMinOptimiser
        Where this begins.
    max_deviation : float
        Distance from the surface that the boundary may have, in the mesh's unit of length; where it is further away,
        that distance.
    config : MaxMinConfig

    Yields
    ------
    Step

    Returns
    -------
    MaxMinResult
    """
    envelope = optimiser.envelope
    envelope.limit_to(max(max_deviation, envelope.largest_deviation(optimiser.points)))
    with envelope.relaxed(envelope.max_deviation):  # quads at released nodes may go round an edge of the surface
        active = yield from maximise_minimum(
            optimiser, release_below=config.acceptable, groups=config.max_groups, config=config
        )
    return MaxMinResult(optimiser, active)


def improve_off_surface(
    optimiser: MaxMinOptimiser,
    limits: Sequence[float],
    on_surface: MaxMinResult,
    wanted: float,
    config: MaxMinConfig = MAXMIN,
) -> Generator[Step, None, MaxMinResult]:
    """Raise the least with nodes of the boundary off the surface, then bring them back into its band.

    Where it is still too low, nodes leave the band for shorter ways from the result on.

    Parameters
    ----------
    optimiser : MaxMinOptimiser
        Where this begins.
    limits : sequence of float
        Distances from the surface that the boundary may have, ascending, in the mesh's unit of length: the result has
        the least of them at which it is better than `on_surface` and no hex is inverted or, if none is there,
        acceptable.
    on_surface : MaxMinResult
        The result without leaving the surface.
    wanted : float
        Least scaled Jacobian from which on there are no further ways.
    config : MaxMinConfig

    Yields
    ------
    Step
        Infeasible ones while nodes may be outside the band.

    Returns
    -------
    MaxMinResult
        The better one: this, if it is back in a band, or `on_surface`.
    """
    far = config.off_surface_limit * optimiser.mesh.mean_edge_length
    result = yield from _detour(optimiser, limits, far, on_surface, config)
    for _ in range(config.detours):
        least = result.optimiser.corners.movable_minimum
        if least >= wanted:
            break
        fork = result.optimiser.fork()
        limit = fork.envelope.max_deviation
        if result is on_surface:
            limit = limits[-1] if least > 0 else limits[0]
        detour = _detour(fork, [limit], config.detour_factor * limit, result, config, config.detour_iterations)
        result = yield from detour
        if result.optimiser.corners.movable_minimum - least < config.worth_widening * max(least, 0.1):
            break
    if result is on_surface:
        least = result.optimiser.corners.movable_minimum
        yield Step(result.optimiser.points, {"least": least}, intermediate=True)
    return result


def _detour(
    optimiser: MaxMinOptimiser,
    limits: Sequence[float],
    far: float,
    reached: MaxMinResult,
    config: MaxMinConfig,
    iterations: int | None = None,
) -> Generator[Step, None, MaxMinResult]:
    """Raise the least in a band as wide as `far`, and return to one of the limits; `reached` if that is no gain."""
    envelope, least_before = optimiser.envelope, reached.optimiser.corners.movable_minimum
    target, groups, within = config.off_surface_factor * config.acceptable, config.max_groups_off_surface, None
    envelope.limit_to(limits[-1])
    enough = 0.0 if least_before <= 0 else config.acceptable
    with envelope.relaxed(far):
        rising = maximise_minimum(optimiser, target, config.acceptable, groups, True, least_before, config)
        yield from islice(rising, iterations)
        for limit in reversed(limits):
            for step in islice(optimiser.return_to_band(limit), 0, None, config.programs_per_iteration):
                yield step.step(infeasible=True)
            least = optimiser.corners.movable_minimum
            if not _is_within(optimiser, limit) or least < least_before or (within and not least > enough):
                break
            within = limit, optimiser.points
    if within is None:
        return reached
    optimiser.move_to(within[1])
    return (yield from raise_within_tolerance(optimiser, within[0], config))


def _is_within(optimiser: MaxMinOptimiser, limit: float) -> bool:
    """Return True if the boundary is in a band and none of its quads is turned over, but at released nodes."""
    envelope, points = optimiser.envelope, optimiser.points
    sliding = envelope.sliding
    turned = sliding.boundary.faces[sliding.flipped_quads(sliding.points, points)]
    if not envelope.released[turned].any(axis=1).all():
        return False
    return envelope.largest_deviation(points) <= limit * (1 + optimiser.config.band_excess)
