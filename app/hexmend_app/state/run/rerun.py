"""Runs made again without a window, or found in a session, with all that a window keeps of them: for its scripts."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable

from hexmend.mesh.mesh import Mesh
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
) -> RunRecord:
    """Run a method or a recipe, and keep what a window keeps of it.

    Parameters
    ----------
    name : str
        What the run is called.
    mesh, work, stop
        As for `hexmend.run.iterate`.
    until : int, optional
        The iteration after which it is ended; without it, it ends by itself.
    changes : iterable of (int, Stage)
        What it goes on with, and after which iteration.
    keep : collection of int
        Iterations whose positions are kept; those of the start and the result always are.
    parent : (Record, int), optional
        The iteration of another run that it goes on from.
    slot : int
        What its colour goes by.
    plotted : bool
        Whether charts show it.

    Returns
    -------
    Record
    """
    history, run, due = History(math.inf), iterate(mesh, work, stop), list(changes)
    record = history.begin(work.title, State.of(mesh))
    record.name, record.slot, record.plotted = name, slot, plotted
    record.parent = None if parent is None else RecordedIteration(*parent)
    history.add(record, run.start)
    _change(run, due, 0)
    if until == 0:
        run.close()
    for it in run:
        history.add(record, it, places=it.number in keep)
        _change(run, due, it.number)
        if it.number == until:
            run.close()
    result = run.result()
    history.finish(record, RecordedIteration(record, result.kept), State.of(result.mesh), result.message)
    return record


def recorded(session: SessionData, at: int) -> RunRecord:
    """A run that a session has kept, by its number from 0."""
    history = History(math.inf)
    history.restore(session.history)
    return history.records[at]


def _change(run: Run, due: list[tuple[int, Stage]], number: int) -> None:
    """Go on with what is chosen after an iteration."""
    while due and due[0][0] == number and run.outcome is None:
        stage = due.pop(0)[1]
        run.switch_method(stage.smoother, stage.stop)
