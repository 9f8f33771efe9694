"""Global optimisation by steepest descent: Algorithm 3.3 with A.2 and A.5."""

from __future__ import annotations

from hexmend.optimise.search_direction import DirectionMethod, steepest_descent
from hexmend.smoothers.base import method
from hexmend.smoothers.global_.base import GlobalDescent


@method
class GlobalSteepestDescent(GlobalDescent):
    """All free nodes at once down the gradient of the mesh's energy."""

    name = "global-sd"
    title = "Global steepest descent"
    help = "Moves all nodes at once down the gradient. Slow or stuck: one bad region limits the step of the whole mesh."
    source = "Wilson 3.2, Algorithms 3.3, A.2 and A.5"
    bytes_per_hex = 700

    def direction(self) -> DirectionMethod:
        return steepest_descent
