"""Stage of mend that reaches its goal: floors rise from the best of some starts, then the shape improves above them."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from typing import NamedTuple

import numpy as np

from hexmend.energy import MeshEnergy
from hexmend.iteration import ActiveSet, Step
from hexmend.quality import measure
from hexmend.quality.regressions import WORSE_BY
from hexmend.smoothers.mend.floors import BARRIER_SAFE, FLOORS, Floors
from hexmend.smoothers.mend.free_boundary import FreeBoundary
from hexmend.smoothers.mend.mend_settings import MendSettings
from hexmend.smoothers.mend.messages import balance_message, limit_message
from hexmend.smoothers.mend.time_step import raise_time_step

#: Shares of the highest minimum scaled Jacobian tried as its floor, first around what rose and then everywhere, until
#: the mean of q(H) is no lower than as given.
KEPT_SHARES = ((0.96, False), (0.96, True), (0.85, True), (0.6, True), (0.0, True))
#: Share by which the least values may fall where a mesh has a target.
TARGET_FALL = 0.05
#: Least values count in steps of this share in the choice of the best iterate: the shape improves within one.
STEP_OF_LEAST = FLOORS.accuracy
#: Minimum scaled Jacobian from which on the goal balanced has nothing to gain.
SOUND = 1 - 2 * STEP_OF_LEAST


class Reached(NamedTuple):
    """Result of a goal: points (n, 3), a sentence about them, the corners that let the least rise no further, and the
    boundary that moved for it.
    """

    points: np.ndarray
    message: str = ""
    active: ActiveSet | None = None
    boundary: FreeBoundary | None = None


def counted_steps(least: float) -> int:
    """Number of whole steps of `STEP_OF_LEAST` of a minimum scaled Jacobian below 1; those of one below 0 are equal.

    >>> counted_steps(1.0), counted_steps(0.9951), counted_steps(0.5) == counted_steps(0.4995)
    (0, 0, True)
    """
    return int(np.floor(np.log(max(least, 1e-6)) / np.log1p(-STEP_OF_LEAST))) if least < 1 else 0


def reach_goal(
    settings: MendSettings,
    energy: MeshEnergy,
    starts: Sequence[np.ndarray],
    given: np.ndarray,
    mean: float = -np.inf,
    boundary: FreeBoundary | None = None,
) -> Generator[Step, None, Reached]:
    """Reach the goal of a run.

    Parameters
    ----------
    settings : MendSettings
    energy : MeshEnergy
        With p = 1; with the fit of a boundary that moves.
    starts : sequence of (n, 3) float64
        The optimum of shape last.
    given : (n, 3) float64
        Points whose least figures the goal balanced is not to lower.
    mean : float
        Mean of q(H) below which it is not to fall.
    boundary : FreeBoundary, optional
        Of the energy: its corners and curves move too where a higher least needs it.

    Yields
    ------
    Step

    Returns
    -------
    Reached
    """
    if settings.balances:
        return (yield from _balance(energy, starts, given, mean, boundary))
    floors = Floors(energy, starts[-1])
    if settings.maximises_jacobian or not floors.values.jacobian >= BARRIER_SAFE:
        floors.values = max(map(floors.values_at, starts), key=lambda values: values.jacobian)
        yield from floors.rise(enough=np.inf if settings.maximises_jacobian else BARRIER_SAFE)
    top = floors.values
    floors, boundary = _exact(floors, boundary)
    if settings.maximises_jacobian:
        yield from _relax(floors, top.jacobian, floors.values_at(given).jacobian)
        active = floors.active_set()
        message = limit_message(floors.energy.mesh, active, floors.values.jacobian, "scaled Jacobian")
        return Reached(floors.points, message, active, boundary)
    if settings.goal == "time-step":
        points, least, active = yield from raise_time_step(floors.energy, floors.points)
        return Reached(points, limit_message(energy.mesh, active, least, "time step"), active, boundary)
    return Reached(floors.points, boundary=boundary)


def _exact(
    floors: Floors, boundary: FreeBoundary | None, jacobian: float = -np.inf, quality: float = -np.inf
) -> tuple[Floors, FreeBoundary | None]:
    """Return to their corners, straight curves and flat patches the nodes that floors do not need elsewhere.

    No least value falls below floors where it is above them, nor by more than half a `STEP_OF_LEAST`.
    """
    if boundary is None:
        return floors, None
    lowest = [value - STEP_OF_LEAST / 2 * abs(value) for value in (floors.values.jacobian, floors.values.quality)]
    boundary, points = boundary.returned(floors.points, max(lowest[0], jacobian), max(lowest[1], quality))
    energy = boundary.fitted.with_objective(floors.energy.norm, floors.energy.omitted)
    return floors.continued(energy, points), boundary


def step_floor(least: float) -> float:
    """Lowest minimum scaled Jacobian that counts as much as one above 0."""
    return (1 - STEP_OF_LEAST) ** (counted_steps(least) + 1) * (1 + 1e-9)


def _relax(floors: Floors, top: float, given: float) -> Generator[Step, None, None]:
    """Improve the shape without a minimum scaled Jacobian lower than the top, as far as it counts, or than as given."""
    values = floors.values
    if values.jacobian > 0:
        floor = max(step_floor(top), _below(given))
        yield from floors.relax(min(floor, values.jacobian - 1e-9), _below(values.quality), everywhere=True)


def _balance(
    energy: MeshEnergy, starts: Sequence[np.ndarray], given: np.ndarray, mean: float, boundary: FreeBoundary | None
) -> Generator[Step, None, Reached]:
    """Raise the minimum scaled Jacobian above a floor of q(H), then improve the shape above floors just below both."""
    floors = Floors(energy, starts[-1])
    shape, first = floors.values, floors.values_at(given)
    if not shape.jacobian < SOUND:
        return Reached(starts[-1], boundary=boundary)
    share = 1.0 if energy.target is None else 1 - TARGET_FALL
    sound = first.jacobian > 0
    jacobian, quality = (share * first.jacobian, share * first.quality) if sound else (-np.inf, -np.inf)
    enough = np.inf
    if energy.target is not None:  # the lengths that are wanted come first: raising corners would change them
        if shape.jacobian >= jacobian and shape.quality >= quality:
            return Reached(starts[-1], boundary=boundary)
        enough = max(shape.jacobian, jacobian)
    others = (first if start is given else floors.values_at(start) for start in starts[:-1])
    floors.values = max(shape, *others, key=lambda values: values.jacobian)
    yield from floors.rise(max(quality, shape.quality), enough)
    again = sound and not (floors.values.jacobian >= jacobian and floors.values.quality >= quality)
    if again:
        floors.move_to(first.x)
        yield from floors.rise(quality, enough)
    floors, boundary = _exact(floors, boundary, jacobian, quality)
    top = floors.values
    for kept, everywhere in KEPT_SHARES if energy.target is None else KEPT_SHARES[-1:]:
        floors.move_to(top.x)
        yield from floors.relax(
            min(max(kept * top.jacobian, _below(jacobian)), _below(top.jacobian)),
            _below(min(max(quality, shape.quality), top.quality)),
            everywhere=everywhere or again,
        )
        if not energy.mean(measure(floors.points, energy.mesh.elements).q) < mean:
            break
    return Reached(floors.points, balance_message(energy, floors, top, starts[-1]), boundary=boundary)


def _below(value: float) -> float:
    """Return a floor below a value, but not so far that it would count as lower."""
    return value - WORSE_BY / 2
