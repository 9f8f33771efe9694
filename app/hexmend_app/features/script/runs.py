"""Python source that repeats a run bit for bit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from hexmend.iteration import Outcome, Result, StageResult
from hexmend.mesh.rules import MotionRules
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import Smoother
from hexmend_app.features.script.source_code import arguments_source, settings_source, source_of
from hexmend_app.state.mesh.run_record import RunRecord


@dataclass(frozen=True)
class RunLines:
    """Data of a run that a script needs to repeat it.

    Parameters
    ----------
    work : Smoother or Recipe
    stop : StoppingCriteria or None
        None for a recipe, which has its own criteria.
    changes : sequence of (int, Stage)
        Changes during the run, each with the number of the iteration before it.
    stages : sequence of StageResult
        Results of the stages; empty during the run.
    stopped : int or None
        The iteration after which the user stopped the run; None if it ended by itself.
    rules : MotionRules
        Rules of motion, of a method or a recipe.
    """

    work: Smoother | Recipe
    stop: StoppingCriteria | None
    changes: Sequence[tuple[int, Stage]] = ()
    stages: Sequence[StageResult] = ()
    stopped: int | None = None
    rules: MotionRules = field(default_factory=MotionRules)

    @classmethod
    def of(cls, record: RunRecord, end: Result) -> RunLines:
        """Return the data of a run that has ended."""
        stopped = end.iterations if end.outcome is Outcome.STOPPED else None
        return cls._begun(record, end.stages, stopped)._counted()

    @classmethod
    def of_active(cls, record: RunRecord) -> RunLines:
        """Return the data of a run that has not ended."""
        return cls._begun(record)

    @classmethod
    def _begun(cls, record: RunRecord, stages: Sequence[StageResult] = (), stopped: int | None = None) -> RunLines:
        """Return the data of a run; the rules of a recipe become those of the run."""
        work = replace(record.work, rules=MotionRules()) if isinstance(record.work, Recipe) else record.work
        return cls(work, record.stop, tuple(record.changes), stages, stopped, record.rules)

    @property
    def arguments(self) -> str:
        """Source of the method and its limits, as arguments."""
        return arguments_source(self.work, self.stop)

    def smoothed(self, mesh: str, name: str) -> str:
        """Return the source that runs the method on `mesh` and assigns the result, without rules, to `name`."""
        if self.changes:
            loop = self._loop(mesh, self.stopped, "run.close()")
            return f"{loop}\n{name} = {self._without_rules(mesh, 'run.result().mesh')}"
        arguments = f"{mesh}, {self._run_arguments}"
        if self.stopped is not None:
            arguments += f", watch=lambda it: it.number < {self.stopped}"
        return f"{name} = {self._without_rules(mesh, f'hx.smooth({arguments}).mesh')}"

    def _without_rules(self, mesh: str, result: str) -> str:
        """Return the source of the result of a run; the next run does not take over its rules."""
        return f"{mesh}.with_points({result}.points)" if self.rules else result

    @property
    def _run_arguments(self) -> str:
        """Source of the method, its limits and the rules, as arguments of `smooth` or `iterate`."""
        return ", ".join(filter(None, (self.arguments, settings_source(self.rules))))

    def until(self, mesh: str, number: int) -> str:
        """Return the source after which `it` is iteration `number` (1 or more) of the run."""
        return self._loop(mesh, number, "break")

    def _loop(self, mesh: str, end: int | None, last_statement: str) -> str:
        changes = [(number, stage) for number, stage in self.changes if end is None or number < end]
        lines = [f"run = hx.iterate({mesh}, {self._run_arguments})"]
        lines += [f"run.switch_method({_stage_arguments(stage)})" for number, stage in changes if not number]
        lines.append("for it in run:")
        for number, stage in changes:
            if number:
                lines += [f"    if it.number == {number}:", f"        run.switch_method({_stage_arguments(stage)})"]
        if end is not None:
            lines += [f"    if it.number == {end}:", f"        {last_statement}"]
        return "\n".join(lines if len(lines) > 2 or "for" not in lines[-1] else [*lines, "    pass"])

    def _counted(self) -> RunLines:
        """Return a copy with limits of iterations instead of seconds, which end a run elsewhere on other machines."""
        repeatable = _without_clock(self)
        for number in {run.stage for run in self.stages}:
            stage_runs = [run for run in self.stages if run.stage == number]
            if stage_runs[-1].outcome is Outcome.MAX_SECONDS:
                repeatable = repeatable._limited(stage_runs[-1], sum(run.iterations for run in stage_runs))
        return repeatable

    def _limited(self, stage_run: StageResult, max_iterations: int) -> RunLines:
        """Return a copy with a limit of iterations for the stage that `stage_run` belongs to."""
        for at, (number, stage) in reversed(list(enumerate(self.changes))):
            if stage.smoother.name == stage_run.method and number < stage_run.first + stage_run.iterations + 1:
                change = number, replace(stage, stop=replace(stage.stop, max_iterations=max_iterations))
                return replace(self, changes=(*self.changes[:at], change, *self.changes[at + 1 :]))
        if isinstance(self.work, Recipe):
            at, stages = stage_run.stage - 1, self.work.stages
            limited = replace(stages[at], stop=replace(stages[at].stop, max_iterations=max_iterations))
            return replace(self, work=replace(self.work, stages=(*stages[:at], limited, *stages[at + 1 :])))
        return replace(self, stop=replace(self.stop or StoppingCriteria(), max_iterations=max_iterations))


def _without_clock(lines: RunLines) -> RunLines:
    """Return a copy without limits of seconds."""
    work = lines.work.limited(max_seconds=0.0) if isinstance(lines.work, Recipe) else lines.work
    stop = lines.stop and replace(lines.stop, max_seconds=0.0)
    changes = [(number, replace(stage, stop=replace(stage.stop, max_seconds=0.0))) for number, stage in lines.changes]
    return replace(lines, work=work, stop=stop, changes=tuple(changes))


def _stage_arguments(stage: Stage) -> str:
    return f"{source_of(stage.smoother)}, {source_of(stage.stop)}"
