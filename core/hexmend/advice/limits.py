"""Limits of suggested runs."""

from __future__ import annotations

from dataclasses import replace

from hexmend.advice.situation import Situation
from hexmend.iteration import Outcome, StoppingCriteria
from hexmend.smoothers.base_optimiser import Optimiser


def larger_limits(now: Situation) -> tuple[StoppingCriteria, str]:
    """Raise the limit that has ended the run; return all limits and the words for the suggestion."""
    stop = now.stop
    if now.result.outcome is Outcome.MAX_ITERATIONS:
        stop = replace(stop, max_iterations=min(max(2 * stop.limit_of(now.smoother), 100), 1_000_000))
        return stop, f" with a limit of {stop.max_iterations:,} iterations"
    if now.result.outcome is Outcome.MAX_SECONDS:
        stop = replace(stop, max_seconds=min(2 * stop.max_seconds, 1e7))
        return stop, f" with a limit of {stop.max_seconds:g} s"
    return stop, ""


def with_last_kept(now: Situation, stop: StoppingCriteria) -> tuple[StoppingCriteria, str]:
    """Return the limits with `keep_last` for a method that descends, and the sentence for the suggestion.

    Near the optimum the least q(H) varies a little while the objective falls. If it happens to be high at the beginning
    of a run, every later iteration would count as worse, and the mesh would stay as it was.
    """
    if now.result.after.inverted or not isinstance(now.smoother, Optimiser):  # with delta more may be inverted
        return stop, ""
    return replace(stop, keep_last=True), " The last iteration is kept: of all it has the lowest objective."
