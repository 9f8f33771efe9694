"""The run of mend on a mesh that is divided among ranks: its iterations, limits, and the best of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from time import perf_counter

import numpy as np

from hexmend.arrays import largest_norm
from hexmend.energy import ObjectiveNorm
from hexmend.iteration import Outcome, Step, StoppingCriteria
from hexmend.quality import ElementQuality, measure, measure_against_target
from hexmend.ranks.rank_energy import RankEnergy
from hexmend.ranks.rank_part import RankPart
from hexmend.ranks.rank_sliding import RankSliding
from hexmend.ranks.rank_stages import RankStages
from hexmend.smoothers.base import objective_of_sound
from hexmend.smoothers.mend.balance import BALANCE
from hexmend.smoothers.mend.mend import Mend


@dataclass(frozen=True)
class RankFigures:
    """Figures of all hexes of an iterate, and of those by which it is judged, against a target if there is one."""

    inverted: int
    q_min: float
    q_mean: float
    jacobian_min: float
    judged_q_min: float
    objective: float

    @classmethod
    def of(cls, energy: RankEnergy, quality: ElementQuality, points: np.ndarray, norm: ObjectiveNorm) -> RankFigures:
        """Measure a mesh with these points (n, 3), whose hexes have this quality."""
        ranks, own = energy.ranks, energy.counted
        judged = measure_against_target(energy.mesh, points, quality)
        counted = ElementQuality(judged.q[own], judged.sigma[own], judged.scaled_jacobian[own], judged.eta[own])
        return cls(
            energy.count(quality.inverted),
            ranks.least(float(quality.q.min(initial=np.inf))),
            energy.mean(quality.q),
            ranks.least(float(quality.scaled_jacobian.min(initial=np.inf))),
            ranks.least(float(judged.q.min(initial=np.inf))),
            ranks.sum(objective_of_sound(counted, norm)),
        )


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
        mesh = self.part.mesh
        self._energy = RankEnergy(self.part, self.smoother.norm)
        self._stages = RankStages(self.smoother, self.part, self.sliding)
        self._steps = self._stages.steps(mesh)
        next(self._steps)
        self.points = self.best_points = mesh.points
        self.start = self.last = self._figures(measure(mesh.points, mesh.hexes), mesh.points)
        self._best_rank = self._rank(self.start)
        moving = self._energy.nodes if self.sliding is None else self.sliding.nodes
        if not self._energy.ranks.any(moving.size + self._energy.nodes.size > 0):
            self.outcome = Outcome.NOTHING_FREE

    @property
    def unsound(self) -> bool:
        """The stages ended because the least scaled Jacobian was not sound after untangling."""
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
        quality = step.quality if step.quality is not None else measure(points, energy.mesh.hexes)
        self.last = self._figures(quality, points)
        if step.decision:
            self.decisions.append(step.decision)
        rank = self._rank(self.last)
        if self.stop.keep_last or (rank <= self._best_rank and not step.infeasible):
            self.best_points, self.kept, self._best_rank = points, self.number, rank
        if self.move < self.stop.tolerance and not step.intermediate:
            self._end(Outcome.CONVERGED)
        else:  # the clocks of ranks differ
            self._end(self.stop.reached(self.smoother, self.number, energy.ranks.greatest(self.seconds)))

    def _figures(self, quality: ElementQuality, points: np.ndarray) -> RankFigures:
        return RankFigures.of(self._energy, quality, points, self.smoother.norm)

    def _rank(self, now: RankFigures) -> tuple[float, ...]:
        """Sort key of an iterate, as of `Mend.rank`, for sound meshes; of others the inverted hexes come first."""
        start, share = self.start, 1.0 if self.part.mesh.element_target is None else 1 - BALANCE.target_fall
        lower = (now.judged_q_min < share * start.judged_q_min, now.jacobian_min < share * start.jacobian_min)
        if self.smoother.balances:
            falls = start.inverted == 0 and (any(lower) or now.q_mean < start.q_mean)
            return now.inverted, falls
        return now.inverted, all(lower), now.objective > start.objective


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
