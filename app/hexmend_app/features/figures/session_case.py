"""What a window's figure set shows: the mesh as it was opened, as it is now, and as compared methods left it."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend.parameters import declared
from hexmend.recipe import Recipe
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
    return Case(document.name, None, tuple(named[:_MOST]))


def recipe_of(session: Session) -> Recipe | None:
    """What was run last, where the mesh has changed by it."""
    work, document = session.smoothing.work, session.document
    if work is None or document.now is document.start:
        return None
    begun = session.order.begun
    return work if isinstance(work, Recipe) else Recipe.of(begun if begun is not None else work)


def method_words(session: Session, recipe: str) -> list[str]:
    """The options of a command that runs the same; `recipe` is the file of `recipe_of`, "" for none."""
    rows = [one.row for one in session.comparison.results if one.row.method in METHODS]
    methods = [*filter(None, [recipe]), *(row.method for row in rows)]
    return ["--methods", ",".join(methods) or "none", *(word for row in rows for word in _settings(row))]


def _settings(row: Row) -> Sequence[str]:
    defaults = {one.name: one.default for one in declared(METHODS[row.method])}
    changed = {name: value for name, value in row.parameters.items() if value != defaults.get(name)}
    return [word for name, value in changed.items() for word in ("--set", f"{row.method}.{name}={_word(value)}")]


def _word(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


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
