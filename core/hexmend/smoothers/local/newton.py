"""Local optimisation by Newton's method: Algorithm 3.2 with A.3 and A.5."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.kernels import local
from hexmend.smoothers.base import method
from hexmend.smoothers.local.single_node import LocalDescent


@method
@dataclass(frozen=True)
class LocalNewtonRaphson(LocalDescent):
    """Node after node by Newton's direction for its patch's energy."""

    name = "local-nr"
    title = "Local Newton-Raphson"
    help = "Moves node after node by a Newton step for its patch's energy. Exact and steady, each sweep dearer."
    source = "Wilson 3.2, Algorithms 3.2, A.3 and A.5"
    direction = local.NEWTON
