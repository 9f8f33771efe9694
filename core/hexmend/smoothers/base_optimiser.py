"""Bases of the optimisers of (3.3): the objective, and the barrier that untangles."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.energy import POLICIES, ObjectiveNorm
from hexmend.parameters import parameter
from hexmend.smoothers.sliding_smoother import SlidingSmoother


@dataclass(frozen=True)
class ObjectiveSmoother(SlidingSmoother):
    """Method that lowers (3.3)."""

    optimises = True

    p: float = parameter(
        2.0, low=1, high=32, help="Exponent of the objective (3.3): the higher, the more the worst hexes count."
    )
    offset: float = parameter(
        1.0,
        low=0,
        high=1,
        help="Subtracted from a hex's mean η before the power: 1 as in (B.20); 0 as in chapter 4, for a higher mean.",
    )

    @property
    def power(self) -> ObjectiveNorm:
        """p and offset of the objective that it minimises."""
        return ObjectiveNorm(self.p, self.offset)


@dataclass(frozen=True)
class Optimiser(ObjectiveSmoother):
    """Method that untangles by a barrier softened by delta."""

    delta: float = parameter(
        0.01,
        low=0,
        high=10,
        unit="mean edge length³",
        help="Softness of the barrier (3.2) while any hex is inverted; then zero. Large values move the optimum.",
    )
    delta_policy: str = parameter(
        "fixed",
        choices=tuple(POLICIES),
        help="fixed: delta as given; adaptive: larger for deeply inverted hexes, falling to delta as they recover.",
    )
