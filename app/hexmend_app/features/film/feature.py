"""Films of a run, drawn frame by frame while the window goes on."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QTimer

from hexmend.errors import HexmendError
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.features.film.film_dialog import FilmChoice, FilmDialog
from hexmend_app.scene.export.shots import chosen, shots
from hexmend_app.state.history import Record
from hexmend_app.widgets.questions import ask_film

if TYPE_CHECKING:
    from PIL import Image


class FeatureFilm(Feature):
    """Draws the run that is gone through, as it is looked at, and writes the frames as one animated file."""

    order = 59

    def __init__(self, host: Host):
        super().__init__(host)
        self._path = Path()
        self._choice: FilmChoice | None = None  # what the user wanted last
        self._count = self._rate = 0
        self._record: Record | None = None
        self._frames: list[Image.Image] = []
        self._coming: Iterator[Image.Image] | None = None
        self._next = QTimer(self, interval=0)
        self._next.timeout.connect(self._draw_one)
        self.session.document.mesh_replaced.connect(self.cancel)

    def actions(self) -> Sequence[Action]:
        """Save a film."""
        return (
            Action(
                id="film",
                text="Save a fil&m…",
                menu="Timeline",
                part=2,
                icon="movie-open-outline",
                help="Save the run as an animation: its iterations one after another, as the view shows them.",
                handle=self.ask,
                enabled=lambda: self.canvas is not None and self.session.timeline.record is not None,
            ),
        )

    def close(self) -> None:
        """Give up what is being made."""
        self.cancel()

    @property
    def going_on(self) -> bool:
        """Whether a film is being made."""
        return self._coming is not None

    def ask(self) -> None:
        """Ask what the film is to be like and where it goes, and make it."""
        timeline = self.session.timeline
        view = self.canvas.width(), self.canvas.height()
        usual = self._choice or FilmChoice(rate=round(timeline.speed))
        dialog = FilmDialog(usual, view, timeline.record.newest, self.host.window)
        if not dialog.exec():
            return
        self._choice = dialog.choice()
        path = ask_film(self.host.window, self.host.stem)
        if path:
            self.film(Path(path), self._choice)

    def film(self, path: Path, choice: FilmChoice) -> None:
        """Make a film of the run that is gone through; it is written when its last frame is drawn."""
        from hexmend_app.scene.export.film import format_of, pictures

        self.cancel()
        record, history = self.session.timeline.record, self.session.history
        try:
            format_of(path)
        except HexmendError as error:
            self.host.messages.show_error("The film was not made", str(error))
            return
        numbers = chosen(history, record, choice.frames)
        view = self.canvas.viewport
        size = choice.size((self.canvas.width(), self.canvas.height()))
        taken = shots(history, record, self.session.document.now.mesh, numbers)
        self._path, self._count, self._frames, self._record = path, len(numbers), [], record
        self._rate = choice.rate
        self._coming = pictures(
            taken, view.frame.look, size, camera=view.camera, movement=view.frame.movement, chart=choice.histogram
        )
        self._next.start()
        self._say()

    def cancel(self) -> None:
        """Give up the film that is being made; nothing is written."""
        if self.going_on:
            self._next.stop()
            self._coming.close()
            self._coming, self._frames = None, []
            self.host.busy.done("film")

    def refresh(self) -> None:
        """Give up the film of a run that is forgotten meanwhile."""
        if self.going_on and self._record not in self.session.history.records:
            self.cancel()
            self.host.messages.show_error("The film was not made", "Its run was forgotten before its last frame.")

    def _draw_one(self) -> None:
        try:
            frame = next(self._coming, None)
        except Exception as error:  # whatever it is, half a film is none
            self.cancel()
            self.host.messages.show_error("The film was not made", f"A frame could not be drawn: {error}.")
            return
        if frame is not None:
            self._frames.append(frame)
            self._say()
            return
        frames, path = self._frames, self._path
        self.cancel()
        self._write(path, frames)

    def _write(self, path: Path, frames: list[Image.Image]) -> None:
        from hexmend_app.scene.export.film import write_film

        self.host.said(
            "The film was not saved",
            lambda: write_film(path, frames, self._rate),
            f"Film of {len(frames)} frames saved to {path}",
        )

    def _say(self) -> None:
        word, help = "Cancel", "Give the film up; no file is written."
        drawn = len(self._frames)
        what = f"Drawing frame {drawn + 1} of {self._count}…" if drawn < self._count else f"Writing {self._path.name}…"
        self.host.busy.show_work("film", what, word, help, self.cancel)
