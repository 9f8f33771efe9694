"""What a window's figure set shows: the mesh as it was opened, as it is now, and as compared methods left it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from hexmend.parameters import from_values
from hexmend.recipe import Recipe, Stage
from hexmend.smoothers import METHODS
from hexmend.study.row import Row
from hexmend_app.report.case import INITIAL, Case, Version
from hexmend_app.state.document import State
from hexmend_app.state.history import Moment, Record
from hexmend_app.state.session import Session

#: Meshes beside one another in a figure at most.
_MOST = 12


def case_of(session: Session) -> Case:
    """The case; of what is the same mesh, the first alone."""
    document = session.document
    found = [_version(INITIAL, document.start), _now(session)]
    for one in session.comparison.results:
        if one.state is not None:
            title = METHODS[one.row.method].title if one.row.method in METHODS else one.row.method
            found.append(_version(title, one.state, one.row))
    versions: list[Version] = []
    for version in found:
        if all(version.mesh.points is not one.mesh.points for one in versions):
            versions.append(version)
    names = {version.name for version in versions}
    named = [_renamed(version, k, names) for k, version in enumerate(versions)]
    return Case(document.now.mesh.name, None, tuple(named[:_MOST]))


def recipes_of(session: Session) -> dict[str, Recipe]:
    """What makes the meshes of the case again from the mesh as it was opened, by the names of files.

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
    stop = comparison.given().stop
    for row in (one.row for one in comparison.results if one.row.method in METHODS):
        method = METHODS[row.method]
        stage = Stage(from_values(method, row.parameters, owner=row.method), stop)
        title = f"{method.title} (compared)" if run is not None and run.title == method.title else method.title
        found[f"{row.method}.toml"] = Recipe.of(*before, stage, title=title)
    return found


def _run(session: Session) -> Recipe | None:
    """What was run last, where the mesh is its result."""
    work, document = session.smoothing.work, session.document
    moment = session.history.moment_of(document.now)
    if work is None or moment is None or moment.number != moment.record.result:
        return None
    if moment.record.start.mesh.points is not document.start.mesh.points:
        return None
    if isinstance(work, Recipe):
        return work
    stage = session.order.begun or Stage(work)
    # It may have been ended by hand.
    stop = replace(stage.stop, max_iterations=moment.record.newest)
    return Recipe.of(replace(stage, stop=stop), title=work.title)


def _now(session: Session) -> Version:
    """The mesh as it is, with the run that it is the result or an iteration of."""
    state = session.document.now
    moment = session.history.moment_of(state)
    if moment is None or not moment.number:
        return _version("now", state)
    record = moment.record
    rows = record.rows[: moment.number + 1]
    version = _version(record.name, state, _row(record, moment, state))
    return Version(version.name, version.mesh, version.figures, version.summary, version.row, rows, record.advice)


def _row(record: Record, moment: Moment, state: State) -> Row:
    seconds = float(record.rows[moment.number]["seconds"])
    ended = "" if moment.number == record.result else "stopped"
    return Row(record.title, {}, ended, record.message, state.mesh, state.summary, moment.number, seconds)


def _version(name: str, state: State, row: Row | None = None) -> Version:
    return Version(name, state.mesh, state.figures, state.summary, row)


def _renamed(version: Version, place: int, names: set[str]) -> Version:
    """A version whose name no other has: a method may have been run and compared."""
    if version.name not in names:
        version = Version(f"{version.name} ({place})", version.mesh, version.figures, version.summary, version.row,
                          version.history, version.advice)  # fmt: skip
    names.discard(version.name)
    return version
