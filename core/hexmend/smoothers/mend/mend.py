"""Mend: untangling, the optimum of shape, and the least scaled Jacobian; see `hexmend.smoothers.mend.stages`."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality
from hexmend.quality.corner_heights import least_heights
from hexmend.quality.regressions import WORSE_BY
from hexmend.smoothers.base import Steps, method, objective_of_sound
from hexmend.smoothers.mend.balance import BALANCE
from hexmend.smoothers.mend.mend_settings import MendSettings
from hexmend.smoothers.mend.stages import Stages


@method
@dataclass(frozen=True)
class Mend(MendSettings):
    """Untangle with a barrier that hardens step by step, then optimise, by truncated Newton steps of all free nodes."""

    name = "mend"
    title = "Mend"
    help = (
        "Untangles as far as the fixed nodes allow, then finds the best shape in which no figure is lower than before."
    )
    source = "Wilson 5.2.2 and 5.2.4; truncated Newton: Dembo and Steihaug 1983"
    iteration_limit = 1000
    bytes_per_hex = 1650
    keeps_linear_motion = True

    def steps(self, mesh: Mesh) -> Steps:
        return Stages(self).steps(mesh)

    def rank(self, start: ElementQuality, now: ElementQuality) -> tuple[float, ...]:
        """Sort key of an iterate: the smallest is kept, of equals the last.

        Inverted hexes come first, then whether a guarded figure is lower than at the start, then whether the objective
        of the sound hexes, with the highest p that was asked for, is higher. With a target a fall counts from
        `BalanceConfig.target_fall` on: as given, a mesh may have better corners than hexes of the lengths that are
        asked for. The goal balanced guards the figures of all hexes but those that are inverted at the start and still
        are.
        """
        if self.balances:
            return now.n_inverted, self._lowers(start, now)
        share = 1 - BALANCE.target_fall if now.against_target and not self.guard else 1.0
        fallen = (
            now.q.min() < share * start.q.min(),
            now.scaled_jacobian.min() < share * start.scaled_jacobian.min(),
        )
        harmed = any(fallen) if self.guard else all(fallen)
        if self.maximises_jacobian:
            return now.n_inverted, harmed, -now.scaled_jacobian.min()
        if self.goal == "time-step":  # the time step itself comes last, see `rank_by_points`
            return now.n_inverted, harmed if self.guard else False
        before, after = (objective_of_sound(of, self.norm) for of in (start, now))
        return now.n_inverted, harmed, after > before

    def _lowers(self, start: ElementQuality, now: ElementQuality) -> bool:
        """Return True if q min, the least scaled Jacobian or, of a sound mesh, q mean is lower than at the start."""
        share = 1 - BALANCE.target_fall if now.against_target else 1.0
        judged = ~(start.inverted & now.inverted)
        if not judged.any():
            return False
        pairs = [(one.q[judged], one.scaled_jacobian[judged]) for one in (start, now)]
        (q, jacobian), (new_q, new_jacobian) = pairs
        mean_counts = not start.inverted[judged].any()
        return (
            new_q.min() < share * q.min() - WORSE_BY
            or new_jacobian.min() < share * jacobian.min() - WORSE_BY
            or (mean_counts and new_q.mean() < q.mean() - WORSE_BY)
        )

    def rank_by_points(self, hexes: np.ndarray, points: np.ndarray) -> tuple[float, ...]:
        return (-least_heights(points, hexes).min(),) if self.goal == "time-step" else ()

    def regression_hint(self, worse: tuple[str, ...]) -> str:
        if self.balances or self.maximises_minimum or "inverted" in worse:
            return ""
        if "scaled_jacobian" in worse:
            return "With goal=scaled-jacobian the least scaled Jacobian rises instead; with guard=true neither falls."
        return "With guard=true it does not fall." if worse else ""
