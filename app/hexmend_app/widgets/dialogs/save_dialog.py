"""Base of dialogs that edit the settings and the path of a file."""

from __future__ import annotations

import re
from contextlib import suppress
from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFileDialog,
    QHBoxLayout,
    QLayout,
    QLineEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from hexmend.errors import FileError, ParameterError
from hexmend_app.theme.palette import WORSE
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import labelled, set_help, show_text, small_label
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_replacing, folder, named, remember_folder


class SaveDialog(QDialog):
    """Base of dialogs with settings above a path; Save closes the dialog if the file can be written.

    Parameters
    ----------
    subject : str
        Name of what is saved, such as "the picture".
    name : str
        Default file name.
    kinds : str
        Kinds of file in the notation of Qt.

    Attributes
    ----------
    suffixes : list of str
        Suffixes of the kinds.
    """

    def __init__(self, subject: str, name: str, kinds: str, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle(tr("Save {subject}", subject=subject))
        self._subject = subject
        self.suffixes = re.findall(r"\*(\.\w+)", kinds)
        self.target = TargetRow(
            tr("Save {subject} as", subject=subject),
            name,
            kinds,
            tr("File to save {subject} to: {suffixes}.", subject=subject, suffixes=", ".join(self.suffixes)),
        )
        self.target.edited.connect(lambda: self.refuse(""))
        self._problem = small_label("", WORSE)
        self._problem.setAccessibleName(tr("Problem"))

    def lay_out_below(self, upper: QLayout) -> None:
        """Lay out path, problem and buttons below the layout of the settings."""
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Save | QDialogButtonBox.StandardButton.Cancel)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        fill(QVBoxLayout(self), (upper, 1), self.target, self._problem, buttons)
        self.refuse("")

    def check(self) -> None:
        """Raise `FileError` or `ParameterError` if the settings cannot be written to the path."""
        raise NotImplementedError

    def accept(self) -> None:
        """Close if the file can be written, else show the problem."""
        if self.target.empty:
            self.refuse(tr("Enter the name of the file to save {subject} to.", subject=self._subject))
            return
        try:
            self.check()
        except (FileError, ParameterError) as error:
            self.refuse(str(error))
            return
        if self.target.committed():
            super().accept()

    def refuse(self, problem: str) -> None:
        """Show a problem; "" hides it."""
        show_text(self._problem, problem)


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

    def propose(self, name: str, kinds: str) -> None:
        """Propose a name for another kind of file, in the same folder."""
        self._kinds = kinds
        self.line.setText(str(self.path().parent / name))

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
