"""Run records for recorded scripts: of runs that are repeated without a window, or read from a session."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules import MotionRules
from hexmend.mesh.rules.resolution import with_more_rules
from hexmend.run import Run, StoppingCriteria, iterate
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import Smoother
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.history import History, RecordedIteration, RunRecord
from hexmend_app.state.session.session_data import SessionData


def rerun(
    name: str,
    mesh: Mesh,
    work: Smoother | Recipe,
    stop: StoppingCriteria | None = None,
    *,
    until: int | None = None,
    changes: Iterable[tuple[int, Stage]] = (),
    keep: Collection[int] = (),
    parent: tuple[RunRecord, int] | None = None,
    slot: int = 0,
    plotted: bool = True,
    rules: MotionRules | None = None,
) -> RunRecord:
    """Run a method or a recipe, and record it as the window does.

    Parameters
    ----------
    name : str
        Name of the run.
    mesh, work, stop
        As for `hexmend.run.iterate`.
    until : int, optional
        Iteration after which the run is ended; by default it runs until it stops.
    changes : iterable of (int, Stage)
        Iterations after which the method was switched, and the new stages.
    keep : collection of int
        Iterations whose node positions are recorded; those of the start and the result always are.
    parent : (RunRecord, int), optional
        Iteration of another run from which this run starts.
    slot : int
        Number of its colour.
    plotted : bool
        True to show the run in charts.
    rules : MotionRules, optional
        Rules of motion of the run of a method; a recipe has its own.

    Returns
    -------
    RunRecord
    """
    ruled = with_more_rules(mesh, rules) if rules else mesh
    history, run, pending = History(math.inf), iterate(ruled, work, stop), list(changes)
    record = history.begin(work.title, State.of(mesh))
    record.name, record.slot, record.plotted = name, slot, plotted
    record.work, record.stop, record.rules = work, stop, rules or MotionRules()
    record.parent = None if parent is None else RecordedIteration(*parent)
    history.add(record, run.start)
    _switch_method(run, pending, 0)
    if until == 0:
        run.close()
    for it in run:
        history.add(record, it, positions=it.number in keep)
        _switch_method(run, pending, it.number)
        if it.number == until:
            run.close()
    result = run.result()
    end = State.of(mesh.with_points(result.mesh.points))
    history.finish(record, RecordedIteration(record, result.kept), end, result.message)
    return record


def recorded(session: SessionData, at: int) -> RunRecord:
    """Return the record of a run in a session, by its number from 0."""
    history = History(math.inf)
    history.restore(session.history)
    return history.records[at]


def _switch_method(run: Run, pending: list[tuple[int, Stage]], number: int) -> None:
    """Make the changes of the method that are due after an iteration."""
    while pending and pending[0][0] == number and run.outcome is None:
        stage = pending.pop(0)[1]
        run.switch_method(stage.smoother, stage.stop)
