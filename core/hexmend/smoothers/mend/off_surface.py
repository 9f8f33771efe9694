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
    optimiser: MaxMinOptimiser, limits: Sequence[float], on_surface: MaxMinResult, config: MaxMinConfig = MAXMIN
) -> Generator[Step, None, MaxMinResult]:
    """Raise the least with nodes of the boundary off the surface, then bring them back into its band.

    Parameters
    ----------
    optimiser : MaxMinOptimiser
        Where this begins.
    limits : sequence of float
        Distances from the surface that the boundary may have, ascending, in the mesh's unit of length: the result has
        the least of them at which it is better than `on_surface` and no hex is inverted.
    on_surface : MaxMinResult
        The result without leaving the surface.
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
    envelope = optimiser.envelope
    target, groups = config.off_surface_factor * config.acceptable, config.max_groups_off_surface
    least_on_surface = on_surface.optimiser.corners.movable_minimum
    reached = None
    envelope.limit_to(limits[-1])
    with envelope.relaxed(config.off_surface_limit * optimiser.mesh.mean_edge_length):
        yield from maximise_minimum(optimiser, target, config.acceptable, groups, infeasible=True, config=config)
        for limit in reversed(limits):
            for step in islice(optimiser.return_to_band(limit), 0, None, config.programs_per_iteration):
                yield step.step(infeasible=True)
            least = optimiser.corners.movable_minimum
            if not _is_within(optimiser, limit) or least < least_on_surface or (reached and not least > 0):
                break
            reached = limit, optimiser.points
    if reached is None:
        yield Step(on_surface.optimiser.points, {"least": least_on_surface}, intermediate=True)
        return on_surface
    envelope.limit_to(reached[0])
    optimiser.move_to(reached[1])
    active = yield from maximise_minimum(
        optimiser, release_below=config.acceptable, groups=config.max_groups, config=config
    )
    return MaxMinResult(optimiser, active)


def _is_within(optimiser: MaxMinOptimiser, limit: float) -> bool:
    """Return True if the boundary is in a band and none of its quads is turned over."""
    envelope, points = optimiser.envelope, optimiser.points
    if envelope.sliding.flipped_quads(envelope.sliding.points, points).size:
        return False
    return envelope.largest_deviation(points) <= limit * (1 + optimiser.config.band_excess)
