"""Feature that exports the figure set and the report, figure by figure in the background."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from hexmend.errors import HexmendError
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.picture import Page, Scene
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_figures, ask_report
from hexmend_app.widgets.incremental_task import IncrementalTask

if TYPE_CHECKING:
    from hexmend_app.features.figures.exports import Export
    from hexmend_app.state.session.session import Session


class FeatureFigures(Feature):
    """Writes pictures, charts and the table of the mesh before and after: files in a folder, or one page."""

    order = 13

    def __init__(self, host: Host):
        super().__init__(host)
        self._saved = self._not_saved = ""
        self._drawing = IncrementalTask(
            host.busy, "figures", tr("Cancel the export; files already written are kept."), self
        )
        self._drawing.finished.connect(lambda: host.messages.show_info(self._saved))
        self._drawing.failed.connect(self._on_failed)
        self.session.document.mesh_replaced.connect(self.cancel)

    def actions(self) -> Sequence[Action]:
        """Return the actions that export the figure set and the report."""
        return (
            Action(
                id="report",
                text=tr("Export &report…"),
                menu="File",
                part=1,
                icon="file-document-outline",
                help=tr("Save one page, HTML or PDF, on the mesh before and after: pictures, quality, runs, advice."),
                handle=self.ask_report,
                enabled=self._can_draw,
            ),
            Action(
                id="figure_set",
                text=tr("E&xport figure set…"),
                menu="File",
                part=1,
                icon="image-multiple-outline",
                help=tr("Save pictures, distributions, convergence and a table, with captions and commands."),
                handle=self.ask,
                enabled=self._can_draw,
            ),
        )

    def close(self) -> None:
        """Cancel the export."""
        self.cancel()

    @property
    def going_on(self) -> bool:
        """True while figures are being drawn."""
        return self._drawing.going_on

    def _can_draw(self) -> bool:
        return self.canvas is not None and not self.session.run.busy and not self.going_on

    def ask(self) -> None:
        """Ask for a folder, and write the figure set into it."""
        folder = ask_figures(self.host.dialog_parent, self.host.stem)
        if folder:
            self.write(Path(folder))

    def ask_report(self) -> None:
        """Ask for a file, and write the report to it."""
        if path := ask_report(self.host.dialog_parent, self.host.stem):
            self.write_report(Path(path))

    def write(self, folder: Path) -> None:
        """Write the figure set into a folder, which is created if missing."""
        from hexmend_app.features.figures.exports import figure_set

        self._saved = tr("Figure set saved to {folder}", folder=folder)
        self._not_saved = tr("Figure set not exported")
        self._start(figure_set, folder)

    def write_report(self, path: Path) -> None:
        """Write the report to a file, HTML or PDF by its suffix."""
        from hexmend_app.features.figures.exports import report

        self._saved, self._not_saved = tr("Report saved to {path}", path=path), tr("Report not exported")
        self._start(report, path)

    def _start(self, prepare: Callable[[Session, Scene, Path, str], Export], path: Path) -> None:
        self.cancel()
        page = Page(pixels=(self.canvas.width(), self.canvas.height()))
        try:
            scene = self.canvas.scene(page, self.session.saved_cameras.all)
            export = prepare(self.session, scene, path, self.host.stem)
        except HexmendError as error:
            self.host.messages.show_error(self._not_saved, str(error))
            return
        self._drawing.begin(export.steps, export.progress_text)

    def cancel(self) -> None:
        """Cancel the export; files already written are kept."""
        self._drawing.cancel()

    def _on_failed(self, error: Exception) -> None:
        self.host.messages.show_error(self._not_saved, tr("Figure not drawn: {error}", error=error))
