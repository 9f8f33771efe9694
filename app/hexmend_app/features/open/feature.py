"""Opening meshes: what is being read, a way to call it off, how it ended, and the files to open next time."""

from __future__ import annotations

from pathlib import Path

from hexmend.errors import FileError
from hexmend_app.resources import demo_mesh
from hexmend_app.state.document import Document
from hexmend_app.state.opener import Opener
from hexmend_app.state.recent import Recent
from hexmend_app.widgets.busy import Busy
from hexmend_app.widgets.message_bar import MessageBar
from hexmend_app.widgets.questions import remember_folder


class Opening:
    """Tells of what the opener does, and remembers what was opened.

    Parameters
    ----------
    document, opener, recent
        The window's state.
    busy : Busy
        Where it is said while it lasts.
    messages : MessageBar
        Where it is said how it ended.
    """

    def __init__(self, document: Document, opener: Opener, recent: Recent, busy: Busy, messages: MessageBar):
        self._document = document
        self._opener = opener
        self._recent = recent
        self._busy = busy
        self._messages = messages
        opener.began.connect(lambda path: self._tell(f"Reading {path.name}…"))
        opener.told.connect(self._tell)
        opener.ended.connect(self._on_ended)
        opener.cancelled.connect(self._on_cancelled)
        opener.failed.connect(self._on_failed)

    def _tell(self, what: str) -> None:
        if self._opener.busy:
            self._busy.show_work(what, "Cancel", "Do not open this mesh (Esc).", self._opener.cancel)

    def _on_ended(self, path: Path) -> None:
        self._busy.done()
        self._messages.clear()
        if path.resolve() != demo_mesh().resolve():
            remember_folder(path)
            self._recent.add(path)

    def _on_cancelled(self, path: Path) -> None:
        self._busy.done()
        self._messages.show_info(f"Opening {path.name} was cancelled.{self._what_stays()}")

    def _on_failed(self, path: Path, error: Exception) -> None:
        self._busy.done()
        detail = f"{error.problem}. {error.remedy}" if isinstance(error, FileError) else str(error)
        self._messages.show_error(f"{path.name} cannot be opened", f"{detail.strip()}{self._what_stays()}")

    def _what_stays(self) -> str:
        return f" {self._document.name} stays open." if self._document.is_open else ""
