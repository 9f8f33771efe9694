"""The files that were opened last, kept in the settings."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, Signal

from hexmend_app.state.settings.settings import RECENT

#: Files that are remembered.
MOST = 10


class RecentFiles(QObject):
    """Remembers files, the newest first.

    Signals
    -------
    changed
    """

    changed = Signal()

    def files(self) -> list[Path]:
        """The files, whether they are still there or not."""
        return list(RECENT.get())

    def add(self, path: Path) -> None:
        """Remember a file that was opened."""
        path = path.resolve()
        self._keep([path, *(other for other in self.files() if other != path)][:MOST])

    def clear(self) -> None:
        """Forget all files."""
        self._keep([])

    def _keep(self, files: list[Path]) -> None:
        RECENT.set(tuple(files))
        self.changed.emit()
