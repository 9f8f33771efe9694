"""Exports of the window as steps: the figure set and the report."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import dataclass
from pathlib import Path

from hexmend_app.features.figures.drawing import NamedVersion, draw, prepare
from hexmend_app.features.figures.report_file import draw_report, prepare_report
from hexmend_app.features.figures.versions import recipes_of, versions_of
from hexmend_app.picture import Scene
from hexmend_app.report.figure_set import PARTS, Figure, stationary
from hexmend_app.report.page import FIGURES
from hexmend_app.state.session.session import Session
from hexmend_app.translation import tr


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
