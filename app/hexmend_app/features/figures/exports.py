"""Exports of the window as steps: the figure set and the report."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from hexmend.io.storage.atomic import check_writable
from hexmend.io.storage.suffixes import suffix_for
from hexmend_app.features.figures.drawing import NamedVersion, draw, prepare, version_of
from hexmend_app.features.figures.versions import recipes_of, versions_of
from hexmend_app.picture import Scene
from hexmend_app.report.case import Case, Source
from hexmend_app.report.charts import check_matplotlib
from hexmend_app.report.figure_set import PARTS, Figure, Style, stationary
from hexmend_app.report.page import FIGURES, draw_chapter, page, write_page
from hexmend_app.report.pdf import check_pdf, write_pdf
from hexmend_app.state.session.session import Session
from hexmend_app.translation import tr

#: Suffixes of reports.
_SUFFIXES = (".html", ".pdf")

#: Pixels per inch of the pictures.
_DPI = 220.0


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
    arguments = folder, stem, document.now.mesh.name, scene, versions, recipes
    file = () if document.path is None else (str(document.path),)
    return Export(draw(*arguments, *file), _drawn(list(PARTS), versions), folder.name)


def report(session: Session, scene: Scene, path: Path, stem: str) -> Export:
    """Check that a report can be written, and return its steps; for errors see `prepare_report`."""
    document = session.document
    prepare_report(path)
    name, versions = document.now.mesh.name, versions_of(session)
    arguments = path, tr("Report on {name}", name=name or stem), name, stationary(scene), versions
    file = () if document.path is None or not document.path.exists() else (str(document.path),)
    return Export(draw_report(*arguments, *file), _drawn(FIGURES, versions), path.name)


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
    path: str | Path, title: str, mesh: str, scene: Scene, versions: Sequence[NamedVersion], file: str = ""
) -> Generator[Figure]:
    """Yield figure by figure, then write the report, HTML or PDF by the suffix.

    Parameters
    ----------
    path : path-like
    title : str
    mesh : str
        Name of the mesh.
    scene : Scene
        Camera, cut and colours of the pictures.
    versions : sequence of NamedVersion
        Meshes to compare, the mesh as opened first.
    file : str
        File of the mesh; "" for none.
    """
    path = Path(path)
    interactive = suffix_for(path, "a report", _SUFFIXES) == ".html"
    source = Source.of(file) if file else None
    case = Case(mesh, source, tuple(map(version_of, versions)), stop=None)
    style = Style(replace(scene, page=replace(scene.page, dpi=_DPI)))
    chapter = yield from draw_chapter(case, style, [], interactive=interactive)
    (write_page if interactive else write_pdf)(path, page(title, [chapter], "", interactive=interactive))
