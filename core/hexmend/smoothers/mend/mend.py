"""Mend: untangling, the optimum of shape, and the least scaled Jacobian; see `hexmend.smoothers.mend.stages`."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.boundary.features import AUTO
from hexmend.energy import ObjectiveNorm
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import parameter
from hexmend.quality import ElementQuality
from hexmend.quality.corner_heights import least_heights
from hexmend.smoothers.base import Steps, method, objective_of_sound
from hexmend.smoothers.base_optimiser import ObjectiveSmoother
from hexmend.smoothers.mend.stages import Stages

#: Share by which least q and least scaled Jacobian may both fall where a mesh has a target.
_TARGET_FALL = 0.05


@method
@dataclass(frozen=True)
class Mend(ObjectiveSmoother):
    """Untangle with a barrier that hardens step by step, then optimise, by truncated Newton steps of all free nodes."""

    name = "mend"
    title = "Mend"
    help = (
        "Untangles as far as the fixed nodes allow, then finds the best shape in which no figure is lower than before."
    )
    source = "Wilson 5.2.2 and 5.2.4; truncated Newton: Dembo and Steihaug 1983"
    bytes_per_hex = 2200
    keeps_linear_motion = True

    goal: str = parameter(
        "balanced",
        choices=("balanced", "shape", "scaled-jacobian", "time-step"),
        help="balanced: the best mean shape above floors of the least scaled Jacobian and q(H), which rise first; "
        "shape: minimise (3.3); scaled-jacobian: then also maximise the least scaled Jacobian; time-step: or the "
        "smallest explicit time step, the least height of a hex.",
    )
    p: float = parameter(
        AUTO,
        low=1,
        high=32,
        help="Exponent of the objective (3.3): the higher, the more the worst hexes count; auto: 1 with goal balanced, "
        "else 2.",
        automatic=AUTO,
    )
    max_p: float = parameter(
        1.0,
        low=1,
        high=32,
        help="If higher than p, p is doubled at the optimum up to this value, for the worst hexes; not with goal "
        "balanced.",
    )
    initial_epsilon: float = parameter(
        0.03,
        low=1e-6,
        high=1,
        unit="mean edge length³",
        help="e of the first delta, δ² = e (e − worst determinant); it falls until no hex is inverted.",
    )
    guard: bool = parameter(
        False, help="Keep the best iterate that lowers neither the least q(H) nor the least scaled Jacobian."
    )
    solver_iterations: int = parameter(
        200, low=1, high=10**6, help="Iteration limit of conjugate gradients for a Newton step."
    )

    @property
    def norm(self) -> ObjectiveNorm:
        """The highest p and the offset: the objective at whose optimum a run ends.

        Steps with a lower p record the objective with that p instead. Steps that raise the least scaled Jacobian do not
        minimise an energy: they record this one, for comparison, and it may rise.
        """
        return ObjectiveNorm(max(self.first_norm.p, self.highest_p), self.offset)

    @property
    def first_norm(self) -> ObjectiveNorm:
        """The objective that is minimised first."""
        automatic = 1.0 if self.balances else 2.0
        return ObjectiveNorm(automatic if self.p == AUTO else self.p, self.offset)

    @property
    def highest_p(self) -> float:
        """Value up to which p is doubled."""
        return 1.0 if self.balances else self.max_p

    @property
    def balances(self) -> bool:
        """The best shape above floors is the goal."""
        return self.goal == "balanced"

    @property
    def maximises_jacobian(self) -> bool:
        """The least scaled Jacobian is the goal."""
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

    def steps(self, mesh: Mesh) -> Steps:
        return Stages(self).steps(mesh)

    def rank(self, start: ElementQuality, now: ElementQuality) -> tuple[float, ...]:
        """Sort key of an iterate: the smallest is kept, of equals the last.

        Inverted hexes come first, then whether a guarded figure is lower than at the start, then whether the objective
        of the sound hexes, with the highest p that was asked for, is higher. With a target a fall counts from
        `_TARGET_FALL` on: as given, a mesh may have better corners than hexes of the lengths that are asked for.
        """
        share = 1 - _TARGET_FALL if now.against_target and not self.guard else 1.0
        fallen = (
            now.q.min() < share * start.q.min(),
            now.scaled_jacobian.min() < share * start.scaled_jacobian.min(),
        )
        harmed = any(fallen) if self.guard or self.balances else all(fallen)
        if self.maximises_jacobian:
            return now.n_inverted, harmed, -now.scaled_jacobian.min()
        if self.goal == "time-step":  # the time step itself comes last, see `rank_by_points`
            return now.n_inverted, harmed if self.guard else False
        if self.balances:  # floors hold while the rest is raised: of equals the last is the best
            return now.n_inverted, harmed or (start.n_inverted == 0 and now.q.mean() < start.q.mean())
        before, after = (objective_of_sound(of, self.norm) for of in (start, now))
        return now.n_inverted, harmed, after > before

    def rank_by_points(self, hexes: np.ndarray, points: np.ndarray) -> tuple[float, ...]:
        return (-least_heights(points, hexes).min(),) if self.goal == "time-step" else ()

    def regression_hint(self, worse: tuple[str, ...]) -> str:
        if self.balances or self.maximises_minimum or "inverted" in worse:
            return ""
        if "scaled_jacobian" in worse:
            return "With goal=scaled-jacobian the least scaled Jacobian rises instead; with guard=true neither falls."
        return "With guard=true it does not fall." if worse else ""
