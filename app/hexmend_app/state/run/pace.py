"""Pace at which the iterations of a run are shown, and the easing of short runs."""

from __future__ import annotations

import math
from enum import Enum

#: Seconds that a short run is shown for, and in which at least the rest of a run is shown after its end.
SHOWN, REST = 2.5, 0.5

#: Seconds by which the shown iteration is behind the newest one of a run that goes on.
_BEHIND = 1.0

#: Part of an iteration within which the newest is shown.
_NEAR = 0.01

#: Iterations a second that are shown as a run begins; the first move most. After a second they are eight times as many.
_FIRST = 4.0


class Pace(Enum):
    """Pace at which the iterations of a run are shown."""

    #: The newest iteration, as often as it can be drawn; others are skipped.
    FASTEST = "fastest"
    #: Iterations that merge into one another, so that short runs take two to three seconds in the view.
    EASED = "eased"
    #: Each iteration: the run waits until it is shown.
    EVERY = "every"


class Easing:
    """Position in a run that is shown: behind its newest iteration, so that the eye can follow.

    While the run goes on, the position approaches the newest iteration. When the run is over, it goes on to the end
    with a smooth start and stop, so that a short run is shown for `SHOWN` seconds in all.

    Parameters
    ----------
    now : float
        Time at which the run begins, in seconds, as of all calls.
    """

    def __init__(self, now: float):
        self._began = self._last = now
        self._first: float | None = None  # time of the first iteration
        self._at = 0.0
        self._end: tuple[float, float, float] | None = None  # time and position of the end, seconds to the last

    def position(self, now: float, newest: int) -> float:
        """Return the position while the run goes on, as a number of iterations."""
        if self._first is None:
            if newest < 1:
                return 0.0
            self._first = self._last = now
        seconds, self._last = now - self._last, now
        most = seconds * _FIRST * (1 + now - self._first) ** 3
        self._at += min((1 - math.exp(-seconds / _BEHIND)) * (newest - self._at), most)
        if newest - self._at < _NEAR:
            self._at = float(newest)
        return self._at

    def finish(self, now: float) -> None:
        """Begin the rest: the run is over."""
        if self._end is None:
            self._end = now, self._at, max(REST, SHOWN - (now - self._began))

    def rest(self, now: float, result: int) -> float | None:
        """Return the position after the end of the run; None once its result is reached."""
        begin, start, seconds = self._end
        share = (now - begin) / seconds
        return None if share >= 1 else start + (result - start) * share * share * (3 - 2 * share)
