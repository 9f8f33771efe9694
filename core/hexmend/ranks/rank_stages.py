"""Stages of mend on a mesh that is divided among ranks, and what ranks cannot do."""

from __future__ import annotations

from collections.abc import Generator

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.energy import ObjectiveNorm
from hexmend.errors import ParameterError
from hexmend.iteration import Outcome, Step
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.floors.movable_hexes import MovableHexes
from hexmend.quality import ElementQuality, measure
from hexmend.quality.regressions import WORSE_BY
from hexmend.ranks.rank_energy import RankEnergy
from hexmend.ranks.rank_part import RankPart
from hexmend.ranks.rank_sliding import RankSliding, RankSlidingEnergy
from hexmend.smoothers import Smoother
from hexmend.smoothers.base import Steps
from hexmend.smoothers.mend.balance import balance
from hexmend.smoothers.mend.maxmin import MAXMIN
from hexmend.smoothers.mend.mend import Mend
from hexmend.smoothers.mend.shape_optimum import ShapeOptimum
from hexmend.smoothers.mend.stages import Stages, keeping

_REMEDY = "run it in one process, without mpiexec"


def check_method(smoother: Smoother) -> None:
    """Raise `ParameterError` for a method that several ranks cannot run."""
    if not isinstance(smoother, Mend):
        raise ParameterError(f"{smoother.title} does not run on several MPI ranks yet, mend does: {_REMEDY}")
    if smoother.goal not in ("shape", "balanced") or smoother.guard:
        which = "guard = true" if smoother.guard else f"goal = {smoother.goal}"
        raise ParameterError(f"{which} does not run on several MPI ranks yet, goals shape and balanced do: {_REMEDY}")


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
        energy = self._energy(mesh, self.settings.first_norm_on(mesh))
        shape = yield from self._shape(mesh, energy, balances or sliding is not None)
        if not balances and sliding is None:
            self.unsound = self._is_invalid_inside(shape.points)
            return shape.outcome
        self.unsound, kept = self._is_unsound(mesh, shape.points, None), None
        if self.unsound:
            return Outcome.NO_IMPROVEMENT
        if sliding is not None:
            if balances:
                fixed = yield from balance(self._sound_energy(mesh, shape.points, None), shape.points, given)
                given, kept = fixed.points, measure(fixed.points, mesh.hexes)
            mesh = sliding.mesh
            shape = yield from keeping(kept, mesh.hexes, self._sliding_shape(sliding, shape.points), self._is_lower)
            self.unsound = self._is_unsound(mesh, shape.points, sliding)
        if not balances or self.unsound:
            self.unsound = self.unsound or self._is_invalid_inside(shape.points)
            return shape.outcome
        energy = self._sound_energy(mesh, shape.points, sliding)
        begin = None if kept is None else given
        steps = balance(energy, shape.points, given, begin=begin)
        balanced = yield from keeping(kept, mesh.hexes, steps, self._is_lower)
        yield Step(balanced.points, decision=balanced.message, intermediate=True)
        self.unsound = self._is_invalid_inside(balanced.points)
        return Outcome.NO_IMPROVEMENT

    def _sliding_shape(self, sliding: RankSliding, points: np.ndarray) -> Generator[Step, None, ShapeOptimum]:
        energy = self._energy(sliding.mesh, self.settings.first_norm_on(sliding.mesh), sliding)
        return (yield from self._shape(sliding.with_points(points), energy, True))

    def _energy(
        self, mesh: Mesh, norm: ObjectiveNorm, sliding: SlidingBoundary | RankSliding | None = None
    ) -> RankEnergy:
        return RankEnergy(self._part, norm) if sliding is None else RankSlidingEnergy(sliding, norm)

    def _is_unsound(self, mesh: Mesh, points: np.ndarray, sliding: RankSliding | None) -> bool:
        """Return True if the minimum scaled Jacobian of what can be moved is too low for the barrier of floors."""
        energy = self._sound_energy(mesh, points, sliding)
        least = MovableHexes(energy).jacobians(energy.to_edge_units(points)).min(initial=np.inf)
        return energy.ranks.least(float(least)) < MAXMIN.barrier_safe

    def _is_invalid_inside(self, points: np.ndarray) -> bool:
        """Return True on all ranks if a hex is invalid between positive corners: one process alone makes it valid."""
        quality = measure(points, self._part.mesh.hexes)
        return self._part.ranks.any(quality.invalid & ~quality.inverted)

    def _is_lower(self, now: ElementQuality, kept: ElementQuality) -> bool:
        """Return True on all ranks if a hex is inverted, or one of the least values is lower."""
        ranks = self._part.ranks
        pairs = (now.q, kept.q), (now.scaled_jacobian, kept.scaled_jacobian)
        lower = [ranks.least(float(new.min())) < ranks.least(float(old.min())) - WORSE_BY for new, old in pairs]
        return ranks.any(now.inverted) or any(lower)
