"""The run of mend on a mesh that is divided among ranks: its iterations, limits, and the best of them.

Stages of mend on a mesh that is divided among ranks, and what ranks cannot do.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from time import perf_counter

import numpy as np

from hexmend.arrays import largest_norm
from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.errors import ParameterError
from hexmend.iteration import Outcome, Step, StoppingCriteria
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.floors.movable_hexes import MovableHexes
from hexmend.quality import ElementQuality, measure, measure_against_target
from hexmend.quality.regressions import WORSE_BY
from hexmend.ranks.rank_part import RankPart, RankSliding
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


@dataclass(frozen=True)
class RankFigures:
    """Figures of all hexes of an iterate."""

    invalid: int
    q_min: float
    q_mean: float

    @classmethod
    def of(cls, energy: MeshEnergy, quality: ElementQuality) -> RankFigures:
        """Take them together from the quality of the hexes of the part of each rank."""
        least = energy.ranks.least(float(quality.q.min(initial=np.inf)))
        return cls(energy.count(quality.invalid), least, energy.mean(quality.q))


@dataclass
class RankRun(Iterator[RankFigures]):
    """Iterator over the figures of the iterations; all ranks iterate together.

    Parameters
    ----------
    part : RankPart
        With the boundary fixed.
    smoother : Mend
    stop : StoppingCriteria
    sliding : RankSliding, optional
        The boundary if it slides.

    Attributes
    ----------
    points, best_points : (n, 3) float64
        Of the nodes of this rank's part, at the newest iteration and at the best.
    number, kept : int
        Numbers of these iterations.
    decisions : list of str
    outcome : Outcome or None
    """

    part: RankPart
    smoother: Mend
    stop: StoppingCriteria
    sliding: RankSliding | None = None
    decisions: list[str] = field(default_factory=list)
    outcome: Outcome | None = None
    number: int = 0
    kept: int = 0
    seconds: float = 0.0
    move: float = 0.0

    def __post_init__(self) -> None:
        began = perf_counter()
        mesh = self.part.mesh
        self._energy = MeshEnergy(mesh, self.smoother.norm, motion=self.part.motion)
        self._stages = RankStages(self.smoother, self.part, self.sliding)
        self._steps = self._stages.steps(mesh)
        next(self._steps)
        self.points = self.best_points = mesh.points
        quality = measure(mesh.points, mesh.elements)
        self.last, self._start = RankFigures.of(self._energy, quality), self._judged(quality)
        self._best_rank = self._rank(self._start)
        moving = self._energy.nodes if self.sliding is None else self.sliding.nodes
        if not self._energy.ranks.any(moving.size + self._energy.nodes.size > 0):
            self.outcome = Outcome.NOTHING_FREE
        self._setup_seconds = perf_counter() - began
        if self.outcome is None:
            self._end_at_a_limit()

    @property
    def unsound(self) -> bool:
        """The stages ended because the minimum scaled Jacobian was not sound after untangling."""
        return self._stages.unsound

    def __next__(self) -> RankFigures:
        if self.outcome is not None:
            raise StopIteration
        began = perf_counter()
        try:
            step = next(self._steps)
        except StopIteration as end:
            self.outcome = end.value or Outcome.FINISHED
            raise
        self.seconds += perf_counter() - began
        self.number += 1
        self._take(step)
        return self.last

    def close(self) -> None:
        """End the run after the newest iteration; it keeps its result."""
        self._end(self.outcome or Outcome.STOPPED)

    def _end(self, outcome: Outcome | None) -> None:
        """End the run unless the outcome is None, and free what the method holds."""
        self.outcome = outcome
        if outcome is not None:
            self._steps.close()

    def _take(self, step: Step) -> None:
        energy, points = self._energy, np.asarray(step.points)
        moved = largest_norm(points - self.points) / energy.unit
        self.move = energy.ranks.greatest(moved if np.isfinite(moved) else np.inf)
        if not np.isfinite(self.move):
            self._end(Outcome.NOT_FINITE)
            return
        self.points = points
        quality = step.quality if step.quality is not None else measure(points, energy.mesh.elements)
        self.last = RankFigures.of(energy, quality)
        if step.decision:
            self.decisions.append(step.decision)
        rank = self._rank(self._judged(quality))
        if self.stop.keep_last or (rank <= self._best_rank and not step.infeasible):
            self.best_points, self.kept, self._best_rank = points, self.number, rank
        if self.move < self.stop.tolerance and not step.intermediate:
            self._end(Outcome.CONVERGED)
        else:
            self._end_at_a_limit()

    def _end_at_a_limit(self) -> None:
        spent = self._energy.ranks.greatest(self._setup_seconds + self.seconds)  # the clocks of ranks differ
        self._end(self.stop.reached(self.smoother, self.number, spent))

    def _judged(self, quality: ElementQuality) -> ElementQuality:
        """Quality by which the present points are judged, of the hexes that this rank counts."""
        return measure_against_target(self.part.mesh, self.points, quality).of(self.part.counted)

    def _rank(self, now: ElementQuality) -> tuple[float, ...]:
        return self.smoother.rank_on(self._energy.ranks, self._start, now)


def gather_points(part: RankPart, points: np.ndarray, whole: np.ndarray | None) -> np.ndarray | None:
    """Gather the points (n, 3) that each rank owns on rank 0, where `whole` has those of nodes without hexes."""
    comm, own = part.ranks.comm, part.owned
    if comm.rank:
        comm.send(int(own.sum()), dest=0)
        comm.Send(part.nodes[own], dest=0)
        comm.Send(points[own], dest=0)
        return None
    gathered = np.array(whole)
    gathered[part.nodes[own]] = points[own]
    for rank in range(1, comm.size):
        count = comm.recv(source=rank)
        nodes, rows = np.empty(count, part.nodes.dtype), np.empty((count, 3))
        comm.Recv(nodes, source=rank)
        comm.Recv(rows, source=rank)
        gathered[nodes] = rows
    return gathered
