"""Choice between two starts of one optimisation: one that promises more, and one that has reached more already.

The result is no lower than the second start: with the end of an optimisation as that, a boundary that slides ends no
lower than the same boundary fixed.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from typing import TypeAlias

from hexmend.iteration import Step
from hexmend.optimise.maxmin.slp import ActiveCorners, MaxMinOptimiser
from hexmend.smoothers.mend.off_surface import MaxMinResult

#: Function that raises the least of an optimiser as far as it goes.
Raise: TypeAlias = Callable[[MaxMinOptimiser], Generator[Step, None, ActiveCorners | None]]


def raise_from_better(
    promising: MaxMinOptimiser, reached: MaxMinOptimiser | None, raise_least: Raise, trial_iterations: int
) -> Generator[Step, None, MaxMinResult]:
    """Raise the least from a start; from another one where that is the higher still after some iterations.

    Parameters
    ----------
    promising, reached : MaxMinOptimiser
        The two starts; None where there is no second.
    raise_least : callable
    trial_iterations : int

    Yields
    ------
    Step

    Returns
    -------
    MaxMinResult
        No lower than either start.
    """
    steps, active = raise_least(promising), None
    if reached is not None:
        for _ in range(trial_iterations):
            try:
                yield next(steps)
            except StopIteration as end:
                active = end.value
                break
        if promising.corners.movable_minimum < reached.corners.movable_minimum:
            return MaxMinResult(reached, (yield from raise_least(reached)))
    return MaxMinResult(promising, (yield from steps) if active is None else active)
