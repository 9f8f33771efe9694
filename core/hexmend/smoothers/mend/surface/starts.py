"""Choice between two starts of one optimisation: one that promises more, and one that has reached more already.

The result is no lower than the second start: with the end of an optimisation as that, a boundary that slides ends no
lower than the same boundary fixed.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from typing import TypeAlias, TypeVar

import numpy as np

from hexmend.iteration import Step
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.maxmin.corner_set import MovableCorners
from hexmend.optimise.maxmin.slp import ActiveCorners, MaxMinOptimiser
from hexmend.smoothers.mend.surface.detours import MaxMinResult

T = TypeVar("T")

#: Iterations over which the gain of a start is judged.
_WINDOW = 3
#: Multiple of the last gain that the mean of those to come does not exceed: the first ones are the largest.
_SLOWING = 2.0
#: Function that raises the least of an optimiser as far as it goes.
Raise: TypeAlias = Callable[[MaxMinOptimiser], Generator[Step, None, ActiveCorners | None]]


def raise_from_better(
    promising: MaxMinOptimiser, reached: MaxMinOptimiser | None, raise_least: Raise, trial_iterations: int
) -> Generator[Step, None, MaxMinResult]:
    """Raise the least from a start; from another one where the first does not come as high as that.

    Parameters
    ----------
    promising, reached : MaxMinOptimiser
        The two starts; None where there is no second.
    raise_least : callable
    trial_iterations : int
        Iterations in which the first has to come as high as the second, at most; it ends sooner where its last gains
        are too small for that.

    Yields
    ------
    Step

    Returns
    -------
    MaxMinResult
        No lower than either start.
    """
    steps, least = raise_least(promising), -np.inf if reached is None else reached.corners.movable_minimum
    active = yield from _while_it_can_reach(least, steps, trial_iterations)
    if reached is not None and promising.corners.movable_minimum < least:
        return MaxMinResult(reached, (yield from raise_least(reached)))
    return MaxMinResult(promising, active)


def while_promising(
    steps: Generator[Step, None, T], mesh: Mesh, others: Sequence[np.ndarray], patience: int
) -> Generator[Step, None, T | None]:
    """Yield steps towards a start until their least has been lower than at other starts for some steps on end.

    Parameters
    ----------
    steps : generator of Step
    mesh : Mesh
        Corners that its free nodes can move count.
    others : sequence of (n, 3) float64
        Points of the other starts; with none, steps are yielded to their end.
    patience : int
        Number of these steps.

    Returns
    -------
    object or None
        What the generator returns; None if it was given up.
    """
    if not others:
        return (yield from steps)
    best = max(MovableCorners(mesh, points).active_minimum for points in others)
    lower = 0
    while lower < patience:
        try:
            step = next(steps)
        except StopIteration as end:
            return end.value
        yield step
        lower = lower + 1 if MovableCorners(mesh, step.points).active_minimum < best else 0
    return None


def _while_it_can_reach(
    least: float, steps: Generator[Step, None, ActiveCorners | None], iterations: int
) -> Generator[Step, None, ActiveCorners | None]:
    """Yield steps that raise the least to their end, or until it is clear that so many do not reach `least`."""
    history = list[float]()
    while True:
        try:
            step = next(steps)
        except StopIteration as end:
            return end.value
        yield step
        history.append(float(step.diagnostics["least"]))
        if max(history) >= least:
            return (yield from steps)
        left, last = iterations - len(history), history[-1] - history[-2] if len(history) > 1 else np.inf
        gain = history[-1] - history[-1 - _WINDOW] if len(history) > _WINDOW else np.inf
        gain = min(max(gain, 0.0) / _WINDOW, _SLOWING * max(last, 0.0))
        if left <= 0 or history[-1] + gain * left < least:
            return None
