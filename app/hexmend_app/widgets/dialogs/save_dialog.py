"""Base of dialogs that edit the settings and the path of a file."""

from __future__ import annotations

import re

from PySide6.QtWidgets import QDialog, QDialogButtonBox, QLayout, QPushButton, QVBoxLayout, QWidget

from hexmend.errors import FileError, ParameterError
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import WORSE, note, show_text
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.target_row import TargetRow


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
        self._problem = note("", WORSE)
        self._problem.setAccessibleName(tr("Problem"))

    def lay_out_below(self, upper: QLayout, *additional: QPushButton) -> None:
        """Lay out path, problem and buttons, the `additional` ones on the left, below the layout of the settings."""
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Save | QDialogButtonBox.StandardButton.Cancel)
        for button in additional:
            buttons.addButton(button, QDialogButtonBox.ButtonRole.ResetRole)
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
