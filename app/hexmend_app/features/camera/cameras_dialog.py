"""Dialog that applies, renames and deletes saved cameras."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QListWidget,
    QListWidgetItem,
    QMenu,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from hexmend.errors import ParameterError
from hexmend_app.state.view.saved_cameras import SavedCameras
from hexmend_app.theme.palette import WORSE
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import note, set_help, show_text
from hexmend_app.translation import tr

_NAME = Qt.ItemDataRole.UserRole


class CamerasDialog(QDialog):
    """List of saved cameras with buttons for the selected camera.

    Parameters
    ----------
    cameras : SavedCameras

    Signals
    -------
    chosen(name)
        The user applied a camera; the dialog stays open.
    """

    chosen = Signal(str)

    def __init__(self, cameras: SavedCameras, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle(tr("Saved cameras"))
        self._cameras = cameras
        self.list = QListWidget()
        set_help(
            self.list, tr("Saved cameras"), tr("Double-click to apply a camera, F2 to rename it, Delete to delete it.")
        )
        self.list.setEditTriggers(QListWidget.EditTrigger.EditKeyPressed)
        self._problem = note("", WORSE)
        self._problem.setAccessibleName(tr("Error"))
        self._buttons = [QPushButton(text) for text in (tr("&Go to"), tr("&Rename"), tr("&Delete"))]
        for button, act in zip(self._buttons, (self._go, self._edit, self._delete), strict=True):
            button.setAutoDefault(False)
            button.clicked.connect(act)
        self.list.itemActivated.connect(self._go)
        self.list.itemChanged.connect(self._rename)
        self.list.currentRowChanged.connect(self._enable)
        QShortcut(QKeySequence(QKeySequence.StandardKey.Delete), self.list, self._delete,
                  context=Qt.ShortcutContext.WidgetShortcut)  # fmt: skip
        self._lay_out()
        self._fill()
        # Queued: the list must not be refilled while its editor is open.
        cameras.changed.connect(self._on_changed, Qt.ConnectionType.QueuedConnection)

    def _lay_out(self) -> None:
        column = fill(QVBoxLayout(), *self._buttons, None)
        row = fill(QHBoxLayout(), (self.list, 1), column)
        close = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        close.rejected.connect(self.reject)
        fill(QVBoxLayout(self), (row, 1), self._problem, close)
        self._problem.hide()
        self.resize(380, 260)

    @property
    def _name(self) -> str:
        """Name of the selected camera, "" if none is selected."""
        item = self.list.currentItem()
        return "" if item is None else item.data(_NAME)

    def _go(self) -> None:
        if self._name:
            self.chosen.emit(self._name)

    def _edit(self) -> None:
        if self.list.currentItem() is not None:
            self.list.editItem(self.list.currentItem())

    def _delete(self) -> None:
        if self._name:
            self._cameras.remove(self._name)

    def _rename(self, item: QListWidgetItem) -> None:
        """Rename a camera, or show the reason if the name is rejected."""
        name, before = item.text().strip(), item.data(_NAME)
        problem = ""
        try:
            if name != before and name in self._cameras.all:
                problem = tr(
                    "A camera “{name}” already exists. Choose another name, or delete that camera first.", name=name
                )
            elif name != before:
                self._cameras.rename(before, name)
                return
        except ParameterError as error:
            problem = f"{error}."
        self.list.blockSignals(True)
        item.setText(before)
        self.list.blockSignals(False)
        show_text(self._problem, problem)

    def _on_changed(self) -> None:
        """Refresh the list and keep the selected row."""
        row = self.list.currentRow()
        show_text(self._problem, "")
        self._fill()
        self.list.setCurrentRow(min(max(row, 0), self.list.count() - 1))

    def _fill(self) -> None:
        self.list.blockSignals(True)
        self.list.clear()
        for name in self._cameras.all:
            item = QListWidgetItem(name)
            item.setData(_NAME, name)
            item.setFlags(item.flags() | Qt.ItemFlag.ItemIsEditable)
            self.list.addItem(item)
        self.list.setCurrentRow(0 if self.list.count() else -1)
        self.list.blockSignals(False)
        self._enable()

    def _enable(self) -> None:
        for button in self._buttons:
            button.setEnabled(bool(self._name))


class CamerasMenu(QMenu):
    """Menu that applies a saved camera.

    Parameters
    ----------
    cameras : SavedCameras

    Signals
    -------
    chosen(name)
        The user selected a camera.
    """

    chosen = Signal(str)

    def __init__(self, cameras: SavedCameras, parent: QWidget | None = None):
        super().__init__(tr("Go to c&amera"), parent)
        self._cameras = cameras
        self.aboutToShow.connect(self._fill)
        cameras.changed.connect(self._enable)
        self._enable()

    def _enable(self) -> None:
        self.menuAction().setEnabled(bool(self._cameras.all))

    def _fill(self) -> None:
        self.clear()
        for number, name in enumerate(self._cameras.all, start=1):
            mnemonic = f"&{number % 10}  " if number <= 10 else "     "
            action = self.addAction(mnemonic + name.replace("&", "&&"))
            action.setStatusTip(tr("Apply the camera “{name}”.", name=name))
            action.triggered.connect(lambda _=False, name=name: self.chosen.emit(name))
