"""Local optimisation by steepest descent: Algorithm 3.2 with A.2 and A.5."""

from __future__ import annotations

from hexmend.kernels import local
from hexmend.smoothers.base import method
from hexmend.smoothers.local.single_node import LocalDescent


@method
class LocalSteepestDescent(LocalDescent):
    """Node after node down the gradient of its patch's energy."""

    name = "local-sd"
    title = "Local steepest descent"
    help = "Moves node after node down the gradient of its patch's energy. Smooths and untangles; reaches the optimum."
    source = "Wilson 3.2, Algorithms 3.2, A.2 and A.5"
    direction = local.Direction.STEEPEST_DESCENT
