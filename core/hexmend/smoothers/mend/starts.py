"""Choice between two starts of one optimisation: one that promises more, and one that has reached more already.

The result is no lower than the second start: with the end of an optimisation as that, a boundary that slides ends no
lower than the same boundary fixed.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from typing import TypeAlias

import numpy as np

from hexmend.iteration import Step
from hexmend.optimise.maxmin.slp import ActiveCorners, MaxMinOptimiser
from hexmend.smoothers.mend.off_surface import MaxMinResult

#: Iterations over which the gain of a start is judged.
_WINDOW = 3
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
        left = iterations - len(history)
        gain = history[-1] - history[-1 - _WINDOW] if len(history) > _WINDOW else np.inf
        if left <= 0 or history[-1] + max(gain, 0.0) / _WINDOW * left < least:
            return None
