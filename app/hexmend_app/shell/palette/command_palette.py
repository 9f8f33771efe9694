"""Command palette: finds commands by parts of their names."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import Qt
from PySide6.QtGui import QBrush, QColor, QKeyEvent
from PySide6.QtWidgets import QDialog, QHeaderView, QLineEdit, QTreeWidget, QTreeWidgetItem, QVBoxLayout, QWidget

from hexmend_app.shell.palette.ranking import PaletteEntry, ranked
from hexmend_app.theme.palette import MUTED
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import note, on_theme_change, set_help
from hexmend_app.translation import tr

#: Keys that move in the list while the text field has the focus.
_MOVES = (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_PageUp, Qt.Key.Key_PageDown)

_WIDTH = 590


class _Field(QLineEdit):
    """Text field whose arrow keys move in a list."""

    def __init__(self, tree: QTreeWidget):
        super().__init__()
        self._tree = tree

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Pass arrow keys to the list."""
        if event.key() in _MOVES:
            self._tree.keyPressEvent(event)
        else:
            super().keyPressEvent(event)


class CommandPalette(QDialog):
    """Dialog that finds commands by name, best match first, and runs them."""

    def __init__(self, entries: Iterable[PaletteEntry], parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("command_palette")
        self.setWindowTitle(tr("Commands"))
        self.setWindowFlag(Qt.WindowType.FramelessWindowHint)
        self._entries = list(entries)
        self._found: list[PaletteEntry] = []
        self._list = QTreeWidget()
        self._field = _Field(self._list)
        self._field.setPlaceholderText(tr("Find a command, panel, method or metric"))
        set_help(self._field, tr("Command"), tr("Type parts of its name in any order; Enter runs the selected entry."))
        self._list.setColumnCount(2)
        self._list.setHeaderHidden(True)
        self._list.setRootIsDecorated(False)
        self._list.setUniformRowHeights(True)
        self._list.setAccessibleName(tr("Commands"))
        self._list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._list.header().setStretchLastSection(False)
        self._list.header().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        self._list.header().setSectionResizeMode(1, QHeaderView.ResizeMode.ResizeToContents)
        self._nothing = note(tr("No matches."))
        fill(QVBoxLayout(self), self._field, self._list, self._nothing, margins=(8, 8, 8, 8))
        self.resize(_WIDTH, 380)
        self._field.textChanged.connect(self._fill)
        self._field.returnPressed.connect(self._run_entry)
        self._list.itemClicked.connect(self._run_entry)
        on_theme_change(self, self._fill)

    def titles(self) -> list[str]:
        """Return the titles of the listed entries, best match first."""
        return [entry.title for entry in self._found]

    def _fill(self, *_: object) -> None:
        self._found = ranked(self._entries, self._field.text())
        self._list.clear()
        self._list.addTopLevelItems([_item(entry) for entry in self._found])
        self._list.setCurrentItem(self._list.topLevelItem(0))
        self._nothing.setVisible(not self._found)

    def _run_entry(self) -> None:
        at = self._list.indexOfTopLevelItem(self._list.currentItem()) if self._found else -1
        if at >= 0 and self._found[at].enabled:
            self.accept()
            self._found[at].run()


def _item(entry: PaletteEntry) -> QTreeWidgetItem:
    item = QTreeWidgetItem([entry.title, entry.keys])
    item.setIcon(0, entry.icon)
    item.setToolTip(0, entry.help)
    item.setTextAlignment(1, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
    item.setForeground(1, QBrush(QColor(str(MUTED))))
    if not entry.enabled:
        item.setDisabled(True)
    return item
