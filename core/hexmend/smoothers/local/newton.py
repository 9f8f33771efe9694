"""Newton's method, with the Hessian as it is and made positive definite: Algorithm 3.2 with A.3, A.4 and A.5."""

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


@method
class LocalNewtonRaphson(LocalDescent):
    """Node after node by Newton's direction for its patch's energy."""

    name = "local-nr"
    title = "Local Newton-Raphson"
    help = "Moves node after node by a Newton step for its patch's energy. Accurate and robust, expensive sweeps."
    source = "Wilson 3.2, Algorithms 3.2, A.3 and A.5"
    direction = local.Direction.NEWTON
