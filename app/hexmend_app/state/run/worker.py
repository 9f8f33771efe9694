"""Worker thread of a run, and the mailbox that passes its iterations to the window."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass, replace

from hexmend.advice import Advice, advise
from hexmend.iteration import Iteration, Outcome, Result
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules import MotionRules
from hexmend.mesh.rules.resolution import with_more_rules
from hexmend.run import Run, StoppingCriteria, iterate
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import Smoother
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.mesh.metric_cache import metric_values
from hexmend_app.state.run.breakpoints import BreakpointHit, Breakpoints
from hexmend_app.state.tasks.task import Task


@dataclass(frozen=True, eq=False)
class IterationFrame:
    """An iteration, its state, measured in the worker, and the breakpoint that it reached."""

    iteration: Iteration
    state: MeasuredMesh
    hit: BreakpointHit | None = None


#: Seconds after which a worker that waits for its frame to be shown looks whether it still has to.
_WAIT = 0.05


class Mailbox:
    """Slot for one frame, which a newer frame replaces: the window is never behind, and no meshes queue up."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._frame: IterationFrame | None = None

    def put(self, frame: IterationFrame) -> None:
        """Replace the frame by a newer one."""
        with self._changed:
            self._frame = frame

    def take(self) -> IterationFrame | None:
        """Remove and return the newest frame; None if there is no new one."""
        with self._changed:
            frame, self._frame = self._frame, None
            self._changed.notify_all()
            return frame

    def wait_until_taken(self, still: Callable[[], bool]) -> None:
        """Wait until there is no frame, as long as a function returns True."""
        with self._changed:
            while self._frame is not None and still():
                self._changed.wait(_WAIT)


