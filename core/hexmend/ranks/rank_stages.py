"""Stages of mend on a mesh that is divided among ranks, and what ranks cannot do."""

from __future__ import annotations

import numpy as np

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.errors import ParameterError
from hexmend.iteration import Outcome, Step
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.floors.movable_hexes import MovableHexes
from hexmend.quality import ElementQuality, measure
from hexmend.quality.regressions import WORSE_BY
from hexmend.ranks.rank_part import RankPart
from hexmend.ranks.rank_sliding import RankSliding
from hexmend.smoothers import Smoother
from hexmend.smoothers.base import Steps
from hexmend.smoothers.mend.floors import BARRIER_SAFE
from hexmend.smoothers.mend.goals import reach_goal
from hexmend.smoothers.mend.mend import Mend
from hexmend.smoothers.mend.stages import Stages, keeping

_REMEDY = "run it in one process, without mpiexec"


def check_method(smoother: Smoother) -> None:
    """Raise `ParameterError` for a method that several ranks cannot run."""
    if not isinstance(smoother, Mend):
        raise ParameterError(f"{smoother.title} does not run on several MPI ranks yet, mend does: {_REMEDY}")
    if smoother.goal not in ("shape", "balanced"):
        words = f"goal = {smoother.goal} does not run on several MPI ranks yet, goals shape and balanced do"
        raise ParameterError(f"{words}: {_REMEDY}")


def check_mesh(mesh: Mesh) -> None:
    """Raise `ParameterError` for a mesh that several ranks cannot smooth."""
    if mesh.linear_motion is not None:
        raise ParameterError(f"nodes with a linear motion do not run on several MPI ranks yet: {_REMEDY}")


class RankStages(Stages):
    """Stages of mend on a part: untangling, the optimum of shape, that with a boundary that slides, and the floors.

    Parameters
    ----------
    settings : Mend
    part : RankPart
        With the boundary fixed.
    sliding : RankSliding or None
        The boundary if it slides.

    Attributes
    ----------
    unsound : bool
        The minimum scaled Jacobian is not sound after untangling, so that the stages ended there, or hexes are invalid
        between positive corners.
    """

    def __init__(self, settings: Mend, part: RankPart, sliding: RankSliding | None):
        super().__init__(settings)
        self._part, self._slides = part, sliding
        self.unsound = False

    def steps(self, mesh: Mesh) -> Steps:
        yield Step(mesh.points)
        sliding, balances, given = self._slides, self.settings.balances, mesh.points
        energy = self._energy(mesh, self.settings.norm_on(mesh))
        shape = yield from self._shape(mesh, energy, balances or sliding is not None)
        if not balances and sliding is None:
            self.unsound = self._is_invalid_inside(shape.points)
            return shape.outcome
        kept = None
        self.unsound = self._is_unsound(energy, shape.points)
        if self.unsound:
            return Outcome.NO_IMPROVEMENT
        starts, first = [given, shape.points], measure(given, mesh.elements)
        mean = -np.inf if self._part.ranks.any(first.inverted) else energy.mean(first.q)
        if sliding is not None:
            if balances:
                fixed = yield from reach_goal(self.settings, self._sound(energy, shape.points), starts, given, mean)
                given, kept = fixed.points, measure(fixed.points, mesh.elements)
            norm = self.settings.norm_on(sliding.mesh)
            energy = MeshEnergy(sliding.mesh, norm, motion=sliding.motion)
            steps = self._shape(sliding.with_points(shape.points), energy, True)
            shape = yield from keeping(kept, mesh.elements, steps, self._is_lower)
            starts = [given, shape.points]
            self.unsound = self._is_unsound(energy, shape.points)
        if not balances or self.unsound:
            self.unsound = self.unsound or self._is_invalid_inside(shape.points)
            return shape.outcome
        goal = reach_goal(self.settings, self._sound(energy, shape.points), starts, given, mean)
        reached = yield from keeping(kept, mesh.elements, goal, self._is_lower)
        yield Step(reached.points, decision=reached.message, intermediate=True)
        self.unsound = self._is_invalid_inside(reached.points)
        return Outcome.NO_IMPROVEMENT

    def _energy(self, mesh: Mesh, norm: ObjectiveNorm) -> MeshEnergy:
        return MeshEnergy(self._part.mesh, norm, motion=self._part.motion)

    def _is_unsound(self, energy: MeshEnergy, points: np.ndarray) -> bool:
        """Return True if the minimum scaled Jacobian of what can be moved is too low for the barrier of floors."""
        least = MovableHexes(energy).jacobians(energy.to_edge_units(points)).min(initial=np.inf)
        return energy.ranks.least(float(least)) < BARRIER_SAFE

    def _is_invalid_inside(self, points: np.ndarray) -> bool:
        """Return True on all ranks if a hex is invalid between positive corners: one process alone makes it valid."""
        quality = measure(points, self._part.mesh.elements)
        return self._part.ranks.any(quality.invalid & ~quality.inverted)

    def _is_lower(self, now: ElementQuality, kept: ElementQuality) -> bool:
        """Return True on all ranks if a hex is inverted, or one of the least values is lower."""
        ranks = self._part.ranks
        pairs = (now.q, kept.q), (now.scaled_jacobian, kept.scaled_jacobian)
        lower = [ranks.least(float(new.min())) < ranks.least(float(old.min())) - WORSE_BY for new, old in pairs]
        return ranks.any(now.inverted) or any(lower)
