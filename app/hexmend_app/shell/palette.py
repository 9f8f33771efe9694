"""Every command by name: type some letters of it, press Enter."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QBrush, QColor, QKeyEvent
from PySide6.QtWidgets import QDialog, QLineEdit, QTreeWidget, QTreeWidgetItem, QVBoxLayout, QWidget

from hexmend_app.widgets.style import MUTED, dress, explain, note

#: Keys that move in the list while the cursor stands in the field.
_MOVES = (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_PageUp, Qt.Key.Key_PageDown)


class _Field(QLineEdit):
    """A field whose arrow keys walk in a list."""

    def __init__(self, beside: QTreeWidget):
        super().__init__()
        self._beside = beside

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Hand arrow keys on."""
        if event.key() in _MOVES:
            self._beside.keyPressEvent(event)
        else:
            super().keyPressEvent(event)


class CommandPalette(QDialog):
    """Finds an action and triggers it.

    Parameters
    ----------
    actions : sequence of QAction
        Those that are disabled are left out.
    """

    def __init__(self, actions: Sequence[QAction], parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle("Commands")
        self.setWindowFlag(Qt.WindowType.FramelessWindowHint)
        self._list = QTreeWidget()
        self._field = _Field(self._list)
        self._field.setPlaceholderText("Type some letters of a command")
        explain(self._field, "Command", "Letters of the command, in any order of words; Enter carries it out.")
        self._list.setColumnCount(2)
        self._list.setHeaderHidden(True)
        self._list.setRootIsDecorated(False)
        self._list.setUniformRowHeights(True)
        self._list.setAccessibleName("Commands")
        self._list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._actions = [action for action in actions if action.isEnabled() and not action.isSeparator()]
        for action in self._actions:
            self._list.addTopLevelItem(_item(action))
        dress(self, self._paint)
        self._list.resizeColumnToContents(1)
        self._list.header().setStretchLastSection(False)
        self._list.setColumnWidth(0, 400)
        self._nothing = note("No command has these letters.")
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 8)
        for part in (self._field, self._list, self._nothing):
            layout.addWidget(part)
        self.resize(560, 380)
        self._field.textChanged.connect(self._filter)
        self._field.returnPressed.connect(self._carry_out)
        self._list.itemClicked.connect(self._carry_out)
        self._filter("")

    def found(self) -> list[str]:
        """The commands listed now."""
        return [item.text(0) for item in self._items() if not item.isHidden()]

    def _items(self) -> list[QTreeWidgetItem]:
        return [self._list.topLevelItem(k) for k in range(self._list.topLevelItemCount())]

    def _paint(self) -> None:
        for item in self._items():
            item.setForeground(1, QBrush(QColor(str(MUTED))))

    def _filter(self, text: str) -> None:
        words = text.lower().split()
        first = None
        for item in self._items():
            said = f"{item.text(0)} {item.toolTip(0)}".lower()
            item.setHidden(not all(word in said for word in words))
            if first is None and not item.isHidden():
                first = item
        self._list.setCurrentItem(first)
        self._nothing.setVisible(first is None)

    def _carry_out(self) -> None:
        item = self._list.currentItem()
        if item is not None and not item.isHidden():
            action = self._actions[self._list.indexOfTopLevelItem(item)]
            self.accept()
            action.trigger()


def _item(action: QAction) -> QTreeWidgetItem:
    within = action.property("within")
    name = action.text().replace("&", "")
    item = QTreeWidgetItem([f"{within}: {name}" if within else name, action.shortcut().toString()])
    item.setIcon(0, action.icon())
    item.setToolTip(0, action.statusTip())
    item.setTextAlignment(1, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
    if action.isCheckable():
        item.setText(0, f"{item.text(0)}: {'on' if action.isChecked() else 'off'}")
    return item