class Worker:
    """Runs a smoother or a recipe on one mesh in a thread, as many iterations as remain.

    Parameters
    ----------
    mesh : Mesh
    smoother : Smoother or Recipe
    stop : StoppingCriteria, optional
        None for those of a recipe.
    record : callable
        Called in the thread with every iteration, from number 0.
    rules : MotionRules, optional
        Rules of motion of the run; the meshes of its frames have none.

    Attributes
    ----------
    task : Task
        Its result is the `Result` of the run; None if the run failed.
    mailbox : Mailbox
    last : IterationFrame or None
        The newest frame.
    recipe : Recipe or None
        What repeats the run; None until it has ended.
    prepared : threading.Event
        Set when the method has been set up, or its set-up has failed.
    advice : Advice or None
        Why the run ended and what to do; None until it has ended.
    metrics : frozenset of str
        Metrics to compute for every iteration.
    breakpoints : Breakpoints
    shows_every : bool
        The worker waits until an iteration is shown before it makes the next.
    better : int or None
        Number of an iteration that the method ranks higher than the last, which a stopped run keeps.
    """

    def __init__(
        self,
        mesh: Mesh,
        smoother: Smoother | Recipe,
        stop: StoppingCriteria | None,
        record: Callable[[Iteration], object],
        rules: MotionRules | None = None,
    ):
        self.task = Task(f"smoother {smoother.name}", self._run, yields=True)
        self.mailbox = Mailbox()
        self.last: IterationFrame | None = None
        self.recipe: Recipe | None = None
        self.prepared = threading.Event()
        self.advice: Advice | None = None
        self.metrics: frozenset[str] = frozenset()
        self.breakpoints = Breakpoints()
        self.shows_every = False
        self.better: int | None = None
        self._inputs = (mesh, smoother, stop)
        self._rules = rules
        self._record = record
        self._gate = threading.Condition()
        self._remaining: float = 0  # remaining iterations; infinite while running
        self._waits = False  # for more iterations
        self._change: Stage | None = None  # for the rest of the current stage

    def set_remaining(self, iterations: float) -> None:
        """Set the number of further iterations: infinity to run, 0 to pause after the current one."""
        with self._gate:
            self._remaining = iterations
            self._gate.notify_all()

    def add_remaining(self, iterations: int) -> None:
        """Add to the number of further iterations."""
        with self._gate:
            self._remaining = iterations if self._remaining == float("inf") else max(self._remaining, 0) + iterations
            self._gate.notify_all()

    def change(self, stage: Stage) -> None:
        """Replace the rest of the current stage from the next iteration on."""
        with self._gate:
            self._change = stage

    def end(self) -> None:
        """End the run after the current iteration, paused or not."""
        with self._gate:
            self.task.cancel()
            self._gate.notify_all()

    @property
    def waiting(self) -> bool:
        """True if no iterations remain and the last one is finished."""
        with self._gate:
            return self._waits and self._remaining <= 0

    def _run(self, _: Task) -> Result:
        try:
            mesh, smoother, stop = self._inputs
            if self._rules and not isinstance(smoother, Recipe):
                mesh = with_more_rules(mesh, self._rules)
            run = iterate(mesh, smoother, stop)
            self._record(run.start)
            self.prepared.set()
            while self._may_continue(run):
                before = run.last
                iteration = next(run, None)
                if iteration is not None:
                    self._record(iteration)
                    self._report(iteration, self._hit(before, iteration))
            if run.outcome is None and run.best is not run.last:
                self.better = run.best.number
            run.close(keep_last=True)
            if run.best is not run.last:
                self._report(run.best)
            result = run.result()
            self.advice = advise(result)
            self.recipe = _repeating(run, result, self._rules)
            return result
        finally:
            self.prepared.set()

    def _hit(self, before: Iteration, iteration: Iteration) -> BreakpointHit | None:
        """Return the breakpoint that an iteration reaches, and pause; None if it reaches none."""
        mesh, breakpoints = self._inputs[0], self.breakpoints
        hit = breakpoints.hit(before, iteration, mesh.mean_edge_length or 1.0) if breakpoints.any else None
        if hit is not None:
            self.set_remaining(0)
        return hit

    def _report(self, iteration: Iteration, hit: BreakpointHit | None = None) -> None:
        moved = self._inputs[0].with_points(iteration.points)
        for metric in self.metrics:
            metric_values(metric, moved, iteration.quality)
        self.mailbox.wait_until_taken(lambda: self.shows_every and not self.task.cancelled.is_set())
        self.last = IterationFrame(iteration, MeasuredMesh.of(moved, iteration.quality), hit)
        self.mailbox.put(self.last)

    def _may_continue(self, run: Run) -> bool:
        with self._gate:
            self._waits = True
            while run.outcome is None and not self.task.cancelled.is_set() and self._remaining <= 0:
                self._gate.wait()
            self._waits = False
            self._remaining -= 1
            change, self._change = self._change, None
            ended = self.task.cancelled.is_set()
        if change is not None and run.outcome is None and not ended:
            run.switch_method(change.smoother, change.stop)  # may take long: outside the lock, so that nobody waits
        return run.outcome is None and not ended


def _repeating(run: Run, result: Result, rules: MotionRules | None) -> Recipe:
    """Return the recipe that repeats a run; one that was cut short or changed ends at the iteration that was kept."""
    work = run.smoother if isinstance(run.smoother, Recipe) else Recipe.of(run.recipe.stages[0], rules=rules)
    if result.outcome not in (Outcome.STOPPED, Outcome.MAX_SECONDS) and len(result.stages) <= len(work.stages):
        return work
    left, stages = result.kept, list[Stage]()
    begun = [one for one in result.stages if one.iterations]
    for stage, done in zip(run.recipe.stages, begun, strict=False):
        if left <= done.iterations:
            stop = replace(stage.stop, max_iterations=left, max_seconds=0.0, keep_last=True)
            return Recipe.of(*stages, replace(stage, stop=stop), rules=work.rules)
        stages.append(stage)
        left -= done.iterations
    return work
