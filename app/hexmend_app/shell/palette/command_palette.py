"""The command palette: commands are found by typing a part of their name."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import Qt
from PySide6.QtGui import QBrush, QColor, QIcon, QKeyEvent, QPainter, QPaintEvent, QPixmap
from PySide6.QtWidgets import QDialog, QHeaderView, QLineEdit, QTreeWidget, QTreeWidgetItem, QVBoxLayout, QWidget

from hexmend_app.shell.palette.ranking import PaletteEntry, ranked
from hexmend_app.theme.style import GREY, MUTED, note, on_theme_change, set_help

#: Keys that move in the list while the cursor stands in the field.
_MOVES = (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_PageUp, Qt.Key.Key_PageDown)

_WIDTH = 590


class _Field(QLineEdit):
    """A text field whose arrow keys move in a list."""

    def __init__(self, neighbour: QTreeWidget):
        super().__init__()
        self._neighbour = neighbour

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Pass arrow keys to the list."""
        if event.key() in _MOVES:
            self._neighbour.keyPressEvent(event)
        else:
            super().keyPressEvent(event)


class CommandPalette(QDialog):
    """Finds commands by name, best match first, and runs them.

    Parameters
    ----------
    entries : iterable of Entry
    """

    def __init__(self, entries: Iterable[PaletteEntry], parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle("Commands")
        self.setWindowFlag(Qt.WindowType.FramelessWindowHint)
        self._entries = list(entries)
        self._found: list[PaletteEntry] = []
        self._list = QTreeWidget()
        self._field = _Field(self._list)
        self._field.setPlaceholderText("Type some letters of a command, a panel, a method, a metric or a setting")
        set_help(self._field, "Command", "Letters of what is looked for, in any order of words; Enter does it.")
        self._list.setColumnCount(2)
        self._list.setHeaderHidden(True)
        self._list.setRootIsDecorated(False)
        self._list.setUniformRowHeights(True)
        self._list.setAccessibleName("Commands")
        self._list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._list.header().setStretchLastSection(False)
        self._list.header().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        self._list.header().setSectionResizeMode(1, QHeaderView.ResizeMode.ResizeToContents)
        self._nothing = note("Nothing has these letters.")
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 8)
        for part in (self._field, self._list, self._nothing):
            layout.addWidget(part)
        self.resize(_WIDTH, 380)
        self._field.textChanged.connect(self._fill)
        self._field.returnPressed.connect(self._run_entry)
        self._list.itemClicked.connect(self._run_entry)
        on_theme_change(self, self._fill)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the frame, which a frameless window lacks."""
        super().paintEvent(event)
        painter = QPainter(self)
        painter.setPen(QColor(str(GREY)))
        painter.drawRect(self.rect().adjusted(0, 0, -1, -1))

    def found(self) -> list[str]:
        """The entries that are listed, best match first."""
        return [one.title for one in self._found]

    def _fill(self, *_: object) -> None:
        self._found = ranked(self._entries, self._field.text())
        self._list.clear()
        self._list.addTopLevelItems([_item(one) for one in self._found])
        self._list.setCurrentItem(self._list.topLevelItem(0))
        self._nothing.setVisible(not self._found)

    def _run_entry(self) -> None:
        at = self._list.indexOfTopLevelItem(self._list.currentItem()) if self._found else -1
        if at >= 0:
            self.accept()
            self._found[at].do()


def _no_icon() -> QIcon:
    """An empty icon, so that titles without an icon are aligned with the others."""
    empty = QPixmap(16, 16)
    empty.fill(Qt.GlobalColor.transparent)
    return QIcon(empty)


def _item(entry: PaletteEntry) -> QTreeWidgetItem:
    item = QTreeWidgetItem([entry.title, entry.keys])
    item.setIcon(0, entry.icon if not entry.icon.isNull() else _no_icon())
    item.setToolTip(0, entry.help)
    item.setTextAlignment(1, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
    item.setForeground(1, QBrush(QColor(str(MUTED))))
    return item
