"""Mend: untangling, the optimum of shape, and the minimum scaled Jacobian; see `hexmend.smoothers.mend.stages`."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.energy.ranks import ONE_RANK, Ranks
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality
from hexmend.quality.corner_heights import least_heights
from hexmend.quality.regressions import WORSE_BY
from hexmend.smoothers.base import Steps, method, objective_of_sound
from hexmend.smoothers.mend.goals import TARGET_FALL, counted_steps
from hexmend.smoothers.mend.mend_settings import MendSettings
from hexmend.smoothers.mend.stages import Stages


@method
@dataclass(frozen=True)
class Mend(MendSettings):
    """Untangle with a barrier that hardens step by step, then optimise, by truncated Newton steps of all free nodes."""

    name = "mend"
    title = "Mend"
    help = "Untangles as far as the fixed nodes allow, then finds the best shape; no key figure ends below its start."
    source = "Wilson 5.2.2 and 5.2.4; truncated Newton: Dembo and Steihaug 1983"
    iteration_limit = 5000
    bytes_per_hex = 1200
    keeps_linear_motion = True

    def steps(self, mesh: Mesh) -> Steps:
        return Stages(self).steps(mesh)

    def rank(self, start: ElementQuality, now: ElementQuality) -> tuple[float, ...]:
        """Sort key of an iterate in one process; see `rank_on`."""
        return self.rank_on(ONE_RANK, start, now)

    def rank_on(self, ranks: Ranks, start: ElementQuality, now: ElementQuality) -> tuple[float, ...]:
        """Sort key of an iterate: the smallest is kept, of equals the last.

        First comes whether the minimum scaled Jacobian is lower than at the start while hexes are inverted, then
        whether more hexes are invalid than there, then the numbers of inverted and of invalid ones, then whether a
        figure that counts for the goal is lower than at the start, then whether the objective of the sound hexes is
        higher. With a target a fall counts from `TARGET_FALL` on: as given, a mesh may have better corners than hexes
        of the lengths that are asked for. The goal balanced counts the figures of all hexes but those that are inverted
        at the start and still are.

        Parameters
        ----------
        ranks : Ranks
            They call it together, each with its share of the hexes.
        start, now : ElementQuality
            See `Smoother.rank`.

        Returns
        -------
        tuple of float
            The same on all ranks.
        """
        before, after = (ranks.least(_least(of.scaled_jacobian)) for of in (start, now))
        invalid, inverted = ranks.sum(now.n_invalid), ranks.sum(now.n_inverted)
        fell = inverted > 0 and after < before - WORSE_BY
        counts = fell, invalid > ranks.sum(start.n_invalid), inverted, invalid
        if self.balances:
            return *counts, self._lowers(ranks, start, now)
        share = 1 - TARGET_FALL if now.against_target else 1.0
        if self.maximises_jacobian:
            return *counts, after < share * before - WORSE_BY, counted_steps(after)
        if self.goal == "time-step":  # the time step itself comes last, see `rank_by_points`
            return counts
        harmed = after < share * before and ranks.least(_least(now.q)) < share * ranks.least(_least(start.q))
        objectives = [ranks.sum(objective_of_sound(of, self.norm)) for of in (start, now)]
        return *counts, harmed, objectives[1] > objectives[0]

    def _lowers(self, ranks: Ranks, start: ElementQuality, now: ElementQuality) -> bool:
        """Return True if q min, the minimum scaled Jacobian or, of a sound mesh, q mean is lower than at the start."""
        share = 1 - TARGET_FALL if now.against_target else 1.0
        judged = ~(start.inverted & now.inverted)
        count = ranks.sum(int(np.count_nonzero(judged)))
        if not count:
            return False
        rows = slice(None) if judged.all() else judged
        pairs = [(one.q[rows], one.scaled_jacobian[rows]) for one in (start, now)]
        (q, jacobian), (new_q, new_jacobian) = ([ranks.least(_least(values)) for values in pair] for pair in pairs)
        mean, new_mean = (ranks.sum(float(pair[0].sum())) / count for pair in pairs)
        mean_counts = not ranks.any(start.inverted[rows])
        return (
            new_q < share * q - WORSE_BY
            or new_jacobian < share * jacobian - WORSE_BY
            or (mean_counts and new_mean < mean - WORSE_BY)
        )

    def rank_by_points(self, hexes: np.ndarray, points: np.ndarray) -> tuple[float, ...]:
        return (-least_heights(points, hexes).min(),) if self.goal == "time-step" else ()


def _least(values: np.ndarray) -> float:
    return float(values.min(initial=np.inf))
