"""Newton's method, with the Hessian as it is and made positive definite: Algorithm 3.3 with A.3, A.4 and A.5."""

from __future__ import annotations

from hexmend.optimise.search_direction import DirectionMethod, ModifiedNewton, Newton
from hexmend.smoothers.base import method
from hexmend.smoothers.global_.descent import GlobalNewton


@method
class GlobalModifiedNewton(GlobalNewton):
    """All free nodes at once by Newton's direction, the Hessian made positive definite."""

    name = "global-mnr"
    title = "Global modified Newton"
    help = "Newton's method for all nodes at once, with the Hessian's eigenvalues raised. More robust, slightly slower."
    source = "Wilson 3.2, Algorithms 3.3, A.4 and A.5"

    def direction(self) -> DirectionMethod:
        return ModifiedNewton(self.linear_solver())


@method
class GlobalNewtonRaphson(GlobalNewton):
    """All free nodes at once by Newton's direction."""

    name = "global-nr"
    title = "Global Newton-Raphson"
    help = "Newton's method for all nodes at once: the optimum in about twelve steps if no hex is inverted."
    source = "Wilson 3.2, Algorithms 3.3, A.3 and A.5"

    def direction(self) -> DirectionMethod:
        return Newton(self.linear_solver())
