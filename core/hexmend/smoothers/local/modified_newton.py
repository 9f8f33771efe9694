"""Local optimisation by modified Newton: Algorithm 3.2 with A.4 and A.5."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.kernels import local
from hexmend.smoothers.base import method
from hexmend.smoothers.local.single_node import LocalDescent


@method
@dataclass(frozen=True)
class LocalModifiedNewton(LocalDescent):
    """Node after node by Newton's direction, the 3 x 3 Hessian made positive definite."""

    name = "local-mnr"
    title = "Local modified Newton"
    help = "As local Newton-Raphson, with the eigenvalues of the 3 x 3 Hessian raised where they are small or negative."
    source = "Wilson 3.2, Algorithms 3.2, A.4 and A.5"
    direction = local.MODIFIED_NEWTON
