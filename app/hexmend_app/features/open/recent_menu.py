"""Menu of recent files."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QMenu, QWidget

from hexmend_app.state.settings.recent_files import RecentFiles
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import short_folder

#: Maximum width of a file's name and folder, in average letters.
_MAX_LETTERS = 60


def elide(text: str, widget: QWidget) -> str:
    """Return the name and folder of a file, elided in the middle if they are long, in the font of a widget."""
    metrics = widget.fontMetrics()
    return metrics.elidedText(text, Qt.TextElideMode.ElideMiddle, _MAX_LETTERS * metrics.averageCharWidth())


class RecentMenu(QMenu):
    """Lists the recent files; missing files are disabled.

    Parameters
    ----------
    recent : RecentFiles

    Signals
    -------
    chosen(Path)
        The user selected this file.
    """

    chosen = Signal(object)

    def __init__(self, recent: RecentFiles, parent: QWidget | None = None):
        super().__init__(tr("Open &recent"), parent)
        self._recent = recent
        self.setToolTipsVisible(True)
        self.aboutToShow.connect(self._fill)
        # Filled only when it is shown: a change may come from one of its own actions, which must not be deleted then.
        recent.changed.connect(self._update_enabled)
        self._update_enabled()

    def _update_enabled(self) -> None:
        self.menuAction().setEnabled(bool(self._recent.files()))

    def _fill(self) -> None:
        self.clear()
        files = self._recent.files()
        for number, path in enumerate(files, start=1):
            exists = path.exists()
            name = elide(f"{path.name}  ({short_folder(path)})", self).replace("&", "&&")
            action = self.addAction(f"&{number % 10}  {name}" + ("" if exists else tr(": not found")))
            action.setEnabled(exists)
            action.setToolTip(str(path) if exists else tr("{path} was moved, renamed or deleted.", path=path))
            action.setStatusTip(tr("Open {path}.", path=path))
            action.triggered.connect(lambda _=False, path=path: self.chosen.emit(path))
        self.addSeparator()
        clear = self.addAction(tr("&Clear list"))
        clear.setStatusTip(tr("Clear the list of recent files."))
        clear.triggered.connect(self._recent.clear)
