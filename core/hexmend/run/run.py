"""The only loop: a smoother's steps become iterations with clocks, figures, stop conditions and an outcome."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from hexmend.aliases import reads_old_names
from hexmend.boundary import SurfaceChange, surface_change
from hexmend.boundary.features import FEATURE_ANGLE
from hexmend.iteration import Iteration, Outcome, Result, StoppingCriteria
from hexmend.mesh.mesh import Mesh
from hexmend.quality import Summary, describe_regressions, measure, regressions, summarise
from hexmend.run.messages import describe_change, format_iterations, kept_message
from hexmend.run.recipe import Recipe, Stage
from hexmend.run.stage_run import StageRun
from hexmend.smoothers import METHODS, Smoother


@reads_old_names
class Run(Iterator[Iteration]):
    """A smoother or a recipe at work on a mesh: an iterator of iterations that knows its record and its outcome.

    The stages of a recipe follow one another in one numbering, one clock and one history, each from what the stage
    before it reached; one that has nothing to do is passed over.

    Parameters
    ----------
    mesh : Mesh
    smoother : Smoother or Recipe
    stop : StoppingCriteria, optional
        The defaults for a smoother; for a recipe, in place of the limits of every stage.

    Attributes
    ----------
    mesh, smoother
        As given.
    start : Iteration
        Number 0: the mesh as given.
    last : Iteration
        The newest.
    best : Iteration
        The one that is the run's result: the best of the stage at hand by the rank of the method at work, of equals
        the last; the last in any case under `StoppingCriteria.keep_last`.
    history : list of dict
        `Iteration.row` of every iteration so far, number 0 first.
    outcome : Outcome or None
        None while the run goes on; then that of the last stage.
    decisions : list of str
        What was decided on the way, in sentences.
    """

    def __init__(self, mesh: Mesh, smoother: Smoother | Recipe, stop: StoppingCriteria | None = None):
        self.mesh = mesh
        self.smoother = smoother
        self._stages = _stages(smoother, stop)
        diagnostics = {"stage": 1, "method": self._stages[0].smoother.name}
        quality = measure(mesh.points, mesh.hexes)
        self.start = Iteration(0, mesh.points, quality, 0.0, 0.0, diagnostics, self._stages[0].smoother.power)
        self.history = [self.start.row()]
        self.outcome: Outcome | None = None
        self.decisions: list[str] = []
        self._stage_runs = [StageRun(mesh, self._stages[0], 1, self.start, self.start)]
        self._end_if_done()

    def __next__(self) -> Iteration:
        while self.outcome is None:
            if self._stage_run.outcome is not None:
                self._begin_next_stage()
                continue
            iteration = self._stage_run.advance()
            if iteration is not None:
                self.history.append(iteration.row())
                if self._stage_run.decision:
                    self.decisions.append(self._stage_run.decision)
            self._end_if_done()
            if iteration is not None:
                return iteration
        raise StopIteration

    def switch_method(self, smoother: Smoother | str, stop: StoppingCriteria | None = None) -> None:
        """Do the rest of the stage at hand by another method, with other values or under other limits.

        It goes on from the newest iteration, where the nodes are. A stage that has just ended goes on too, if its new
        limits let it. What has been decided says so; the record names each method.

        Parameters
        ----------
        smoother : Smoother or str
        stop : StoppingCriteria, optional
            Limits of the stage as a whole, counted from where it began; its own so far if None.

        Raises
        ------
        ValueError
            Where the run has ended.
        """
        if self.outcome is not None:
            raise ValueError("the run has ended, so that nothing is left to change: begin another from its result")
        old = self._stage_run
        new = Stage(METHODS[smoother]() if isinstance(smoother, str) else smoother, stop or old.stage.stop)
        if new == old.stage:
            return
        self.decisions.append(f"After iteration {self.last.number}: {describe_change(old.stage, new)}.")
        if new.smoother == old.smoother and old.outcome is None:
            old.limit(new.stop)
        else:
            stage_run = StageRun(self.mesh, new, old.number, old.at, self.last, old)
            if old.outcome is None:
                old.end(Outcome.STOPPED)
            self._stage_runs.append(stage_run)
        self._end_if_done()

    def close(self) -> None:
        """End the run where it is; what was reached stands."""
        if self.last.number > self.history[-1]["iteration"]:  # Ctrl-C came as the iteration was being recorded
            self.history.append(self.last.row())
        if self.outcome is None:
            if self._stage_run.outcome is None:
                self._stage_run.end(Outcome.STOPPED)
            self.outcome = Outcome.STOPPED

    @property
    def last(self) -> Iteration:
        """See the class."""
        return self._stage_run.last

    @property
    def best(self) -> Iteration:
        """See the class."""
        return self._stage_run.best

    @property
    def stage(self) -> Stage:
        """The method at work and its limits."""
        return self._stage_run.stage

    @property
    def stage_number(self) -> int:
        """Number of the stage at hand, from 1."""
        return self._stage_run.number

    @property
    def stage_count(self) -> int:
        """Number of stages."""
        return len(self._stages)

    @property
    def limit(self) -> int:
        """The most iterations that it can come to as things stand."""
        at = self._stage_run
        here = self.last.number if at.outcome is not None else at.since.number + at.stage.stop.max_iterations
        return here + sum(stage.stop.max_iterations for stage in self._remaining_stages)

    @property
    def setup_seconds(self) -> float:
        """What the methods' preparations took so far."""
        return sum(one.setup_seconds for one in self._stage_runs)

    @property
    def recipe(self) -> Recipe:
        """What was run and what is still to come, as a recipe that does it again."""
        changed = [one.as_stage(cut=later.number == one.number) for one, later in pairwise(self._stage_runs)]
        done = [stage for stage in changed if stage is not None]
        title = self.smoother.title if isinstance(self.smoother, Recipe) else ""
        return Recipe.of(*done, self._stage_run.as_stage(), *self._remaining_stages, title=title)

    @property
    def message(self) -> str:
        """What has been reached, why the run ended, and in what the mesh is worse than it was, in sentences."""
        return self._message(*self._summaries())

    def _message(self, before: Summary, after: Summary) -> str:
        at, inverted = self.last, self.best.quality.n_inverted
        said = self.outcome.value if self.outcome is not None else "Running."
        left = f"{inverted:,} hex{'es' * (inverted != 1)} still inverted" if inverted else "no hex is inverted"
        move = f"the last one moved a node by {at.largest_move:.2g} mean edge lengths at most; " if at.number else ""
        decided = self.decisions
        if not self._kept_last and decided and decided[-1] == self._stage_run.decision:
            decided = decided[:-1]  # it says how the last one is
        words = [said, f"{format_iterations(at.number)} in {at.seconds:.3g} s; {move}{left}.", *decided]
        if not self._kept_last:
            words.append(kept_message(self.best.number))
        instead = "" if inverted else self.stage.smoother.regression_hint(regressions(before, after))
        return " ".join(filter(None, [*words, describe_regressions(before, after), instead]))

    @property
    def _kept_last(self) -> bool:
        return self.best is self.last

    def result(self) -> Result:
        """The record of the run as far as it went."""
        before, after = self._summaries()
        several = isinstance(self.smoother, Recipe) or len(self._stage_runs) > 1
        mesh = self.mesh.with_points(self.best.points)
        return Result(
            mesh=mesh,
            before=before,
            after=after,
            method=Recipe.name if several else self.smoother.name,
            parameters={} if several else self.stage.smoother.values(),
            outcome=self.outcome or Outcome.STOPPED,
            message=self._message(before, after),
            iterations=self.last.number,
            kept=self.best.number,
            seconds=self.last.seconds,
            setup_seconds=self.setup_seconds,
            history=tuple(self.history),
            stages=tuple(one.result() for one in self._stage_runs),
            surface=self._surface_change(mesh),
            limits=self._stage_run.limits if self._kept_last else None,
        )

    def _surface_change(self, mesh: Mesh) -> SurfaceChange | None:
        """Of the boundary as given to that of a mesh, where a method let it slide."""
        angles = [
            one.smoother.values().get("feature_angle", FEATURE_ANGLE) for one in self._stage_runs if one.smoother.slides
        ]
        return surface_change(self.mesh, mesh, angles[0]) if angles else None

    def _summaries(self) -> tuple[Summary, Summary]:
        """Of the mesh as given and of what was reached."""
        mesh = self.mesh.with_points(self.best.points)
        return summarise(self.mesh, self.start.quality), summarise(mesh, self.best.quality)

    @property
    def _stage_run(self) -> StageRun:
        return self._stage_runs[-1]

    @property
    def _remaining_stages(self) -> Sequence[Stage]:
        return self._stages[self._stage_run.number :]

    def _begin_next_stage(self) -> None:
        done, last, reached = self._stage_run, self.last, self.best
        kept = f" Kept of it is iteration {reached.number}." if reached is not last else ""
        count = format_iterations(last.number - done.since.number)
        self.decisions.append(f"Stage {done.number}, {done.smoother.title}, {count}: {done.outcome.value}{kept}")
        self._stage_runs.append(StageRun(self.mesh, self._remaining_stages[0], done.number + 1, reached, last))
        self._end_if_done()

    def _end_if_done(self) -> None:
        """End where the stage_run at hand has ended and nothing comes after it."""
        over = self._stage_run.outcome
        if over is Outcome.NOTHING_FREE or (over is not None and not self._remaining_stages):
            self.outcome = over


def _stages(smoother: Smoother | Recipe, stop: StoppingCriteria | None) -> Sequence[Stage]:
    if isinstance(smoother, Recipe):
        return (smoother if stop is None else smoother.limited(**stop.values())).stages
    return (Stage(smoother, stop or StoppingCriteria()),)
