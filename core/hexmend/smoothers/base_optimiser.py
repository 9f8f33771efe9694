"""Bases of the optimisers of (3.3): the objective, the barrier that untangles, and the line search."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.boundary import SlidingBoundary
from hexmend.energy import POLICIES, ObjectiveNorm
from hexmend.energy.quads import SurfaceQuads
from hexmend.kernels.line_search import LineSearch
from hexmend.parameters import parameter
from hexmend.smoothers.targeted_smoother import TargetedSmoother

#: Greatest exponent of the objective: higher powers of eta overflow.
MAX_P = 32


@dataclass(frozen=True)
class ObjectiveSmoother(TargetedSmoother):
    """Method that lowers (3.3)."""

    optimises = True

    p: float = parameter(
        2.0, low=1, high=MAX_P, help="Exponent of the objective (3.3): the higher, the more the worst hexes count."
    )
    offset: float = parameter(
        1.0,
        low=0,
        high=1,
        help="Subtracted from a hex's mean η before the power: 1 as in (B.20), 0 as in chapter 4.",
        advanced=True,
    )

    @property
    def norm(self) -> ObjectiveNorm:
        """p and offset of the objective that it minimises."""
        return ObjectiveNorm(self.p, self.offset)


@dataclass(frozen=True)
class Optimiser(ObjectiveSmoother):
    """Method that untangles by a barrier softened by delta, with a line search along its directions."""

    delta: float = parameter(
        0.01,
        low=0,
        high=10,
        unit="mean edge length³",
        help="Regularisation of the barrier (3.2) while any hex is inverted; then zero. Large values move the optimum.",
    )
    delta_policy: str = parameter(
        "fixed",
        choices=tuple(POLICIES),
        help="fixed: delta as given; adaptive: larger for deeply inverted hexes, falling to delta as they recover.",
        advanced=True,
    )
    delta_unit: str = parameter(
        "edge",
        choices=("edge", "mesh"),
        help="Unit of length for delta: the mean edge length of the mesh, or the unit of its points (Table 4.3).",
        advanced=True,
    )
    initial_step: float = parameter(
        1.0, low=1e-6, high=1e6, help="First trial step α of the line search (A.5).", advanced=True
    )
    backtrack_factor: float = parameter(
        0.7, low=0.01, high=0.99, help="Factor λ by which a rejected step is shortened (A.5).", advanced=True
    )
    c1: float = parameter(
        1e-4, low=0, high=0.5, help="Fraction c₁ of the slope required of a step (Armijo, A.5).", advanced=True
    )
    max_backtracks: int = parameter(
        100, low=1, high=500, help="Backtracks after which a step is given up.", advanced=True
    )

    surface_weight: float = parameter(
        0.0,
        low=0,
        high=1e6,
        help="Weight of the shape of a sliding boundary's quads in the objective, relative to a hex (5.2.1).",
        advanced=True,
    )

    @property
    def ignored_parameters(self) -> str:
        ignored = self.surface_weight > 0 and not self.slides
        own = f"surface_weight has no effect with boundary = {self.boundary}." if ignored else ""
        return " ".join(filter(None, [super().ignored_parameters, own]))

    def surface_quads(self, sliding: SlidingBoundary | None) -> SurfaceQuads | None:
        """The boundary's quads as a term of the objective; None where they do not count."""
        if sliding is None or not self.slides or self.surface_weight == 0:
            return None
        return SurfaceQuads(sliding, self.norm, self.surface_weight)

    @property
    def line_search(self) -> LineSearch:
        """The line search with the method's parameters."""
        return LineSearch(self.initial_step, self.backtrack_factor, self.c1, self.max_backtracks)
