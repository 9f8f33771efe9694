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
from hexmend.optimise.maxmin.slp import MaxMinOptimiser
from hexmend.optimise.maxmin.slp_step import ActiveCorners
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
    least = -np.inf if reached is None else reached.corners.movable_minimum
    active, _ = yield from _until(_Prospect(least, trial_iterations).is_poor, raise_least(promising))
    if reached is not None and promising.corners.movable_minimum < least:
        return MaxMinResult(reached, (yield from raise_least(reached)))
    return MaxMinResult(promising, active)


def improve_within_reach(
    optimiser: MaxMinOptimiser, steps: Generator[Step, None, np.ndarray], least: float, iterations: int
) -> Generator[Step, None, bool]:
    """Yield steps to points (n, 3) with a higher least, or until it is clear that the least does not reach a value.

    Parameters
    ----------
    optimiser : MaxMinOptimiser
        Goes on from the last points, if their least is higher.
    steps : generator of Step
    least : float
        The value.
    iterations : int
        Number of steps in which it is to be reached.

    Returns
    -------
    bool
        The steps came to their end.
    """
    points, last = yield from _until(_Prospect(least, iterations).is_poor, steps)
    optimiser.improve_to(points if last is None else last.points)
    return last is None


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

    def is_lower(step: Step) -> bool:
        nonlocal lower
        lower = lower + 1 if MovableCorners(mesh, step.points).active_minimum < best else 0
        return lower == patience

    result, _ = yield from _until(is_lower, steps)
    return result


def _until(
    ends: Callable[[Step], bool], steps: Generator[Step, None, T]
) -> Generator[Step, None, tuple[T | None, Step | None]]:
    """Yield steps to their end, or until after one of them they are to end; returns their result, or this step."""
    while True:
        try:
            step = next(steps)
        except StopIteration as end:
            return end.value, None
        yield step
        if ends(step):
            return None, step


class _Prospect:
    """Prospect that steps, so many at most, raise the least to a value."""

    def __init__(self, least: float, iterations: int):
        self._least, self._iterations, self._history = least, iterations, list[float]()

    def is_poor(self, step: Step) -> bool:
        """Return True if it is clear after one more step that the value is not reached."""
        history, least = self._history, self._least
        history.append(float(step.diagnostics["least"]))
        if max(history) >= least:
            return False
        left, last = self._iterations - len(history), history[-1] - history[-2] if len(history) > 1 else np.inf
        gain = history[-1] - history[-1 - _WINDOW] if len(history) > _WINDOW else np.inf
        gain = min(max(gain, 0.0) / _WINDOW, _SLOWING * max(last, 0.0))
        return left <= 0 or history[-1] + gain * left < least
