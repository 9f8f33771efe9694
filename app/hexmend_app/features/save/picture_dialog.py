"""Asks where a picture of the view goes and how large it is."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QSettings, QSize
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

from hexmend_app.widgets.style import explain

_PRESETS = (("Full HD", 1920, 1080), ("4K", 3840, 2160), ("Square, for print", 3000, 3000))
_LARGEST = 8192


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
        folder = Path(str(QSettings().value("picture_folder", Path.home())))
        self._path = QLineEdit(str(folder / name))
        self._path.setMinimumWidth(360)
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
        form.addRow("Size", self._preset)
        form.addRow("", size)
        form.addRow("", self._transparent)
        form.addRow(buttons)
        self._on_preset()

    def path(self) -> Path:
        """Where the picture goes; .png is added where it is missing."""
        path = Path(self._path.text()).expanduser()
        return path if path.suffix.lower() == ".png" else path.with_name(path.name + ".png")

    def picture_size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        return self._width.value(), self._height.value()

    def transparent(self) -> bool:
        """Whether the background is left out."""
        return self._transparent.isChecked()

    def accept(self) -> None:
        """Remember the folder."""
        QSettings().setValue("picture_folder", str(self.path().parent))
        super().accept()

    def _on_preset(self) -> None:
        size = self._preset.currentData()
        for box, value in zip((self._width, self._height), size or self.picture_size(), strict=True):
            box.setEnabled(size is None)
            box.setValue(value)

    def _browse(self) -> None:
        path, _ = QFileDialog.getSaveFileName(self, "Save picture", self._path.text(), "PNG picture (*.png)")
        if path:
            self._path.setText(path)
