"""Exports of the window as steps: the figure set and the report."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from hexmend_app.features.figures.drawing import draw, prepare, write_set
from hexmend_app.features.figures.report_file import FIGURES, draw_report, prepare_report, write_report
from hexmend_app.features.figures.versions import recipes_of, versions_of
from hexmend_app.picture import Scene
from hexmend_app.report.figure_set import PARTS, Figure, stationary
from hexmend_app.state.session.session import Session
from hexmend_app.state.session.user_events import FileExported
from hexmend_app.translation import tr


@dataclass(frozen=True)
class Export:
    """Export that is drawn figure by figure.

    Parameters
    ----------
    event : FileExported
        The call that writes the same files.
    steps : iterator of Figure
    figures : sequence of str
        Names of the figures, in order.
    """

    event: FileExported
    steps: Iterator[Figure]
    figures: Sequence[str]

    def progress_text(self, drawn: int) -> str:
        """Return the progress text after a number of figures."""
        at = min(drawn, len(self.figures) - 1)
        return tr("Drawing figure {at} of {count}: {part}…", at=at + 1, count=len(self.figures), part=self.figures[at])


def figure_set(session: Session, scene: Scene, folder: Path, stem: str) -> Export:
    """Create the folder of a figure set, and return its steps; for errors see `write_set`."""
    document, scene = session.document, stationary(scene)
    recipes = recipes_of(session)
    prepare(folder, scene, recipes)
    arguments = folder, stem, document.now.mesh.name, scene, versions_of(session), recipes
    file = () if document.path is None else (str(document.path),)
    event = FileExported("figure set", write_set, (*arguments, *file))
    return Export(event, draw(*event.arguments), list(PARTS))


def report(session: Session, scene: Scene, path: Path, stem: str) -> Export:
    """Check that a report can be written, and return its steps; for errors see `write_report`."""
    document = session.document
    prepare_report(path)
    name = document.now.mesh.name
    arguments = path, tr("Report on {name}", name=name or stem), name, stationary(scene), versions_of(session)
    file = () if document.path is None or not document.path.exists() else (str(document.path),)
    event = FileExported("report", write_report, (*arguments, *file))
    return Export(event, draw_report(*event.arguments), FIGURES)
