"""How mend raises the least scaled Jacobian: one group of corners after another, and off the surface where it must."""

from __future__ import annotations

from collections.abc import Generator
from itertools import islice

import numpy as np

from hexmend.iteration import ActiveSet, Step
from hexmend.optimise.maxmin.slp import ActiveCorners, MaxMinOptimiser

#: Least scaled Jacobian from which on a hex is sound enough for the energy's barrier, and below which one is so bad
#: that nodes of the boundary leave the surface for it.
SOUND, AIM = 0.02, 0.2
#: What share of its room the boundary may use where that is enough; how far it may go at first where it is not, in
#: mean edge lengths, until the least is so many times `AIM`.
SPARED, WIDE, ENOUGH, NEAR_ENOUGH = 1 / 3, 1.5, 1.2, 1e-5
#: How many linear programs an iteration has.
TOGETHER = 3
#: How many groups of corners that hold each other below `AIM` are left behind; and while nodes leave the surface.
CLUSTERS, MANY_CLUSTERS = 10, 30


def raise_least(
    raising: MaxMinOptimiser,
    aim: float = np.inf,
    lifts: float = -np.inf,
    clusters: int = 1,
    infeasible: bool = False,
) -> Generator[Step, None, ActiveCorners]:
    """Raise the least scaled Jacobian.

    Where corners hold each other below `aim`, those that are above them are raised further. Below `lifts`, nodes of the
    boundary leave the surface for that.

    Parameters
    ----------
    raising : MaxMinOptimiser
    aim, lifts : float
    clusters : int
        How many groups of corners that hold each other are left behind, at most.
    infeasible : bool
        See `Step.infeasible`.

    Returns
    -------
    ActiveCorners
        What held the least at first.
    """
    first = None
    yield Step(raising.points, {"least": raising.corners.least}, intermediate=True, infeasible=infeasible)
    while True:
        for number, step in enumerate(raising.steps(aim)):
            limit = step if isinstance(step, ActiveCorners) else None
            if limit is None and number % TOGETHER == 0:
                yield step.step(infeasible)
        if not limit.hexes.size or limit.least >= aim:
            break
        if limit.least < lifts and raising.release(limit):
            continue
        first = first or limit
        clusters -= 1
        if limit.least >= AIM or not clusters:
            break
        raising.freeze(limit)
    return first or limit


def lifted(
    raising: MaxMinOptimiser, room: float, other: MaxMinOptimiser, limit: ActiveCorners
) -> Generator[Step, None, tuple[MaxMinOptimiser, ActiveCorners]]:
    """Where sliding is not enough: let nodes leave the surface as they must, then bring them into the room.

    Returns what is better, that or the other, with its limit.
    """
    envelope, corners = raising.envelope, raising.corners
    envelope.room, envelope.flips_allowed = max(WIDE * raising.mesh.mean_edge_length, room), True
    yield from raise_least(raising, ENOUGH * AIM, AIM, MANY_CLUSTERS, infeasible=True)
    for step in islice(raising.return_to_band(room), 0, None, TOGETHER):
        yield step.step(infeasible=True)
    envelope.flips_allowed = False
    turned = envelope.sliding.turned(envelope.sliding.points, raising.points).size > 0
    far = envelope.largest_deviation(raising.points) > room * (1 + NEAR_ENOUGH)
    if turned or far or corners.least_of_all < other.corners.least_of_all:
        yield Step(other.points, {"least": other.corners.least_of_all}, intermediate=True)
        return other, limit
    return raising, (yield from raise_least(raising, lifts=AIM, clusters=CLUSTERS))


def limits_of(raising: MaxMinOptimiser, limit: ActiveCorners) -> ActiveSet:
    """Which corners let the least rise no further, and which are locked below them."""
    nodes = raising.mesh.hexes[limit.hexes, limit.corners].astype(np.int64)
    locked = _locked(raising, limit) // 8
    return ActiveSet(limit.hexes, nodes, np.array(list(dict.fromkeys(locked.tolist())), dtype=np.int64))


def what_limits(raising: MaxMinOptimiser, limit: ActiveCorners) -> str:
    """What lets the least rise no further, and what is locked below that, in sentences; "" where nothing does.

    Corners of places apart are at the limit together, but hold each other within their own place alone.
    """
    count = len(limit.hexes)
    if not count:
        return ""
    places = raising.corners.groups(8 * limit.hexes + limit.corners).max() + 1
    if count == 1:
        who = "it can go no further, in hex"
    elif places == 1:
        who = f"{count} of them hold each other there, in the hexes"
    else:
        who = f"{count} of them can go no further there, in {places} places apart, in the hexes"
    found = f"The least scaled Jacobian of the corners that can be moved is {limit.least:.4f}"
    said = f"{found}: {who} {_named(limit.hexes)}."
    locked = _locked(raising, limit)
    if not locked.size:
        return said
    which = "One corner is locked below that" if locked.size == 1 else f"{locked.size:,} corners are locked below that"
    lowest = raising.corners.values.ravel()[locked[0]]
    return f"{said} {which}: {lowest:.4f} at the lowest, in hex {_named(locked[:1] // 8)}."


def _locked(raising: MaxMinOptimiser, limit: ActiveCorners) -> np.ndarray:
    return raising.corners.locked_below(limit.least if limit.hexes.size else -np.inf)


def _named(hexes: np.ndarray) -> str:
    """The first few of some hexes, each once."""
    return ", ".join(f"{number:,}" for number in dict.fromkeys(hexes[:8].tolist()))
