"""Parameters of mend, and what follows from them."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.energy import ObjectiveNorm
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import AUTO, parameter
from hexmend.smoothers.base_optimiser import MAX_P, ObjectiveSmoother


@dataclass(frozen=True)
class MendSettings(ObjectiveSmoother):
    """Method with the parameters of mend."""

    goal: str = parameter(
        "balanced",
        choices=("balanced", "shape", "scaled-jacobian", "time-step"),
        titles=("Balanced", "Best mean shape", "Minimum scaled Jacobian", "Longest time step"),
        help="balanced: the best shape that lowers no key figure; shape: the minimum of (3.3); scaled-jacobian: the "
        "highest minimum scaled Jacobian; time-step: the longest explicit time step.",
    )
    p: float = parameter(
        AUTO,
        low=1,
        high=MAX_P,
        help="Exponent of the objective (3.3); auto: 1 with goal balanced and no target, else 2.",
        automatic=AUTO,
        advanced=True,
    )

    @property
    def norm(self) -> ObjectiveNorm:
        """p and offset of the objective.

        Steps that raise the minimum scaled Jacobian do not minimise it: they record it for comparison.
        """
        automatic = 1.0 if self.balances else 2.0
        return ObjectiveNorm(automatic if self.p == AUTO else self.p, self.offset)

    def norm_on(self, mesh: Mesh) -> ObjectiveNorm:
        """The objective on a mesh; with a target p is 2 by default: layers keep heights."""
        return ObjectiveNorm(2.0, self.offset) if self.p == AUTO and mesh.element_target else self.norm

    @property
    def balances(self) -> bool:
        """The best shape above floors is the goal."""
        return self.goal == "balanced"

    @property
    def maximises_jacobian(self) -> bool:
        """The minimum scaled Jacobian is the goal."""
        return self.goal == "scaled-jacobian"
