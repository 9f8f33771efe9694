"""Python source of runs."""

from __future__ import annotations

from hexmend.iteration import Outcome
from hexmend.mesh.rules import MotionRules
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import Smoother
from hexmend_app.features.script.source_code import keywords_source, value_source
from hexmend_app.state.mesh.run_record import RunRecord

#: Outcomes of which the number of iterations is not repeated by itself.
ENDED_BY_TIME = (Outcome.STOPPED, Outcome.MAX_SECONDS)


def smooth_source(
    mesh: str, work: Smoother | Recipe, stop: StoppingCriteria | None, rules: MotionRules, until: int | None = None
) -> str:
    """Return the source that runs a method or a recipe, `until` an iteration at most.

    >>> from hexmend.smoothers import METHODS
    >>> smooth_source("mesh_0", METHODS["laplacian"](), StoppingCriteria(max_iterations=5), MotionRules(fix=("inlet",)))
    "hx.smooth(mesh_0, hx.Laplacian(), hx.StoppingCriteria(max_iterations=5), fix=['inlet'])"
    """
    watch = [] if until is None else [f"watch=lambda it: it.number < {until}"]
    return f"hx.smooth({', '.join([*_arguments(mesh, work, stop, rules), *watch])})"


def result_source(record: RunRecord, start: str) -> list[str]:
    """Return lines of source, of which the last is the mesh that a run has ended with."""
    until = record.newest if record.outcome in ENDED_BY_TIME else None
    if not record.changes:
        return [f"{smooth_source(start, record.work, record.stop, record.rules, until)}.mesh"]
    return [*_loop(record, start, until, "run.close()"), "run.result().mesh"]


def iteration_source(record: RunRecord, start: str, number: int) -> list[str]:
    """Return lines of source after which `it` is an iteration of a run."""
    return _loop(record, start, number, "break")


def _loop(record: RunRecord, start: str, until: int | None, end: str) -> list[str]:
    """Return the source that runs a method step by step and changes it as the user did."""
    arguments = _arguments(start, record.work, record.stop, record.rules)
    changes = [(at, stage) for at, stage in record.changes if until is None or at < until]
    lines = [f"run = hx.iterate({', '.join(arguments)})"]
    lines += [_switch(stage) for at, stage in changes if not at]
    lines.append("for it in run:")
    for at, stage in changes:
        lines += [f"    if it.number == {at}:", f"        {_switch(stage)}"] if at else []
    if until is not None:
        lines += [f"    if it.number == {until}:", f"        {end}"]
    return lines


def _switch(stage: Stage) -> str:
    return f"run.switch_method({value_source(stage.smoother)}, {value_source(stage.stop)})"


def _arguments(mesh: str, work: Smoother | Recipe, stop: StoppingCriteria | None, rules: MotionRules) -> list[str]:
    """Return the sources of the arguments of `smooth` and `iterate`; a recipe has its own limits and rules."""
    arguments = [mesh, value_source(work)]
    if stop is not None and stop != StoppingCriteria():
        arguments.append(value_source(stop))
    return arguments if isinstance(work, Recipe) or not rules else [*arguments, keywords_source(rules)]
