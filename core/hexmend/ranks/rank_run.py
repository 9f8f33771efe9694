"""The run of mend on a mesh that is divided among ranks: its iterations, limits, and the best of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from time import perf_counter

import numpy as np

from hexmend.arrays import largest_norm
from hexmend.boundary import SlidingBoundary
from hexmend.energy import ObjectiveNorm
from hexmend.errors import ParameterError
from hexmend.iteration import Outcome, Step, StoppingCriteria
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.floors.movable_hexes import MovableHexes
from hexmend.quality import ElementQuality, measure, measure_against_target
from hexmend.ranks.rank_energy import RankEnergy
from hexmend.ranks.rank_part import RankPart
from hexmend.smoothers import Smoother
from hexmend.smoothers.base import Steps, objective_of_sound
from hexmend.smoothers.mend.balance import BALANCE, balance
from hexmend.smoothers.mend.maxmin import MAXMIN
from hexmend.smoothers.mend.mend import Mend
from hexmend.smoothers.mend.stages import Stages

_UNSOUND = "A least scaled Jacobian that is not sound is not raised on several ranks yet: do so in one process."


def check_distributed(smoother: Smoother, mesh: Mesh) -> None:
    """Raise `ParameterError` for what several ranks cannot do."""
    remedy = "run it in one process, without mpiexec"
    if not isinstance(smoother, Mend):
        raise ParameterError(f"{smoother.title} does not run on several MPI ranks yet, mend does: {remedy}")
    if smoother.goal not in ("shape", "balanced") or smoother.guard:
        which = "guard = true" if smoother.guard else f"goal = {smoother.goal}"
        raise ParameterError(f"{which} does not run on several MPI ranks yet, goals shape and balanced do: {remedy}")
    if smoother.slides_on(mesh) or mesh.linear_motion is not None:
        raise ParameterError(f"nodes that slide do not run on several MPI ranks yet, a fixed boundary does: {remedy}")


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


class RankStages(Stages):
    """Stages of mend on a part: untangling, the optimum of shape, and what the goal balanced asks for."""

    def __init__(self, settings: Mend, part: RankPart):
        super().__init__(settings)
        self._part = part

    def steps(self, mesh: Mesh) -> Steps:
        yield Step(mesh.points)
        energy = self._energy(mesh, self.settings.first_norm_on(mesh))
        balances = self.settings.balances
        shape = yield from self._shape(mesh, energy, balances)
        if not balances:
            return shape.outcome
        energy = self._sound_energy(mesh, shape.points, None)
        hexes, x = MovableHexes(energy), energy.to_edge_units(shape.points)
        if energy.ranks.least(float(hexes.jacobians(x).min(initial=np.inf))) < MAXMIN.barrier_safe:
            yield Step(shape.points, decision=_UNSOUND)
            return Outcome.NO_IMPROVEMENT
        balanced = yield from balance(energy, shape.points, mesh.points)
        yield Step(balanced.points, decision=balanced.message, intermediate=True)
        return Outcome.NO_IMPROVEMENT

    def _energy(self, mesh: Mesh, norm: ObjectiveNorm, sliding: SlidingBoundary | None = None) -> RankEnergy:
        return RankEnergy(self._part, norm)


@dataclass
class RankRun(Iterator[RankFigures]):
    """Iterator over the figures of the iterations; all ranks iterate together.

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
    decisions: list[str] = field(default_factory=list)
    outcome: Outcome | None = None
    number: int = 0
    kept: int = 0
    seconds: float = 0.0
    move: float = 0.0

    def __post_init__(self) -> None:
        mesh = self.part.mesh
        self._energy = RankEnergy(self.part, self.smoother.norm)
        self._steps = RankStages(self.smoother, self.part).steps(mesh)
        next(self._steps)
        self.points = self.best_points = mesh.points
        self.start = self.last = self._figures(measure(mesh.points, mesh.hexes), mesh.points)
        self._best_rank = self._rank(self.start)
        if not self._energy.ranks.any(self._energy.nodes.size > 0):
            self.outcome = Outcome.NOTHING_FREE

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

    def _take(self, step: Step) -> None:
        energy, points = self._energy, np.asarray(step.points)
        moved = largest_norm(points - self.points) / energy.unit
        self.move = energy.ranks.greatest(moved if np.isfinite(moved) else np.inf)
        if not np.isfinite(self.move):
            self.outcome = Outcome.NOT_FINITE
            return
        self.points = points
        quality = step.quality if step.quality is not None else measure(points, energy.mesh.hexes)
        self.last = self._figures(quality, points)
        if step.decision:
            self.decisions.append(step.decision)
        rank = self._rank(self.last)
        if self.stop.keep_last or rank <= self._best_rank:
            self.best_points, self.kept, self._best_rank = points, self.number, rank
        if self.move < self.stop.tolerance and not step.intermediate:
            self.outcome = Outcome.CONVERGED
        else:  # the clocks of ranks differ
            self.outcome = self.stop.reached(self.smoother, self.number, energy.ranks.greatest(self.seconds))

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


def gather_points(part: RankPart, points: np.ndarray, whole: Callable[[], np.ndarray]) -> np.ndarray | None:
    """Gather the points (n, 3) that each rank owns on rank 0, which has all others from `whole`; None elsewhere."""
    comm, own = part.ranks.comm, part.owned
    if comm.rank:
        comm.send(int(own.sum()), dest=0)
        comm.Send(part.nodes[own], dest=0)
        comm.Send(points[own], dest=0)
        return None
    gathered = np.array(whole())
    gathered[part.nodes[own]] = points[own]
    for rank in range(1, comm.size):
        count = comm.recv(source=rank)
        nodes, rows = np.empty(count, part.nodes.dtype), np.empty((count, 3))
        comm.Recv(nodes, source=rank)
        comm.Recv(rows, source=rank)
        gathered[nodes] = rows
    return gathered
