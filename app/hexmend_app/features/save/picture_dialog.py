"""Asks where a picture of the view goes and how large it is."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QSize
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFileDialog,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QSpinBox,
    QWidget,
)

from hexmend.errors import FileError
from hexmend_app.widgets.questions import ask_replacing, folder, named, remember_folder
from hexmend_app.widgets.style import WORSE, explain, note

_PRESETS = (("Full HD", 1920, 1080), ("4K", 3840, 2160), ("Square, for print", 3000, 3000))
_LARGEST = 8192
_KIND = "PNG picture (*.png)"


class PictureDialog(QDialog):
    """A path, a size in pixels, and whether the background is left out.

    Parameters
    ----------
    view : QSize
        Of the 3D view, in device pixels: the size proposed.
    name : str
        The file name proposed.
    """

    def __init__(self, view: QSize, name: str, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle("Save picture")
        self._path = QLineEdit(str(folder() / name))
        self._path.setMinimumWidth(360)
        self._path.textChanged.connect(lambda: self._refuse(""))
        self._replaced = ""  # the file that may be replaced, as a dialog of the desktop has asked
        self._problem = note("", WORSE)
        self._problem.setAccessibleName("What is wrong")
        browse = QPushButton("Browse…")
        browse.clicked.connect(self._browse)
        where = QHBoxLayout()
        where.addWidget(self._path, 1)
        where.addWidget(browse)

        self._preset = QComboBox()
        for title, width, height in (("As the view", view.width(), view.height()), *_PRESETS):
            self._preset.addItem(f"{title} ({width} × {height})", (width, height))
        self._preset.addItem("Other", None)
        self._width, self._height = QSpinBox(), QSpinBox()
        for box, title in ((self._width, "Width"), (self._height, "Height")):
            box.setRange(16, _LARGEST)
            box.setSuffix(" px")
            explain(box, title, f"{title} of the picture in pixels, whatever the size of the window.")
        self._preset.currentIndexChanged.connect(self._on_preset)
        size = QHBoxLayout()
        for part in (self._width, QLabel("×"), self._height):
            size.addWidget(part)
        size.addStretch()
        self._transparent = QCheckBox("Leave the background transparent")

        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Save | QDialogButtonBox.StandardButton.Cancel)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        form = QFormLayout(self)
        form.addRow("File", where)
        form.addRow("", self._problem)
        form.addRow("Size", self._preset)
        form.addRow("", size)
        form.addRow("", self._transparent)
        form.addRow(buttons)
        self._refuse("")
        self._on_preset()

    def path(self) -> Path:
        """Where the picture goes; a name without a suffix gets one."""
        return Path(named(str(Path(self._path.text()).expanduser()), _KIND))

    def picture_size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        return self._width.value(), self._height.value()

    def transparent(self) -> bool:
        """Whether the background is left out."""
        return self._transparent.isChecked()

    def accept(self) -> None:
        """Close where a picture can be written to the path, and remember its folder; or say why not."""
        from hexmend_app.scene.export.sheet import format_of

        if not self._path.text().strip():
            self._refuse("Name the file that the picture goes to.")
            return
        try:
            format_of(self.path())
        except FileError as error:
            self._refuse(str(error))
            return
        if str(self.path()) == self._replaced or ask_replacing(self, str(self.path())):
            remember_folder(self.path())
            super().accept()

    def _refuse(self, problem: str) -> None:
        self._problem.setText(problem)
        self._problem.setVisible(bool(problem))
        self.adjustSize()

    def _on_preset(self) -> None:
        size = self._preset.currentData()
        for box, value in zip((self._width, self._height), size or self.picture_size(), strict=True):
            box.setEnabled(size is None)
            box.setValue(value)

    def _browse(self) -> None:
        path, _ = QFileDialog.getSaveFileName(self, "Save picture", self._path.text(), _KIND)
        if path:
            self._replaced = path
            self._path.setText(path)
