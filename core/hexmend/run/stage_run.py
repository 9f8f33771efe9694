"""One smoother at work: a run goes in legs, one for each stage and one more wherever the method is changed."""

from __future__ import annotations

import logging
from dataclasses import replace
from time import perf_counter

import numpy as np

from hexmend.arrays import as_immutable
from hexmend.iteration import ActiveSet, Iteration, Outcome, StageResult, StoppingCriteria
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import points_like
from hexmend.quality import measure, objective
from hexmend.run.recipe import Stage
from hexmend.smoothers import Smoother

log = logging.getLogger(__name__)

#: An objective still falls if a step lowers what it has above that of cubes by a greater share than the first, and by
#: more than the second share of what one hex of q = 1/2 has above a cube.
_FALLING, _WORTH = 1e-3, 1e-2


class StageRun:
    """A smoother at work from one iteration on, until a limit is reached or it has no further step.

    Parameters
    ----------
    mesh : Mesh
        The run's.
    stage : Stage
    number : int
        Of the stage in its recipe, from 1.
    start : Iteration
        Where the nodes are as it begins.
    after : Iteration
        The run's newest: numbers and seconds go on from it.
    before : StageRun, optional
        The one whose stage it takes over: limits count and iterates are ranked from where that stage began.

    Attributes
    ----------
    at : Iteration
        Where the nodes are.
    last, best : Iteration
        See `Run`.
    since : Iteration
        The run's newest as the stage began.
    outcome : Outcome or None
        None while it goes on.
    setup_seconds : float
    decision : str
        What the method decided at its newest step.
    limits : ActiveSet or None
        What lets the method go no further, as far as it has said so.
    """

    def __init__(
        self, mesh: Mesh, stage: Stage, number: int, start: Iteration, after: Iteration, before: StageRun | None = None
    ):
        self.stage, self.number = stage, number
        self.start, self.after = start, after
        self.since = after if before is None else before.since
        self.last, self.at = after, start
        self.outcome: Outcome | None = None
        self.decision = ""
        self.limits: ActiveSet | None = None
        self._hexes, self._unit = mesh.hexes, mesh.mean_edge_length or 1.0
        self._origin = start if before is None else before._origin
        self._best = start if before is None else before._best
        self._best_rank = self._rank(self._best)
        self._consider(start)
        began = perf_counter()
        self._steps = self.smoother.steps(mesh.keeping_surface().with_points(start.points))
        next(self._steps)
        self.setup_seconds = perf_counter() - began
        if not mesh.free.any() and not self.smoother.movable(mesh).any():
            self.end(Outcome.NOTHING_FREE)
        else:
            self._end_at_a_limit()

    @property
    def smoother(self) -> Smoother:
        """The method at work."""
        return self.stage.smoother

    @property
    def best(self) -> Iteration:
        """See `Run`."""
        return self.at if self.stage.stop.keep_last else self._best

    @property
    def made(self) -> int:
        """Iterations of this leg so far."""
        return self.last.number - self.after.number

    def advance(self) -> Iteration | None:
        """Make a step; None where the method has none left."""
        began = perf_counter()
        try:
            step = next(self._steps)
        except StopIteration as end:
            self.end(end.value or Outcome.FINISHED)
            return None
        seconds = self.last.seconds + perf_counter() - began
        before = self.at
        what = f"{self.smoother.name}: the points of a step"
        points = as_immutable(points_like(step.points, before.points.shape, what))
        moves = points - before.points
        move = float(np.sqrt(np.square(moves).sum(axis=1).max())) / self._unit
        if not np.isfinite(move):
            self.end(Outcome.NOT_FINITE)
            return None
        quality = step.quality if step.quality is not None else measure(points, self._hexes)
        diagnostics = {**step.diagnostics, "stage": self.number, "method": self.smoother.name}
        now = self.last = self.at = Iteration(
            self.last.number + 1, points, quality, seconds, move, diagnostics, step.power or self.smoother.power
        )
        self.decision, self.limits = step.decision, step.limits or self.limits
        if not step.infeasible:
            self._consider(now)
        if (
            self._move(moves, move) < self.stage.stop.tolerance
            and not step.intermediate
            and not self._falling(before, now)
        ):  # Algorithm A.1
            self.end(Outcome.CONVERGED)
        else:
            self._end_at_a_limit()
        return now

    def _move(self, moves: np.ndarray, length: float) -> float:
        """What A.1 compares with the tolerance."""
        return length if self.stage.stop.move == "length" else float(np.abs(moves).max()) / self._unit

    def limit(self, stop: StoppingCriteria) -> None:
        """Go on under other limits."""
        self.stage = Stage(self.smoother, stop)
        self._end_at_a_limit()

    def end(self, outcome: Outcome) -> None:
        """End it here."""
        self.outcome = outcome
        self._steps.close()
        log.info("%s ended: %s", self.smoother.name, outcome.value)

    def as_stage(self, cut: bool = False) -> Stage | None:
        """The stage that does it again by itself; where it was cut off by a change, None if it had not made a step."""
        if cut and not self.made:
            return None
        stop, before, spent = self.stage.stop, self.after.number - self.since.number, self.after.seconds
        most = self.made if cut else max(stop.max_iterations - before, 0)
        left = max(stop.max_seconds - (spent - self.since.seconds), 1e-3) if stop.max_seconds else 0.0
        last = cut or stop.keep_last  # what took over went on from there
        return Stage(self.smoother, replace(stop, max_iterations=most, max_seconds=left, keep_last=last))

    def result(self) -> StageResult:
        """Its record as far as it went."""
        return StageResult(
            stage=self.number,
            method=self.smoother.name,
            parameters=self.smoother.values(),
            stop=self.stage.stop,
            outcome=self.outcome or Outcome.STOPPED,
            first=self.start.number,
            iterations=self.made,
            seconds=self.last.seconds - self.after.seconds,
            setup_seconds=self.setup_seconds,
        )

    def _rank(self, iteration: Iteration) -> tuple[float, ...]:
        return self.smoother.rank(self._origin.quality, iteration.quality)

    def _consider(self, iteration: Iteration) -> None:
        """Take it for the best of the stage if none before it was better."""
        rank = self._rank(iteration)
        if rank <= self._best_rank:
            self._best, self._best_rank = iteration, rank

    def _falling(self, before: Iteration, now: Iteration) -> bool:
        """Whether an optimiser's objective still falls: beside the barrier steps are short, however much they gain."""
        if not self.smoother.optimises:
            return False
        power = now.power  # the step before may have had another objective
        then, later = objective(before.quality, *power), now.objective
        if then is None or later is None:
            return False
        least = power.least * now.quality.q.size
        return then - later > max(_FALLING * (then - least), _WORTH * (power.of(1.0) - power.least))

    def _end_at_a_limit(self) -> None:
        stop, last, since = self.stage.stop, self.last, self.since
        if last.number - since.number >= stop.max_iterations:
            self.end(Outcome.MAX_ITERATIONS)
        elif 0 < stop.max_seconds <= last.seconds - since.seconds:
            self.end(Outcome.MAX_SECONDS)
