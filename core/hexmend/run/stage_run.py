"""The run of one smoother: a run has one for each stage, and a further one after each change of the method."""

from __future__ import annotations

import logging
from dataclasses import replace
from time import perf_counter

import numpy as np

from hexmend.arrays import BLOCK, as_immutable, largest_norm
from hexmend.energy.target import node_sizes
from hexmend.iteration import ActiveSet, Iteration, Outcome, StageResult, StoppingCriteria
from hexmend.kernels import release_free_memory, return_freed_arrays
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import points_like
from hexmend.quality import ElementQuality, measure, measure_against_target
from hexmend.run.recipe import Stage
from hexmend.smoothers import Smoother
from hexmend.smoothers.constrained_steps import constrained_steps

log = logging.getLogger(__name__)

#: An objective still falls if a step lowers its excess over that of cubes by more than this share ...
_MIN_RELATIVE_FALL = 1e-3

#: ... and by more than this share of the excess of a single hex of q = 1/2.
_MIN_FALL = 1e-2

#: Number of hexes from which on memory is freed as early as possible: qualities of iterations are measured again rather
#: than kept during a step.
_LARGE = 250_000


class StageRun:
    """Run of one smoother from a given iteration until a limit is reached or it has no further step.

    Parameters
    ----------
    mesh : Mesh
        The mesh of the run.
    stage : Stage
    number : int
        Number of the stage in the recipe, from 1.
    start : Iteration
        The iteration whose points it begins with.
    run_last : Iteration
        The run's newest iteration, from which numbers and seconds are counted on.
    predecessor : StageRun, optional
        The stage run that it replaces: limits are counted and iterations ranked from the beginning of that stage.

    Attributes
    ----------
    current : Iteration
        The iteration with the present points.
    last, best : Iteration
        See `Run`.
    stage_start : Iteration
        The run's newest iteration at the beginning of the stage.
    outcome : Outcome or None
        None until it ends.
    setup_seconds : float
    start_surface : SurfaceObjective or None
        Term of the objective over boundary quads, if they count, at the points of `start`.
    decision : str
        The method's decision at its newest step, as a sentence.
    active : ActiveSet or None
        The constraints that stop the method, if it reports them.
    target : Target or None
        Target of the hexes.
    """

    def __init__(
        self,
        mesh: Mesh,
        stage: Stage,
        number: int,
        start: Iteration,
        run_last: Iteration,
        predecessor: StageRun | None = None,
    ):
        began = perf_counter()
        self.stage, self.number = stage, number
        self.start, self.run_last = start, run_last
        self.stage_start: Iteration = run_last if predecessor is None else predecessor.stage_start
        self.last, self.current = run_last, start
        self.outcome: Outcome | None = None
        self.decision = ""
        self.active: ActiveSet | None = None
        self.target = mesh.element_target
        self._mesh, self._unit = mesh, mesh.mean_edge_length or 1.0
        self._is_large = mesh.n_elements >= _LARGE
        if self._is_large:
            return_freed_arrays()
            release_free_memory()
        self._node_sizes = node_sizes(mesh)
        self._origin: Iteration = start if predecessor is None else predecessor._origin
        self._best: Iteration = start if predecessor is None else predecessor._best
        self._origin_quality = measure_against_target(mesh, self._origin.points, self._origin.quality)
        self._best_rank = self._rank(self._best)
        self._update_best(start)
        setup_began = perf_counter()
        self._steps = constrained_steps(self.smoother, mesh.keeping_surface().with_points(start.points))
        self.start_surface = next(self._steps).surface
        self.setup_seconds = perf_counter() - setup_began
        self._spent_before = 0.0 if predecessor is None else predecessor._spent
        self._spent: float = self._spent_before + perf_counter() - began  # seconds that count for the time limit
        if not mesh.free.any() and not self.smoother.movable(mesh).any():
            self.end(Outcome.NOTHING_FREE)
        else:
            self._end_at_a_limit()

    @property
    def smoother(self) -> Smoother:
        """The method."""
        return self.stage.smoother

    @property
    def best(self) -> Iteration:
        """See `Run`."""
        return self.current if self.stage.stop.keep_last else self._best

    @property
    def n_iterations(self) -> int:
        """Number of iterations so far."""
        return self.last.number - self.run_last.number

    def advance(self) -> Iteration | None:
        """Make a step; return the new iteration, or None if the method has no further step."""
        began = perf_counter()
        if self._is_large:  # a step needs the memory
            for iteration in (self._origin, self._best, self.current):
                iteration.quality.release()
        try:
            step = next(self._steps)
        except StopIteration as end:
            self.end(end.value or Outcome.FINISHED)
            return None
        seconds = self.last.seconds + perf_counter() - began
        before = self.current
        label = f"{self.smoother.name}: the points of a step"
        points = self._moved(points_like(step.points, before.points.shape, label))
        move, size = self._sizes_of_moves(before.points, points)
        if not np.isfinite(move):
            self.end(Outcome.NOT_FINITE)
            return None
        quality = step.quality
        if quality is None or self._mesh.mid_nodes is not None:  # methods measure the corners alone
            quality = measure(points, self._mesh.elements, self._mesh.mid_nodes)
        quality.made_from(points, self._mesh.elements, self._mesh.mid_nodes)
        diagnostics = {**step.diagnostics, "stage": self.number, "method": self.smoother.name}
        judged = measure_against_target(self._mesh, points, quality)
        number, norm = self.last.number + 1, step.norm or self.smoother.norm
        now = self.last = self.current = Iteration(
            number, points, quality, seconds, move, diagnostics, norm, judged, step.surface
        )
        self.decision, self.active = step.decision, step.active or self.active
        if step.begins:
            self._origin_quality, self._best = self._judged_quality(now), now
            self._best_rank = self._rank(now)
        elif not step.infeasible:
            self._update_best(now)
        self._spent += perf_counter() - began
        small = size < self.stage.stop.tolerance  # Algorithm A.1
        if small and not step.intermediate and (self.stage.stop.moves_only or not self._still_falls(before, now)):
            self.end(Outcome.CONVERGED)
        else:
            self._end_at_a_limit()
        return now

    def _moved(self, points: np.ndarray) -> np.ndarray:
        """Return points (n, 3) of a step, which moves corners, with the mid-nodes moved with the corners; immutable."""
        mesh = self._mesh
        if mesh.has_mid_nodes:
            with np.errstate(invalid="ignore"):  # points that are not finite end the run
                points = mesh.with_mid_nodes_moved(points)
        return as_immutable(points)

    def _sizes_of_moves(self, before: np.ndarray, after: np.ndarray) -> tuple[float, float]:
        """Return the longest move from points (n, 3) to others, and the largest as the limits measure it.

        The first is in mean edge lengths, the second too or, with a target, in lengths at each node.
        """
        longest, largest, sizes = 0.0, 0.0, self._node_sizes
        for first in range(0, len(before), BLOCK):
            rows = slice(first, first + BLOCK)
            moves = after[rows] - before[rows]
            length = largest_norm(moves)
            if not np.isfinite(length):
                return length, length
            moves /= sizes[rows, None] if isinstance(sizes, np.ndarray) else sizes
            by_length = self.stage.stop.move == "length"
            size = largest_norm(moves) if by_length else float(max(moves.max(), -moves.min()))
            longest, largest = max(longest, length), max(largest, size)
        return longest / self._unit, largest

    def set_limits(self, stop: StoppingCriteria) -> None:
        """Continue with other limits."""
        self.stage = Stage(self.smoother, stop)
        self._end_at_a_limit()

    def end(self, outcome: Outcome) -> None:
        """End the run of the stage."""
        self.outcome = outcome
        self._steps.close()
        log.info("%s ended: %s", self.smoother.name, outcome.value)

    def as_stage(self, cut: bool = False) -> Stage | None:
        """Return the stage that repeats this run alone.

        Parameters
        ----------
        cut : bool
            True if a change of the method ended it; None is returned if it made no step until then.
        """
        if cut and not self.n_iterations:
            return None
        stop, before = self.stage.stop, self.run_last.number - self.stage_start.number
        most = self.n_iterations if cut else max(stop.limit_of(self.smoother) - before, 0)
        left = max(stop.max_seconds - self._spent_before, 1e-3) if stop.max_seconds else 0.0
        last = cut or stop.keep_last  # its successor continued from the last iteration
        return Stage(self.smoother, replace(stop, max_iterations=most, max_seconds=left, keep_last=last))

    def result(self) -> StageResult:
        """Return the result so far."""
        return StageResult(
            stage=self.number,
            method=self.smoother.name,
            parameters=self.smoother.values(),
            stop=self.stage.stop,
            outcome=self.outcome or Outcome.STOPPED,
            first=self.start.number,
            iterations=self.n_iterations,
            seconds=self.last.seconds - self.run_last.seconds,
            setup_seconds=self.setup_seconds,
        )

    def _rank(self, iteration: Iteration) -> tuple[float, ...]:
        rank = self.smoother.rank(self._origin_quality, self._judged_quality(iteration))
        return *rank, *self.smoother.rank_by_points(self._mesh.elements, iteration.points)

    def _judged_quality(self, iteration: Iteration) -> ElementQuality:
        """Quality of an iteration against the target of this stage; earlier stages may have had another one."""
        if iteration.number > self.run_last.number:
            return iteration.judged_quality
        return measure_against_target(self._mesh, iteration.points, iteration.quality)

    def _update_best(self, iteration: Iteration) -> None:
        """Make the iteration the best of the stage unless an earlier one is better."""
        rank = self._rank(iteration)
        if rank <= self._best_rank:
            self._best, self._best_rank = iteration, rank

    def _still_falls(self, before: Iteration, now: Iteration) -> bool:
        """Return True if an optimiser's objective still falls: near the barrier steps are short but gain much."""
        if not self.smoother.optimises:
            return False
        norm = now.norm  # the previous step may have had another objective
        surface = self.start_surface if before is self.start else before.surface
        judged = replace(before, target_quality=self._judged_quality(before), surface=surface)
        then, later = judged.objective_by(norm), now.objective
        if then is None or later is None:
            return False
        squares = 0.0 if now.surface is None else now.surface.square_value(norm)
        excess = then - norm.cube_value * now.quality.q.size - squares
        least = max(_MIN_RELATIVE_FALL * excess, _MIN_FALL * (norm.contribution(1.0) - norm.cube_value))
        return then - later > least

    def _end_at_a_limit(self) -> None:
        count = self.last.number - self.stage_start.number
        outcome = self.stage.stop.reached(self.smoother, count, self._spent)
        if outcome is not None:
            self.end(outcome)
