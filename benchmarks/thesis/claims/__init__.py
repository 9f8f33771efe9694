"""Conclusions of the thesis from Chapter 4, judged by measured figures."""

from collections.abc import Callable, Sequence

from benchmarks.thesis.claims import (
    cost,
    delta,
    global_methods,
    heuristics,
    local_methods,
    optimum,
    preconditioning,
    robustness,
)
from benchmarks.thesis.claims.claim import Claim, claims_of
from benchmarks.thesis.experiment_result import ExperimentResult

#: All claims, in the order of the report.
CLAIMS: tuple[Callable[[Sequence[ExperimentResult]], Claim], ...] = claims_of(
    optimum, heuristics, preconditioning, local_methods, global_methods, robustness, delta, cost
)

__all__ = ["CLAIMS", "Claim"]
