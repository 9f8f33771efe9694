"""Films of a run, drawn frame by frame while the window goes on."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QWidget

from hexmend.errors import HexmendError
from hexmend_app.state.session import Session
from hexmend_app.state.shots import chosen, shots
from hexmend_app.widgets.busy import Busy
from hexmend_app.widgets.message_bar import MessageBar
from hexmend_app.widgets.questions import ask_film

if TYPE_CHECKING:
    from PIL import Image

    from hexmend_app.canvas.canvas import Canvas

#: Most frames of a film, and its width in pixels: larger ones are not opened where they are sent to.
FRAMES, WIDTH = 60, 960


class Filming(QObject):
    """Draws the run that is gone through, as it is looked at, and writes the frames as one animated file.

    Parameters
    ----------
    parent : QWidget
        The dialog stands before it.
    session : Session
    busy : Busy
        Says how far it is, and has a way out.
    messages : MessageBar
    """

    def __init__(self, parent: QWidget, session: Session, busy: Busy, messages: MessageBar):
        super().__init__(parent)
        self._parent, self._session = parent, session
        self._busy, self._messages = busy, messages
        self.canvas: Canvas | None = None
        self._path = Path()
        self._count = 0
        self._frames: list[Image.Image] = []
        self._coming: Iterator[Image.Image] | None = None
        self._next = QTimer(self, interval=0)
        self._next.timeout.connect(self._draw_one)
        session.document.mesh_replaced.connect(self.cancel)

    def handlers(self) -> dict[str, Callable]:
        """What its actions do, by id."""
        return {"film": self.ask}

    def offered(self) -> dict[str, bool]:
        """Which of its actions can be done now."""
        return {"film": self._session.timeline.record is not None}

    @property
    def going_on(self) -> bool:
        """Whether a film is being made."""
        return self._coming is not None

    def ask(self) -> None:
        """Ask where the film goes, and make it."""
        path = ask_film(self._parent, self._session.document.name.partition(".")[0] or "mesh")
        if path:
            self.film(Path(path))

    def film(self, path: Path) -> None:
        """Make a film of the run that is gone through; it is written when its last frame is drawn."""
        from hexmend_app.scene.export.film import format_of, pictures

        self.cancel()
        record, history = self._session.timeline.record, self._session.history
        try:
            format_of(path)
        except HexmendError as error:
            self._messages.show_error("The film was not made", str(error))
            return
        numbers = chosen(history, record, FRAMES)
        view = self.canvas.viewport
        size = (WIDTH, round(WIDTH * self.canvas.height() / self.canvas.width() / 2) * 2)
        taken = shots(history, record, self._session.document.now.mesh, numbers)
        self._path, self._count, self._frames = path, len(numbers), []
        self._coming = pictures(taken, view.frame.look, size, camera=view.camera, movement=view.frame.movement)
        self._next.start()
        self._say()

    def cancel(self) -> None:
        """Give up the film that is being made; nothing is written."""
        if self.going_on:
            self._next.stop()
            self._coming.close()
            self._coming, self._frames = None, []
            self._busy.done()

    def _draw_one(self) -> None:
        frame = next(self._coming, None)
        if frame is not None:
            self._frames.append(frame)
            self._say()
            return
        frames, path = self._frames, self._path
        self.cancel()
        self._write(path, frames)

    def _write(self, path: Path, frames: list[Image.Image]) -> None:
        from hexmend_app.scene.export.film import write_film

        try:
            write_film(path, frames, self._session.timeline.speed)
        except HexmendError as error:
            self._messages.show_error("The film was not saved", str(error))
        else:
            self._messages.show_info(f"Film of {len(frames)} frames saved to {path}")

    def _say(self) -> None:
        word, help = "Cancel", "Give the film up; no file is written."
        drawn = len(self._frames)
        what = f"Drawing frame {drawn + 1} of {self._count}…" if drawn < self._count else f"Writing {self._path.name}…"
        self._busy.show_work(what, word, help, self.cancel)
