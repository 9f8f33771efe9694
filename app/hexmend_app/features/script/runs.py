"""Runs as the Python source that makes them again, iteration by iteration, to the bit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from hexmend.iteration import Outcome, Result, StageResult
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import Smoother
from hexmend_app.features.script.source_code import made, with_limits


@dataclass(frozen=True)
class RunLines:
    """Data of a run that a script needs to repeat it.

    Parameters
    ----------
    work : Smoother or Recipe
    stop : StoppingCriteria or None
        None for a recipe's own.
    changes : sequence of (int, Stage)
        What was chosen on the way, with the number of the iteration after which it was.
    stages : sequence of StageResult
        What came of it; empty while it goes on.
    stopped : int or None
        The iteration after which the user ended it; None where it ended by itself.
    """

    work: Smoother | Recipe
    stop: StoppingCriteria | None
    changes: Sequence[tuple[int, Stage]] = ()
    stages: Sequence[StageResult] = ()
    stopped: int | None = None

    @classmethod
    def of(
        cls, work: Smoother | Recipe, stop: StoppingCriteria | None, changes: Sequence[tuple[int, Stage]], end: Result
    ) -> RunLines:
        """A run that has ended."""
        stopped = end.iterations if end.outcome is Outcome.STOPPED else None
        return cls(work, stop, tuple(changes), end.stages, stopped)._counted()

    @property
    def arguments(self) -> list[str]:
        """Return the method and its limits as source."""
        return [with_limits(self.work, self.stop)]

    def smoothed(self, mesh: str, name: str) -> str:
        """The source that runs it on the mesh of one name and gives the result another."""
        if self.changes:
            return f"{self._loop(mesh, self.stopped, 'run.close()')}\n{name} = run.result().mesh"
        arguments = f"{mesh}, {with_limits(self.work, self.stop)}"
        if self.stopped is not None:
            arguments += f", watch=lambda it: it.number < {self.stopped}"
        return f"{name} = hx.smooth({arguments}).mesh"

    def until(self, mesh: str, number: int) -> str:
        """The source after which `it` is an iteration of it, not number 0."""
        return self._loop(mesh, number, "break")

    def _loop(self, mesh: str, end: int | None, at_the_end: str) -> str:
        changes = [one for one in self.changes if end is None or one[0] < end]
        lines = [f"run = hx.iterate({mesh}, {with_limits(self.work, self.stop)})"]
        lines += [f"run.switch_method({_both(stage)})" for number, stage in changes if not number]
        lines.append("for it in run:")
        for number, stage in changes:
            if number:
                lines += [f"    if it.number == {number}:", f"        run.switch_method({_both(stage)})"]
        if end is not None:
            lines += [f"    if it.number == {end}:", f"        {at_the_end}"]
        return "\n".join(lines if len(lines) > 2 or "for" not in lines[-1] else [*lines, "    pass"])

    def _counted(self) -> RunLines:
        """The same with iterations for a limit where it was seconds that ended a stage: other machines differ."""
        repeatable = _without_clock(self)
        for number in {run.stage for run in self.stages}:
            stage_runs = [run for run in self.stages if run.stage == number]
            if stage_runs[-1].outcome is Outcome.MAX_SECONDS:
                repeatable = repeatable._limited(stage_runs[-1], sum(run.iterations for run in stage_runs))
        return repeatable

    def _limited(self, stage_run: StageResult, most: int) -> RunLines:
        """The same with a limit of iterations for the stage that ends with a run of it."""
        for at, (number, stage) in reversed(list(enumerate(self.changes))):
            if stage.smoother.name == stage_run.method and number < stage_run.first + stage_run.iterations + 1:
                change = number, replace(stage, stop=replace(stage.stop, max_iterations=most))
                return replace(self, changes=(*self.changes[:at], change, *self.changes[at + 1 :]))
        if isinstance(self.work, Recipe):
            at, stages = stage_run.stage - 1, self.work.stages
            limited = replace(stages[at], stop=replace(stages[at].stop, max_iterations=most))
            return replace(self, work=replace(self.work, stages=(*stages[:at], limited, *stages[at + 1 :])))
        return replace(self, stop=replace(self.stop or StoppingCriteria(), max_iterations=most))


def _without_clock(lines: RunLines) -> RunLines:
    """Return a copy in which no stage has a limit of seconds."""
    work = lines.work.limited(max_seconds=0.0) if isinstance(lines.work, Recipe) else lines.work
    stop = lines.stop and replace(lines.stop, max_seconds=0.0)
    changes = [(number, replace(stage, stop=replace(stage.stop, max_seconds=0.0))) for number, stage in lines.changes]
    return replace(lines, work=work, stop=stop, changes=tuple(changes))


def _both(stage: Stage) -> str:
    return f"{made(stage.smoother)}, {made(stage.stop)}"
