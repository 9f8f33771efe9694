"""Feature that exports the figure set, figure by figure in the background."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from hexmend.errors import HexmendError
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.picture import Page
from hexmend_app.state.session.user_events import FileExported
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_figures
from hexmend_app.widgets.incremental_task import IncrementalTask


class FeatureFigures(Feature):
    """Writes pictures, charts and the table of the mesh before and after into a folder."""

    order = 13

    def __init__(self, host: Host):
        super().__init__(host)
        self._folder = Path()
        self._event: FileExported | None = None
        self._drawing = IncrementalTask(
            host.busy, "figures", tr("Cancel the export; files already written are kept."), self
        )
        self._drawing.finished.connect(self._on_drawn)
        self._drawing.failed.connect(self._on_failed)
        self.session.document.mesh_replaced.connect(self.cancel)

    def actions(self) -> Sequence[Action]:
        """Return the action that exports the figure set."""
        return (
            Action(
                id="figure_set",
                text=tr("E&xport figure set…"),
                menu="File",
                part=1,
                icon="image-multiple-outline",
                help=tr("Save pictures, distributions, convergence and a table, with captions and commands."),
                handle=self.ask,
                enabled=lambda: self.canvas is not None and not self.session.run.busy and not self.going_on,
            ),
        )

    def close(self) -> None:
        """Cancel the export."""
        self.cancel()

    @property
    def going_on(self) -> bool:
        """True while figures are being drawn."""
        return self._drawing.going_on

    def ask(self) -> None:
        """Ask for a folder, and write the figure set into it."""
        folder = ask_figures(self.host.dialog_parent, self.host.stem)
        if folder:
            self.write(Path(folder))

    def write(self, folder: Path) -> None:
        """Write the figure set into a folder, which is created if missing."""
        self.cancel()
        try:
            self._begin(folder)
        except HexmendError as error:
            self.host.messages.show_error(tr("Figure set not exported"), str(error))

    def cancel(self) -> None:
        """Cancel the export; files already written are kept."""
        self._drawing.cancel()

    def _begin(self, folder: Path) -> None:
        from hexmend_app.features.figures.drawing import draw, prepare, write_set
        from hexmend_app.features.figures.versions import recipes_of, versions_of
        from hexmend_app.report.figure_set import stationary

        document = self.session.document
        page = Page(pixels=(self.canvas.width(), self.canvas.height()))
        scene = stationary(self.canvas.scene(page, self.session.saved_cameras.all))
        recipes, versions = recipes_of(self.session), versions_of(self.session)
        prepare(folder, scene, recipes)
        arguments = folder, self.host.stem, document.now.mesh.name, scene, versions, recipes
        file = () if document.path is None else (str(document.path),)
        self._folder = folder
        self._event = FileExported("figure set", write_set, (*arguments, *file))
        self._drawing.begin(draw(*self._event.arguments), _progress_text)

    def _on_failed(self, error: Exception) -> None:
        self.host.messages.show_error(
            tr("Figure set not exported"), tr("A figure could not be drawn: {error}", error=error)
        )

    def _on_drawn(self) -> None:
        self.host.messages.show_info(tr("Figure set saved to {folder}", folder=self._folder))
        self.session.user_event.emit(self._event)


def _progress_text(drawn: int) -> str:
    """Return the progress text after a number of figures."""
    from hexmend_app.report.figure_set import PARTS

    at = min(drawn, len(PARTS) - 1)
    return tr("Drawing figure {at} of {count}: {part}…", at=at + 1, count=len(PARTS), part=list(PARTS)[at])
