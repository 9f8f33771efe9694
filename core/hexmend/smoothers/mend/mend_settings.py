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
    max_p: float = parameter(
        1.0,
        low=1,
        high=MAX_P,
        help="p is doubled at the optimum up to this value, for the worst hexes; not with goal balanced.",
        advanced=True,
    )
    initial_epsilon: float = parameter(
        0.03,
        low=1e-6,
        high=1,
        unit="mean edge length³",
        help="e of the first delta, δ² = e (e − worst determinant); it falls until no hex is inverted.",
        advanced=True,
    )
    guard: bool = parameter(
        False,
        help="Keep the best iterate that lowers neither the least q(H) nor the minimum scaled Jacobian.",
        label="Keep the best result",
    )

    @property
    def norm(self) -> ObjectiveNorm:
        """The highest p and the offset: the objective at whose optimum a run ends.

        Steps with a lower p record the objective with that p instead. Steps that raise the minimum scaled Jacobian do
        not minimise an energy: they record this one, for comparison, and it may rise.
        """
        return ObjectiveNorm(max(self.first_norm.p, self.p_limit), self.offset)

    @property
    def first_norm(self) -> ObjectiveNorm:
        """The objective that is minimised first."""
        automatic = 1.0 if self.balances else 2.0
        return ObjectiveNorm(automatic if self.p == AUTO else self.p, self.offset)

    def first_norm_on(self, mesh: Mesh) -> ObjectiveNorm:
        """The objective that is minimised first on a mesh; with a target p is 2 by default: layers keep heights."""
        return ObjectiveNorm(2.0, self.offset) if self.p == AUTO and mesh.element_target else self.first_norm

    @property
    def p_limit(self) -> float:
        """Value up to which p is doubled."""
        return 1.0 if self.balances else self.max_p

    @property
    def balances(self) -> bool:
        """The best shape above floors is the goal."""
        return self.goal == "balanced"

    @property
    def maximises_jacobian(self) -> bool:
        """The minimum scaled Jacobian is the goal."""
        return self.goal == "scaled-jacobian"

    @property
    def maximises_minimum(self) -> bool:
        """The least value of a measure of corners is the goal."""
        return self.goal in ("scaled-jacobian", "time-step")

    @property
    def ignored_parameters(self) -> str:
        ignored = [
            name for name, value in (("max_p", self.max_p > 1), ("guard", self.guard)) if value and self.balances
        ]
        own = f"{' and '.join(ignored)} {'has' if len(ignored) == 1 else 'have'} no effect with goal = balanced."
        return " ".join(filter(None, [super().ignored_parameters, own if ignored else ""]))
