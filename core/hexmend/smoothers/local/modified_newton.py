"""Local optimisation by modified Newton: Algorithm 3.2 with A.4 and A.5."""

from __future__ import annotations

from hexmend.kernels import local
from hexmend.smoothers.base import method
from hexmend.smoothers.local.single_node import LocalDescent


@method
class LocalModifiedNewton(LocalDescent):
    """Node after node by Newton's direction, the 3 x 3 Hessian made positive definite."""

    name = "local-mnr"
    title = "Local modified Newton"
    help = "Like local Newton-Raphson, with small or negative eigenvalues of the 3 x 3 Hessian raised."
    source = "Wilson 3.2, Algorithms 3.2, A.4 and A.5"
    direction = local.Direction.MODIFIED_NEWTON
