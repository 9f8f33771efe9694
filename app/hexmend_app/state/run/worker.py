"""The thread that a smoother runs in, and the mailbox between it and the window."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass

from hexmend.advice import Advice, advise
from hexmend.iteration import Iteration, Result
from hexmend.mesh.mesh import Mesh
from hexmend.quality import summarise
from hexmend.run import Run, StoppingCriteria, iterate
from hexmend.run.breakpoints import Breakpoints, Hit
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import Smoother
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.metric_cache import metric_values
from hexmend_app.state.tasks.task import Task


@dataclass(frozen=True, eq=False)
class IterationFrame:
    """An iteration with what the window shows of it, measured in the worker, and the break-point that it reached."""

    iteration: Iteration
    state: State
    hit: Hit | None = None


class Mailbox:
    """One slot: a new frame takes the place of one that nobody has fetched yet.

    The window is never behind by more than one frame and never keeps a queue of meshes in memory.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._frame: IterationFrame | None = None

    def put(self, frame: IterationFrame) -> None:
        """Leave the newest frame."""
        with self._lock:
            self._frame = frame

    def take(self) -> IterationFrame | None:
        """Fetch the newest frame, once."""
        with self._lock:
            frame, self._frame = self._frame, None
            return frame


class Worker:
    """Runs a smoother or a recipe on one mesh, one iteration at a time as the gate lets it.

    Parameters
    ----------
    mesh : Mesh
    smoother : Smoother or Recipe
    stop : StoppingCriteria, optional
        None for the recipe's own.
    keep : callable
        Called with every iteration, number 0 first, in the thread.

    Attributes
    ----------
    task : Task
        Its result is the run's, or None where it failed.
    mailbox : Mailbox
    last : Frame or None
        The newest.
    changes : list of (int, Stage)
        How the rest of a stage was to be done, with the number of the iteration after which it was.
    prepared : threading.Event
        The method has been set up, or has failed to be.
    advice : Advice or None
        Why the run ended and what to do, once it has.
    """

    def __init__(
        self,
        mesh: Mesh,
        smoother: Smoother | Recipe,
        stop: StoppingCriteria | None,
        keep: Callable[[Iteration], object],
    ):
        self.task = Task(f"smoother {smoother.name}", self._run, yields=True)
        self.mailbox = Mailbox()
        self.last: IterationFrame | None = None
        self.changes: list[tuple[int, Stage]] = []
        self.prepared = threading.Event()
        self.advice: Advice | None = None
        self.metrics: frozenset[str] = frozenset()  # what the window will ask of every iteration
        self.breakpoints = Breakpoints()
        self._order = (mesh, smoother, stop)
        self._keep = keep
        self._gate = threading.Condition()
        self._granted: float = 0  # iterations that may still be made; infinite while running
        self._waits = False  # at the gate
        self._change: Stage | None = None  # how the rest of the stage is to be done

    def grant(self, iterations: float) -> None:
        """Let that many further iterations pass; infinity runs on, 0 pauses after the one at hand."""
        with self._gate:
            self._granted = iterations
            self._gate.notify_all()

    def grant_more(self, iterations: int) -> None:
        """Let so many further iterations pass: steps."""
        with self._gate:
            self._granted = iterations if self._granted == float("inf") else max(self._granted, 0) + iterations
            self._gate.notify_all()

    def change(self, stage: Stage) -> None:
        """Do the rest of the stage at hand otherwise, from the next iteration on."""
        with self._gate:
            self._change = stage

    def end(self) -> None:
        """End the run after the iteration at hand, paused or not."""
        with self._gate:
            self.task.cancel()
            self._gate.notify_all()

    @property
    def waiting(self) -> bool:
        """True if the worker has used up its grant and finished its last iteration."""
        return self._waits and self._granted <= 0

    def _run(self, _: Task) -> Result:
        try:
            mesh, smoother, stop = self._order
            run = iterate(mesh, smoother, stop)
            self._keep(run.start)
            self.prepared.set()
            while self._may_continue(run):
                before = run.last
                iteration = next(run, None)
                if iteration is not None:
                    self._keep(iteration)
                    self._report(iteration, self._hit(before, iteration))
            run.close()
            if run.best is not run.last:
                self._report(run.best)
            result = run.result()
            self.advice = advise(result)
            return result
        finally:
            self.prepared.set()

    def _hit(self, before: Iteration, iteration: Iteration) -> Hit | None:
        """The break-point that an iteration reaches, at which the run pauses."""
        mesh, breakpoints = self._order[0], self.breakpoints
        hit = breakpoints.hit(before, iteration, mesh.mean_edge_length or 1.0) if breakpoints.any else None
        if hit is not None:
            self.grant(0)
        return hit

    def _report(self, iteration: Iteration, hit: Hit | None = None) -> None:
        moved = self._order[0].with_points(iteration.points)
        for metric in self.metrics:
            metric_values(metric, moved.points, moved.hexes, iteration.quality)
        self.last = IterationFrame(iteration, State(moved, iteration.quality, summarise(moved, iteration.quality)), hit)
        self.mailbox.put(self.last)

    def _may_continue(self, run: Run) -> bool:
        with self._gate:
            self._waits = True
            while run.outcome is None and not self.task.cancelled.is_set() and self._granted <= 0:
                self._gate.wait()
            self._waits = False
            self._granted -= 1
            change, self._change = self._change, None
            ended = self.task.cancelled.is_set()
        if change is not None and run.outcome is None and not ended:
            self.changes.append((run.last.number, change))
            run.switch_method(change.smoother, change.stop)  # which may take a while: the window must not wait for it
        return run.outcome is None and not ended
