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

#: Largest number of meshes in a figure.
_MAX_MESHES = 12


def versions_of(session: Session) -> list[tuple]:
    """Return the meshes to draw, without duplicates."""
    document = session.document
    candidates = [(document.start, (INITIAL, document.start.mesh)), (document.now, _current(session))]
    for result in session.comparison.results:
        if result.state is not None:
            title = METHODS[result.row.method].title if result.row.method in METHODS else result.row.method
            candidates.append((result.state, (title, result.row)))
    distinct: list[tuple[State, tuple]] = []
    for state, version in candidates:
        if all(state.mesh.points is not other.mesh.points for other, _ in distinct):
            distinct.append((state, version))
    names: set[str] = set()
    versions = []
    for number, (_, (name, *source)) in enumerate(distinct[:_MAX_MESHES]):
        unique = f"{name} ({number})" if name in names else name  # a method may have been run and compared
        names.add(unique)
        versions.append((unique, *source))
    return versions


def recipes_of(session: Session) -> dict[str, Recipe]:
    """Return the recipes that reproduce the meshes from the opened mesh, by file name.

    A mesh is left out if the stages that led to it are unknown.
    """
    document, comparison = session.document, session.comparison
    run = _run_recipe(session)
    recipes = {} if run is None else {"run.toml": run}
    initial = comparison.initial
    if initial is None or not comparison.results:
        return recipes
    if initial.mesh.points is document.start.mesh.points:
        before: Sequence[Stage] = ()
    elif run is not None and initial.mesh.points is document.now.mesh.points:
        before = run.stages
    else:
        return recipes
    stop = comparison.to_data().stop
    for row in (one.row for one in comparison.results if one.row.method in METHODS):
        method = METHODS[row.method]
        stage = Stage(from_values(method, row.parameters, owner=row.method), stop)
        title = f"{method.title} (compared)" if run is not None and run.title == method.title else method.title
        recipes[f"{row.method}.toml"] = Recipe.of(*before, stage, title=title)
    return recipes


def _run_recipe(session: Session) -> Recipe | None:
    """Return the recipe of the last run if it led from the opened mesh to the current mesh, else None."""
    work, document = session.run.work, session.document
    moment = session.history.iteration_of(document.now)
    if work is None or moment is None or moment.number != moment.record.result:
        return None
    if moment.record.start.mesh.points is not document.start.mesh.points:
        return None
    if isinstance(work, Recipe):
        return work
    stage = session.run_setup.active_stage or Stage(work)
    stop = replace(stage.stop, max_iterations=moment.record.newest)  # the user may have stopped it
    return Recipe.of(replace(stage, stop=stop), title=work.title, rules=moment.record.rules)


def _current(session: Session) -> tuple:
    """Return the version of the current mesh, with its run if it is an iteration of one."""
    state = session.document.now
    moment = session.history.iteration_of(state)
    if moment is None or not moment.number:
        return "now", state.mesh
    return moment.record.name, moment.record, moment.number, state.mesh
