"""Versions of the mesh in a figure set: as opened, current, and the results of compared methods."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from hexmend.parameters import from_values
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import METHODS
from hexmend_app.report.case import INITIAL
from hexmend_app.state.mesh.document import State
from hexmend_app.state.session.session import Session

#: Meshes beside one another in a figure at most.
_MOST = 12


def shown_in(session: Session) -> list[tuple]:
    """Return the versions shown, as events record them: states in place of meshes, without duplicates."""
    document = session.document
    found = [(document.start, (INITIAL, document.start)), (document.now, _now(session))]
    for one in session.comparison.results:
        if one.state is not None:
            title = METHODS[one.row.method].title if one.row.method in METHODS else one.row.method
            found.append((one.state, (title, one.row)))
    shown: list[tuple[State, tuple]] = []
    for state, text in found:
        if all(state.mesh.points is not other.mesh.points for other, _ in shown):
            shown.append((state, text))
    names: set[str] = set()
    versions = []
    for place, (_, (name, *subject)) in enumerate(shown[:_MOST]):
        own = f"{name} ({place})" if name in names else name  # a method may have been run and compared
        names.add(own)
        versions.append((own, *subject))
    return versions


def recipes_of(session: Session) -> dict[str, Recipe]:
    """Return the recipes that reproduce the meshes from the opened mesh, by file name.

    Left out is what is not known: how the mesh came to be from which methods were compared, or the one that is shown.
    """
    document, comparison = session.document, session.comparison
    run = _run(session)
    found = {} if run is None else {"run.toml": run}
    started = comparison.initial
    if started is None or not comparison.results:
        return found
    if started.mesh.points is document.start.mesh.points:
        before: Sequence[Stage] = ()
    elif run is not None and started.mesh.points is document.now.mesh.points:
        before = run.stages
    else:
        return found
    stop = comparison.to_data().stop
    for row in (one.row for one in comparison.results if one.row.method in METHODS):
        method = METHODS[row.method]
        stage = Stage(from_values(method, row.parameters, owner=row.method), stop)
        title = f"{method.title} (compared)" if run is not None and run.title == method.title else method.title
        found[f"{row.method}.toml"] = Recipe.of(*before, stage, title=title)
    return found


def _run(session: Session) -> Recipe | None:
    """Return the last run if the current mesh is its result."""
    work, document = session.run.work, session.document
    moment = session.history.moment_of(document.now)
    if work is None or moment is None or moment.number != moment.record.result:
        return None
    if moment.record.start.mesh.points is not document.start.mesh.points:
        return None
    if isinstance(work, Recipe):
        return work
    stage = session.run_setup.begun or Stage(work)
    # It may have been ended by hand.
    stop = replace(stage.stop, max_iterations=moment.record.newest)
    return Recipe.of(replace(stage, stop=stop), title=work.title)


def _now(session: Session) -> tuple:
    """The mesh as it is, with the run that it is the result or an iteration of."""
    state = session.document.now
    moment = session.history.moment_of(state)
    if moment is None or not moment.number:
        return "now", state
    return moment.record.name, moment.record, moment.number, state
