"""Recently opened files, stored in the settings."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, Signal

from hexmend_app.state.settings.settings import RECENT

#: Maximum number of files.
MAX_RECENT_FILES = 10


class RecentFiles(QObject):
    """Recently opened files, newest first.

    Signals
    -------
    changed
    """

    changed = Signal()

    def files(self) -> list[Path]:
        """Return the files, whether they still exist or not."""
        return list(RECENT.get())

    def add(self, path: Path) -> None:
        """Add a file that was opened."""
        path = path.resolve()
        self._store([path, *(other for other in self.files() if other != path)][:MAX_RECENT_FILES])

    def clear(self) -> None:
        """Clear the list."""
        self._store([])

    def _store(self, files: list[Path]) -> None:
        RECENT.set(tuple(files))
        self.changed.emit()
