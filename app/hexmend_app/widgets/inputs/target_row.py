"""A file that something is written to: typed, or chosen in a dialog of the desktop."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFileDialog, QHBoxLayout, QLabel, QLineEdit, QPushButton, QWidget

from hexmend_app.theme.style import set_help
from hexmend_app.widgets.dialogs.questions import ask_replacing, folder, named, remember_folder


class TargetRow(QWidget):
    """Edits the path of a file.

    Parameters
    ----------
    title : str
        Of the dialog that chooses it.
    name : str
        The file name proposed.
    kinds : str
        Kinds of file, as Qt's dialogs take them; a name without a suffix gets that of the first.
    help : str

    Signals
    -------
    edited
        The user named another file.
    """

    edited = Signal()

    def __init__(self, title: str, name: str, kinds: str, help: str, parent: QWidget | None = None):
        super().__init__(parent)
        self._title, self._kinds = title, kinds
        self._replaced = ""  # the file that may be replaced, as a dialog of the desktop has asked
        self.line = QLineEdit(str(folder() / name))
        set_help(self.line, "File", help)
        self.line.textChanged.connect(lambda: self.edited.emit())
        browse = QPushButton("Browse…")
        browse.clicked.connect(self._browse)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        label = QLabel("File")
        label.setBuddy(self.line)
        row.addWidget(label)
        row.addWidget(self.line, 1)
        row.addWidget(browse)

    @property
    def empty(self) -> bool:
        """Return True without a path."""
        return not self.line.text().strip()

    def path(self) -> Path:
        """The file; a name without a suffix gets one."""
        path = Path(self.line.text())
        with suppress(RuntimeError):  # of nobody's home
            path = path.expanduser()
        return Path(named(str(path), self._kinds))

    def committed(self) -> bool:
        """Ask before an existing file is replaced; return True if it may be written."""
        path = str(self.path())
        if path != self._replaced and not ask_replacing(self, path):
            return False
        remember_folder(self.path())
        return True

    def _browse(self) -> None:
        path, kind = QFileDialog.getSaveFileName(self, self._title, self.line.text(), self._kinds)
        if path:
            self._replaced = path  # with a suffix that it has not it is another file
            self.line.setText(named(path, kind or self._kinds))
