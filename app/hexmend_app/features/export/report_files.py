"""Report and figure set of the meshes of a window: what they compare, and their figures one by one."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import replace
from pathlib import Path

from hexmend.parameters import from_values
from hexmend.report.documents import output_folder
from hexmend.run.recipe import Recipe, Stage
from hexmend.run.recipe_files import write_recipe
from hexmend.smoothers import METHODS
from hexmend.study.compare import Row
from hexmend_app.picture import Scene, write_scene
from hexmend_app.report.case import INITIAL, Case, Source, Version, command_line
from hexmend_app.report.figure_captions import write_captions
from hexmend_app.report.figure_set import Figure, Style, stationary, write_figures
from hexmend_app.report.page import REPORT_DPI, check_report, draw_chapter, page, write_report
from hexmend_app.state.mesh.run_record import RunRecord
from hexmend_app.state.session.session import Session
from hexmend_app.translation import tr

#: File formats of each figure of a set.
_FORMATS = ("png", "pdf", "svg")

#: Largest number of meshes in a figure.
_MAX_MESHES = 12


def figure_set(session: Session, scene: Scene, folder: Path, title: str) -> Generator[Figure]:
    """Write a figure set into a folder: yield figure by figure, then write captions and commands.

    Parameters
    ----------
    session : Session
    scene : Scene
        Camera, cut and colours.
    folder : Path
        Created if it is missing.
    title : str
        Title above the captions.
    """
    document, scene, recipes = session.document, stationary(scene), recipes_of(session)
    output_folder(folder)
    write_scene(folder / "scene.toml", scene)
    for name, recipe in recipes.items():
        write_recipe(folder / name, recipe)
    case = Case(document.now.mesh.name, None, tuple(versions_of(session)))
    file = "MESH" if document.path is None else str(document.path)
    methods = ",".join(str(folder / name) for name in recipes) or "none"
    command = ["figures", file, "--methods", methods, "--scene", str(folder / "scene.toml")]
    command += ["--format", ",".join(_FORMATS), "-o", str(folder), "--only"]
    figures = []
    for figure in write_figures(case, folder, Style(scene, formats=_FORMATS)):
        figures.append((figure, command_line([*command, figure.part])))
        yield figure
    write_captions(folder, title, figures)


def report(session: Session, scene: Scene, path: Path, stem: str) -> Generator[Figure]:
    """Yield the figures of a report, then write it as HTML or PDF by the suffix of its path."""
    document, interactive = session.document, check_report(path)
    name, file = document.now.mesh.name, document.path
    source = Source.of(str(file)) if file is not None and file.exists() else None
    case = Case(name, source, tuple(versions_of(session)), stop=None)
    scene = stationary(scene)
    style = Style(replace(scene, page=replace(scene.page, dpi=REPORT_DPI)))
    chapter = yield from draw_chapter(case, style, interactive=interactive)
    text = page(tr("Report on {name}", name=name or stem), [chapter], "", interactive=interactive)
    write_report(path, text)


def versions_of(session: Session) -> list[Version]:
    """Return the meshes to compare, without duplicates: as opened, as it is now, and the results of a comparison."""
    document = session.document
    versions = [Version.of(INITIAL, document.start.mesh), _current(session)]
    for result in session.comparison.results:
        if result.state is not None:
            title = METHODS[result.row.method].title if result.row.method in METHODS else result.row.method
            versions.append(Version.of(title, result.state.mesh, result.row))
    distinct: dict[int, Version] = {}
    for version in versions:
        distinct.setdefault(id(version.mesh.points), version)
    named: dict[str, Version] = {}
    for number, version in enumerate([*distinct.values()][:_MAX_MESHES]):
        name = f"{version.name} ({number})" if version.name in named else version.name  # run and compared
        named[name] = replace(version, name=name)
    return [*named.values()]


def _current(session: Session) -> Version:
    """Return the version of the current mesh, with its run if it is an iteration of one."""
    state = session.document.now
    iteration = session.history.iteration_of(state)
    if iteration is None or not iteration.number:
        return Version.of("now", state.mesh)
    record, number = iteration.record, iteration.number
    version = Version.of(record.name, state.mesh)
    rows = record.rows[: number + 1]
    return replace(version, row=_row(record, number, version), history=rows, advice=record.advice)


def _row(record: RunRecord, number: int, version: Version) -> Row:
    """Return an iteration of a run as a row of a comparison."""
    seconds = float(record.rows[number]["seconds"])
    outcome = "" if number == record.result else "stopped"
    stages = () if record.recipe is None else record.recipe.stages
    parameters = stages[0].smoother.values() if len(stages) == 1 else {}
    return Row(record.title, parameters, outcome, record.message, version.mesh, version.summary, number, seconds)


def recipes_of(session: Session) -> dict[str, Recipe]:
    """Return the recipes that reproduce the meshes from the opened mesh, by file name.

    A mesh is left out if the stages that led to it are unknown.
    """
    document, comparison = session.document, session.comparison
    run = run_recipe(session)
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
    for row in (one.row for one in comparison.results if one.row.method in METHODS):
        method = METHODS[row.method]
        stage = Stage(from_values(method, row.parameters, owner=row.method), comparison.data.stop)
        title = f"{method.title} (compared)" if run is not None and run.title == method.title else method.title
        recipes[f"{row.method}.toml"] = Recipe.of(*before, stage, title=title)
    return recipes


def run_recipe(session: Session) -> Recipe | None:
    """Return the recipe of the runs that led from the opened mesh to the current mesh, else None."""
    iteration, recipes = session.history.iteration_of(session.document.now), list[Recipe]()
    start = None
    while iteration is not None:
        record, number = iteration.record, iteration.number
        if number:
            recipe = record.recipe_until(number)
            if recipe is None:
                return None
            recipes.insert(0, recipe)
        start, iteration = record.start, record.parent
    if not recipes or start.mesh.points is not session.document.start.mesh.points:
        return None
    if any(recipe.rules != recipes[0].rules for recipe in recipes):
        return None
    stages = [stage for recipe in recipes for stage in recipe.stages]
    return Recipe.of(*stages, title=recipes[0].title if len(recipes) == 1 else "", rules=recipes[0].rules)
