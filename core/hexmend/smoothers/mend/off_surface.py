"""Fourth stage of mend: nodes leave the surface where sliding along it is not enough, and return to its band."""

from __future__ import annotations

from collections.abc import Generator
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
    optimiser: MaxMinOptimiser, max_deviation: float, on_surface: MaxMinResult, config: MaxMinConfig = MAXMIN
) -> Generator[Step, None, MaxMinResult]:
    """Raise the least with nodes of the boundary off the surface, then bring them back into its band.

    Parameters
    ----------
    optimiser : MaxMinOptimiser
        Where this begins.
    max_deviation : float
        Distance from the surface that the boundary may have, in the mesh's unit of length.
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
        The better one: this, if it is back in the band, or `on_surface`.
    """
    envelope, corners = optimiser.envelope, optimiser.corners
    target, groups = config.off_surface_factor * config.acceptable, config.max_groups_off_surface
    envelope.limit_to(max_deviation)
    with envelope.relaxed(config.off_surface_limit * optimiser.mesh.mean_edge_length):
        yield from maximise_minimum(optimiser, target, config.acceptable, groups, infeasible=True, config=config)
        for step in islice(optimiser.return_to_band(max_deviation), 0, None, config.programs_per_iteration):
            yield step.step(infeasible=True)
    flipped = envelope.sliding.flipped_quads(envelope.sliding.points, optimiser.points).size > 0
    outside = envelope.largest_deviation(optimiser.points) > max_deviation * (1 + optimiser.config.band_excess)
    least_on_surface = on_surface.optimiser.corners.movable_minimum
    if flipped or outside or corners.movable_minimum < least_on_surface:
        yield Step(on_surface.optimiser.points, {"least": least_on_surface}, intermediate=True)
        return on_surface
    active = yield from maximise_minimum(
        optimiser, release_below=config.acceptable, groups=config.max_groups, config=config
    )
    return MaxMinResult(optimiser, active)
