"""Stopping criteria of a run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from hexmend.iteration.step import Outcome
from hexmend.parameters import AUTO, Parametrised, parameter


class Limited(Protocol):
    """Method with an iteration limit of its own."""

    @property
    def iteration_limit(self) -> int:
        """Iterations after which a run ends."""


@dataclass(frozen=True)
class StoppingCriteria(Parametrised):
    """Limits at which a run ends by itself, and the choice of the iterate that it keeps."""

    max_iterations: int = parameter(
        AUTO,
        low=0,
        high=1_000_000,
        help="Iteration limit of a run; auto: that of the method, 5,000 for mend and 300 for others.",
        automatic=AUTO,
    )
    tolerance: float = parameter(
        1e-4,
        low=0,
        high=1,
        unit="mean edge length",
        help="Converged when no node moves further in an iteration (A.1) and the objective of an optimiser falls by "
        "less than a thousandth.",
    )
    move: str = parameter(
        "length",
        choices=("length", "coordinate"),
        help="Measure of a node's move: its length, or the largest change of a coordinate as in A.1.",
        advanced=True,
    )
    moves_only: bool = parameter(
        False,
        help="Judge convergence by the moves of nodes alone, as A.1 does, even while the objective still falls.",
        advanced=True,
    )
    max_seconds: float = parameter(
        0.0,
        low=0,
        high=1e7,
        unit="s",
        zero="none",
        help="Time limit of the method with its set-up; 0 sets no limit. The current iteration is completed.",
    )
    keep_last: bool = parameter(
        False,
        help="Keep the last iterate, even if the method ranks an earlier one higher.",
        advanced=True,
    )

    def limit_of(self, method: Limited) -> int:
        """Return the iteration limit of a run of a method."""
        return method.iteration_limit if self.max_iterations == AUTO else self.max_iterations

    def reached(self, method: Limited, iterations: int, seconds: float) -> Outcome | None:
        """Return the limit that a run of a method is at after so many iterations and seconds; None if at neither."""
        if iterations >= self.limit_of(method):
            return Outcome.MAX_ITERATIONS
        return Outcome.MAX_SECONDS if 0 < self.max_seconds <= seconds else None
