"""The files that were opened last, kept in the settings."""

from __future__ import annotations

import json
from pathlib import Path

from PySide6.QtCore import QObject, QSettings, Signal

#: Files that are remembered.
MOST = 10


class Recent(QObject):
    """Remembers files, the newest first.

    Signals
    -------
    changed
    """

    changed = Signal()

    def files(self) -> list[Path]:
        """The files, whether they are still there or not."""
        return [Path(path) for path in json.loads(QSettings().value("recent", "[]"))]

    def add(self, path: Path) -> None:
        """Remember a file that was opened."""
        path = path.resolve()
        self._keep([path, *(other for other in self.files() if other != path)][:MOST])

    def clear(self) -> None:
        """Forget all files."""
        self._keep([])

    def _keep(self, files: list[Path]) -> None:
        QSettings().setValue("recent", json.dumps([str(path) for path in files]))
        self.changed.emit()
