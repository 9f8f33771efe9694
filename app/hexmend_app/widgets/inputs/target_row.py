"""Row that edits the path of a file to write."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFileDialog, QHBoxLayout, QLineEdit, QPushButton, QWidget

from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import labelled, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_replacing, folder, named, remember_folder


class TargetRow(QWidget):
    """Text field for the path of a file, with a button that opens a file dialog.

    Parameters
    ----------
    title : str
        Title of the file dialog.
    name : str
        Default file name.
    kinds : str
        Kinds of file in the notation of Qt; a name without a suffix gets that of the first kind.
    help : str
        Tooltip of the text field.

    Signals
    -------
    edited
        The path has changed.
    """

    edited = Signal()

    def __init__(self, title: str, name: str, kinds: str, help: str, parent: QWidget | None = None):
        super().__init__(parent)
        self._title, self._kinds = title, kinds
        self._replaced = ""  # path that the file dialog has confirmed to be replaced
        self.line = QLineEdit(str(folder() / name))
        set_help(self.line, tr("File"), help)
        self.line.textChanged.connect(lambda: self.edited.emit())
        browse = QPushButton(tr("Browse…"))
        browse.clicked.connect(self._browse)
        fill(QHBoxLayout(self), labelled(tr("File"), self.line), (self.line, 1), browse, margins=(0, 0, 0, 0))

    @property
    def empty(self) -> bool:
        """True if no path is entered."""
        return not self.line.text().strip()

    def path(self) -> Path:
        """Return the path; a name without a suffix gets one."""
        path = Path(self.line.text())
        with suppress(RuntimeError):  # unknown home folder
            path = path.expanduser()
        return Path(named(str(path), self._kinds))

    def committed(self) -> bool:
        """Ask before an existing file is replaced; return True if the file may be written."""
        path = str(self.path())
        if path != self._replaced and not ask_replacing(self, path):
            return False
        remember_folder(self.path())
        return True

    def _browse(self) -> None:
        path, kind = QFileDialog.getSaveFileName(self, self._title, self.line.text(), self._kinds)
        if path:
            self._replaced = path  # another file if a suffix is appended
            self.line.setText(named(path, kind or self._kinds))
