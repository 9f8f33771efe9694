"""Global optimisation by steepest descent: Algorithm 3.3 with A.2 and A.5."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.energy import MeshEnergy
from hexmend.kernels.line_search import LineSearch
from hexmend.optimise.search_direction import DirectionMethod, steepest_descent
from hexmend.parameters import parameter
from hexmend.smoothers.base import method
from hexmend.smoothers.global_.descent import GlobalDescent


@method
@dataclass(frozen=True)
class GlobalSteepestDescent(GlobalDescent):
    """All free nodes at once down the gradient of the mesh's energy."""

    name = "global-sd"
    title = "Global steepest descent"
    help = "Moves all nodes at once down the gradient. Slow or stuck: one bad region limits the step of the whole mesh."
    source = "Wilson 3.2, Algorithms 3.3, A.2 and A.5"
    bytes_per_hex = 700

    step_unit: str = parameter(
        "edge",
        choices=("edge", "mesh"),
        help="Unit of length of the first trial step: the mean edge length, or that of the points (A.2, A.5).",
        advanced=True,
    )

    def search(self, energy: MeshEnergy) -> LineSearch:
        """In the mesh's unit a gradient is shorter by its mean edge length, and a step longer in edge lengths."""
        step = self.initial_step if self.step_unit == "edge" else self.initial_step / energy.unit**2
        return self.line_search.with_initial_step(step)

    def direction(self) -> DirectionMethod:
        return steepest_descent
