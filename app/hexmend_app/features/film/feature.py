"""Feature that saves a run as a film, frame by frame in the background."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from hexmend.errors import HexmendError
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.features.film.film_dialog import FilmChoice, FilmDialog
from hexmend_app.picture import Page
from hexmend_app.state.mesh.run_record import RecordedIteration, RunRecord
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_film
from hexmend_app.widgets.incremental_task import IncrementalTask

if TYPE_CHECKING:
    from PIL import Image


class FeatureFilm(Feature):
    """Draws the iterations of the current run as in the view, and writes an animation."""

    order = 59

    def __init__(self, host: Host):
        super().__init__(host)
        self._path = Path()
        self._choice: FilmChoice | None = None  # options used last
        self._rate = 0
        self._record: RunRecord | None = None
        self._drawing = IncrementalTask(host.busy, "film", tr("Cancel the film; no file is written."), self)
        self._drawing.finished.connect(self._write)
        self._drawing.failed.connect(self._on_failed)
        self.session.document.mesh_replaced.connect(self.cancel)

    def actions(self) -> Sequence[Action]:
        """Return the action that saves a film."""
        return (
            Action(
                id="film",
                text=tr("Save fil&m…"),
                menu="Timeline",
                part=2,
                icon="movie-open-outline",
                help=tr("Save the iterations of the run as an animation, as shown in the view."),
                handle=self.ask,
                enabled=lambda: self.canvas is not None and self.session.timeline.record is not None,
            ),
        )

    def close(self) -> None:
        """Cancel the film."""
        self.cancel()

    @property
    def going_on(self) -> bool:
        """True while a film is being written."""
        return self._drawing.going_on

    def ask(self) -> None:
        """Ask for the options and the file of the film, and make it."""
        timeline = self.session.timeline
        view = self.canvas.width(), self.canvas.height()
        proposed = self._choice or FilmChoice(rate=round(timeline.speed))
        dialog = FilmDialog(proposed, view, timeline.record.newest, self.host.dialog_parent)
        accepted, choice = dialog.exec(), dialog.choice()
        dialog.deleteLater()
        if not accepted:
            return
        self._choice = choice
        path = ask_film(self.host.dialog_parent, self.host.stem)
        if path:
            self.film(Path(path), choice)

    def film(self, path: Path, choice: FilmChoice) -> None:
        """Make a film of the current run; the file is written after the last frame is drawn."""
        from hexmend_app.scene.film.film_files import format_of
        from hexmend_app.scene.film.film_frames import chosen_iterations, film_frames, pictures

        self.cancel()
        record, history = self.session.timeline.record, self.session.history
        try:
            format_of(path)
        except HexmendError as error:
            self.host.messages.show_error(tr("Film not saved"), str(error))
            return
        numbers = chosen_iterations(history, record, choice.frames)
        size = choice.size((self.canvas.width(), self.canvas.height()))
        now = self.session.document.now
        states = film_frames(record, numbers, lambda number: history.state(RecordedIteration(record, number), now.mesh))
        scene = self.canvas.scene(Page(pixels=size))
        self._path, self._record, self._rate = path, record, choice.rate
        movement = self.canvas.viewport.frame.movement
        frames = pictures(states, scene, movement=movement, histogram=choice.histogram, before=choice.before)
        self._drawing.begin(frames, lambda drawn: _progress_text(drawn, len(numbers), path))

    def cancel(self) -> None:
        """Cancel the film; no file is written."""
        self._drawing.cancel()

    def refresh(self) -> None:
        """Cancel the film if its run was deleted."""
        if self.going_on and self._record not in self.session.history.records:
            self.cancel()
            self.host.messages.show_error(
                tr("Film not saved"), tr("The run was deleted before the last frame was drawn.")
            )

    def _on_failed(self, error: Exception) -> None:
        text = tr("Frame not drawn: {error}.", error=str(error).rstrip("."))
        self.host.messages.show_error(tr("Film not saved"), text)

    def _write(self, frames: list[Image.Image]) -> None:
        from hexmend_app.scene.film.film_files import write_film

        self.host.try_and_report(
            tr("Film not saved"),
            lambda: write_film(self._path, frames, self._rate),
            tr("Film of {count} frames saved to {path}", count=len(frames), path=self._path),
        )


def _progress_text(drawn: int, count: int, path: Path) -> str:
    """Return the progress text after a number of frames."""
    return (
        tr("Drawing frame {drawn} of {count}…", drawn=drawn + 1, count=count)
        if drawn < count
        else tr("Writing {name}…", name=path.name)
    )
