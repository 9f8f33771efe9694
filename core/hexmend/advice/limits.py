"""Limits under which a run that is suggested goes on."""

from __future__ import annotations

from dataclasses import replace

from hexmend.advice.situation import Situation
from hexmend.optimise import Outcome, Stop
from hexmend.smoothers.optimiser import Optimiser


def longer(now: Situation) -> tuple[Stop, str]:
    """Limits that let it go on for longer, and the words for that."""
    stop = now.stop
    if now.result.outcome is Outcome.MAX_ITERATIONS:
        stop = replace(stop, max_iterations=min(max(2 * stop.max_iterations, 100), 1_000_000))
        return stop, f" with a limit of {stop.max_iterations:,} iterations"
    if now.result.outcome is Outcome.MAX_SECONDS:
        stop = replace(stop, max_seconds=min(2 * stop.max_seconds, 1e7))
        return stop, f" with a limit of {stop.max_seconds:g} s"
    return stop, ""


def to_the_last(now: Situation, stop: Stop) -> tuple[Stop, str]:
    """Limits under which a method that descends keeps what it gains, and the words for that.

    Near its optimum the least q(H) goes up and down by a little while the objective falls. Where it happens to be high
    as a run begins, every later iteration would be taken for worse, and the mesh be left as it was.
    """
    if now.result.after.inverted or not isinstance(now.smoother, Optimiser):  # with delta more may be inverted
        return stop, ""
    return replace(stop, keep_last=True), " The last iteration is kept: of all it has the lowest objective."
