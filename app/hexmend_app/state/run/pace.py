"""Pace at which the iterations of a run are shown."""

from __future__ import annotations

from enum import Enum


class Pace(Enum):
    """Pace at which the iterations of a run are shown."""

    #: The newest iteration, as often as it can be drawn; others are skipped.
    FASTEST = "fastest"
    #: Each of the first iterations for a moment at least, so that the eye can follow a short run; then the newest.
    SLOW_START = "slow-start"
    #: Each iteration: the run waits until it is shown.
    EVERY = "every"
