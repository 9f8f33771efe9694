"""Stopping criteria of a run."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.aliases import exports
from hexmend.parameters import Parametrised, parameter


@dataclass(frozen=True)
class StoppingCriteria(Parametrised):
    """Limits at which a run ends by itself, and the choice of the iterate that it keeps."""

    max_iterations: int = parameter(300, low=0, high=1_000_000, help="Iteration limit of a run.")
    tolerance: float = parameter(
        1e-4,
        low=0,
        high=1,
        unit="mean edge length",
        help="Converged when no node moves further than this in an iteration (A.1), unless the method has other steps "
        "to make or the objective of an optimiser still falls by more than a thousandth.",
    )
    move: str = parameter(
        "length",
        choices=("length", "coordinate"),
        help="Measure of a node's move: its length, or the largest change of a coordinate as in A.1.",
    )
    max_seconds: float = parameter(
        0.0,
        low=0,
        high=1e7,
        unit="s",
        help="Time limit of the smoother; 0 sets no limit. The current iteration is completed.",
    )
    keep_last: bool = parameter(
        False,
        help="Keep the last iterate, even if the method ranks an earlier one higher.",
    )


__getattr__ = exports(__name__)
