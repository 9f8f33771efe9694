"""Exports of the window as steps: the figure set and the report."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from hexmend.io.storage.atomic import check_writable
from hexmend.io.storage.suffixes import suffix_for
from hexmend.parameters import from_values
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import METHODS
from hexmend_app.features.figures.drawing import NamedVersion, draw, prepare, version_of
from hexmend_app.picture import Scene
from hexmend_app.report.case import INITIAL, Case, Source
from hexmend_app.report.charts import check_matplotlib
from hexmend_app.report.figure_set import PARTS, Figure, Style, stationary
from hexmend_app.report.page import FIGURES, draw_chapter, page, write_page
from hexmend_app.report.pdf import check_pdf, write_pdf
from hexmend_app.state.mesh.document import State
from hexmend_app.state.session.session import Session
from hexmend_app.translation import tr

#: Suffixes of reports.
_SUFFIXES = (".html", ".pdf")

#: Pixels per inch of the pictures.
_DPI = 220.0


#: Largest number of meshes in a figure.
_MAX_MESHES = 12


@dataclass(frozen=True)
class Export:
    """Export that is drawn figure by figure.

    Parameters
    ----------
    steps : iterator of Figure
    figures : sequence of str
        Names of the figures, in order.
    file : str
        Name of the file or folder.
    """

    steps: Generator[Figure]
    figures: Sequence[str]
    file: str

    def progress_text(self, drawn: int) -> str:
        """Return the progress text after a number of figures."""
        count = len(self.figures)
        if drawn >= count:
            return tr("Writing {name}…", name=self.file)
        return tr("Drawing figure {at} of {count}: {part}…", at=drawn + 1, count=count, part=self.figures[drawn])


def figure_set(session: Session, scene: Scene, folder: Path, stem: str) -> Export:
    """Create the folder of a figure set, and return its steps; for errors see `prepare`."""
    document, scene = session.document, stationary(scene)
    recipes = recipes_of(session)
    prepare(folder, scene, recipes)
    versions = versions_of(session)
    steps = draw(folder, stem, document.now.mesh.name, scene, versions, recipes, document.path)
    return Export(steps, _drawn(list(PARTS), versions), folder.name)


def report(session: Session, scene: Scene, path: Path, stem: str) -> Export:
    """Check that a report can be written, and return its steps; for errors see `prepare_report`."""
    document = session.document
    prepare_report(path)
    name, versions = document.now.mesh.name, versions_of(session)
    file = document.path if document.path is not None and document.path.exists() else None
    steps = draw_report(path, tr("Report on {name}", name=name or stem), name, stationary(scene), versions, file)
    return Export(steps, _drawn(FIGURES, versions), path.name)


def _drawn(figures: Sequence[str], versions: Sequence[NamedVersion]) -> list[str]:
    """Return the names of the figures that are drawn: without an iteration of a run there is no convergence."""
    run = any(len(version) == 4 for version in versions)
    return [name for name in figures if run or name != "convergence"]


def prepare_report(path: Path) -> None:
    """Check that a report can be written.

    Raises
    ------
    HexmendError
        If a library is missing, or the file cannot be written.
    """
    if suffix_for(path, "a report", _SUFFIXES) == ".pdf":
        check_pdf()
    check_writable(path)
    check_matplotlib()


def draw_report(
    path: Path, title: str, mesh: str, scene: Scene, versions: Sequence[NamedVersion], file: Path | None
) -> Generator[Figure]:
    """Yield figure by figure, then write the report, HTML or PDF by the suffix.

    Parameters
    ----------
    path : Path
    title : str
    mesh : str
        Name of the mesh.
    scene : Scene
        Camera, cut and colours of the pictures.
    versions : sequence of NamedVersion
        Meshes to compare, the mesh as opened first.
    file : Path or None
        File of the mesh.
    """
    interactive = suffix_for(path, "a report", _SUFFIXES) == ".html"
    source = None if file is None else Source.of(str(file))
    case = Case(mesh, source, tuple(map(version_of, versions)), stop=None)
    style = Style(replace(scene, page=replace(scene.page, dpi=_DPI)))
    chapter = yield from draw_chapter(case, style, [], interactive=interactive)
    (write_page if interactive else write_pdf)(path, page(title, [chapter], "", interactive=interactive))


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
