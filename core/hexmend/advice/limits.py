"""Limits under which a run that is suggested goes on."""

from __future__ import annotations

from dataclasses import replace

from hexmend.advice.situation import Situation
from hexmend.iteration import Outcome, StoppingCriteria
from hexmend.smoothers.base_optimiser import Optimiser


def raised_limits(now: Situation) -> tuple[StoppingCriteria, str]:
    """The limits of the run, raised where they ended it, and the sentence part that says so."""
    stop = now.stop
    if now.result.outcome is Outcome.MAX_ITERATIONS:
        stop = replace(stop, max_iterations=min(max(2 * stop.max_iterations, 100), 1_000_000))
        return stop, f" with a limit of {stop.max_iterations:,} iterations"
    if now.result.outcome is Outcome.MAX_SECONDS:
        stop = replace(stop, max_seconds=min(2 * stop.max_seconds, 1e7))
        return stop, f" with a limit of {stop.max_seconds:g} s"
    return stop, ""


def keeping_last(now: Situation, stop: StoppingCriteria) -> tuple[StoppingCriteria, str]:
    """The limits with `keep_last` for a method that descends, and the sentence that says so.

    Near its optimum the least q(H) goes up and down by a little while the objective falls. Where it happens to be high
    as a run begins, every later iteration would be taken for worse, and the mesh be left as it was.
    """
    if now.result.after.inverted or not isinstance(now.smoother, Optimiser):  # with delta more may be inverted
        return stop, ""
    return replace(stop, keep_last=True), " The last iteration is kept: of all it has the lowest objective."
