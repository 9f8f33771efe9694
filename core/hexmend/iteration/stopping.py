"""Stopping criteria of a run."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.aliases import exports
from hexmend.parameters import Parametrised, parameter


@dataclass(frozen=True)
class StoppingCriteria(Parametrised):
    """Limits at which a run ends by itself, and the choice of the iterate that it keeps."""

    max_iterations: int = parameter(300, low=0, high=1_000_000, help="Most iterations of a run.")
    tolerance: float = parameter(
        1e-4,
        low=0,
        high=1,
        unit="mean edge length",
        help="Converged when no node moves further than this in an iteration (A.1), unless the method goes on to other "
        "steps or, of an optimiser, its objective still falls by more than a thousandth.",
    )
    move: str = parameter(
        "length",
        choices=("length", "coordinate"),
        help="How far a node moves: the length of its way, or the greatest change of a coordinate, as A.1 is written.",
    )
    max_seconds: float = parameter(
        0.0,
        low=0,
        high=1e7,
        unit="s",
        help="Most seconds in the smoother; 0 sets no limit. The iteration at hand ends.",
    )
    keep_last: bool = parameter(
        False,
        help="Keep the last iterate, however bad, not the best by inverted hexes, then least q(H).",
    )


__getattr__ = exports(__name__)
