"""Panel for tags: named groups of hexes that are saved with the mesh."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QHBoxLayout,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import labelled, note, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.tables.hex_table import shape_table
from hexmend_app.widgets.wording import figure

_TITLES = ("Tag", "Hexes", "Inverted", "q min")
_HINT = (
    "No tags. Select a hex and press T, or tag all shown or worst hexes. "
    "Tags are saved with the mesh in VTK and VTU files; hex groups of opened files appear here."
)
_BUSY = "Hexes cannot be tagged during a run, even a paused one. Stop the run; its result is kept."
_NAMELESS = "Enter a tag name in “Tag as”."
_NONE_SELECTED = "No hex selected: click a hex in the view, or press N for the worst, then press T to tag it."
_Trigger = QAbstractItemView.EditTrigger
_RENAMING = _Trigger.DoubleClicked | _Trigger.EditKeyPressed | _Trigger.AnyKeyPressed


@dataclass(frozen=True)
class TagRow:
    """Row of a tag: its number of hexes, of inverted hexes, and the minimum q (None without hexes)."""

    name: str
    hexes: int
    inverted: int
    q_min: float | None


class TagPanel(QWidget):
    """Table of the tags, with buttons to tag hexes.

    Signals
    -------
    toggle_requested(name)
        Tag or untag the selected hex.
    shown_requested(name), listed_requested(name)
        Tag all hexes shown in the view, or all in the list of the worst.
    isolate_requested(name), remove_requested(name)
    renamed(name, other)
    refused(str)
        The selected hex cannot be tagged; the reason as a sentence.
    """

    toggle_requested = Signal(str)
    shown_requested = Signal(str)
    listed_requested = Signal(str)
    isolate_requested = Signal(str)
    remove_requested = Signal(str)
    renamed = Signal(str, str)
    refused = Signal(str)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._rows: list[TagRow] = []
        self._busy = self._hex_selected = False
        self._name = QComboBox()
        self._name.setEditable(True)
        self._name.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)  # the list contains existing tags only
        self._name.completer().setCaseSensitivity(Qt.CaseSensitivity.CaseSensitive)
        self._name.setCurrentText("tagged")
        set_help(self._name, tr("Tag as"), tr("Name of the tag to add."))
        self._hex = self._button(tr("Hex"), tr("Tag the selected hex, or remove the tag (T)."))
        self._shown = self._button(tr("Shown"), tr("Tag all hexes shown in the view, except hidden ones."))
        self._listed = self._button(tr("Worst"), tr("Tag all hexes in the list of the worst."))
        self._isolate = self._button(tr("Isolate"), tr("Show only the hexes with this tag and their neighbours."))
        self._remove = self._button(tr("Remove"), tr("Remove this tag from all hexes."))
        self._table = self._make_table()
        self._hint = note(tr(_HINT))
        self._lay_out()
        self._hex.clicked.connect(self.toggle)
        self._shown.clicked.connect(lambda: self.shown_requested.emit(self.name))
        self._listed.clicked.connect(lambda: self.listed_requested.emit(self.name))
        self._isolate.clicked.connect(lambda: self.isolate_requested.emit(self._selected()))
        self._remove.clicked.connect(lambda: self.remove_requested.emit(self._selected()))
        self._name.editTextChanged.connect(self._enable)
        self._table.itemSelectionChanged.connect(self._enable)
        self._table.itemChanged.connect(self._on_edited)
        self._enable()

    def _button(self, text: str, help: str) -> QPushButton:
        button = QPushButton(text)
        set_help(button, text, help)
        return button

    def _make_table(self) -> QTableWidget:
        table = QTableWidget(0, len(_TITLES))
        table.setHorizontalHeaderLabels([tr(title) for title in _TITLES])
        shape_table(table, tr("Tags"), 0)
        table.horizontalHeaderItem(0).setTextAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        for column in range(1, len(_TITLES)):
            table.setColumnWidth(column, table.fontMetrics().horizontalAdvance("0,000,000") + 14)
        return table

    def _lay_out(self) -> None:
        label = labelled(tr("Tag as"), self._name)
        head = fill(QHBoxLayout(), label, (self._name, 1), self._hex, self._shown, self._listed, spacing=4)
        foot = fill(QHBoxLayout(), (self._hint, 1), self._isolate, self._remove, spacing=4)
        fill(QVBoxLayout(self), head, (self._table, 1), foot, margins=(8, 4, 8, 4), spacing=4)

    @property
    def name(self) -> str:
        """Name of the tag to add; "" if empty."""
        return self._name.currentText().strip()

    def set_name(self, name: str) -> None:
        """Set the name of the tag."""
        self._name.setCurrentText(name)

    @property
    def can_toggle(self) -> bool:
        """True if the selected hex can be tagged."""
        return not self.obstacle

    @property
    def obstacle(self) -> str:
        """Reason why the selected hex cannot be tagged, as a sentence; "" if it can."""
        if self._busy:
            return tr(_BUSY)
        if not self.name:
            return tr(_NAMELESS)
        return "" if self._hex_selected else tr(_NONE_SELECTED)

    def toggle(self) -> None:
        """Request to tag or untag the selected hex, or report why that is not possible."""
        if self.can_toggle:
            self.toggle_requested.emit(self.name)
        else:
            self.refused.emit(self.obstacle)

    def set_tags(self, rows: list[TagRow]) -> None:
        """Show the tags without sending a signal."""
        if rows == self._rows:
            return
        selected, name = self._selected(), self._name.currentText()
        self._rows = rows
        with QSignalBlocker(self._table), QSignalBlocker(self._name):
            self._table.setRowCount(len(rows))
            for at, row in enumerate(rows):
                for column, text in enumerate((row.name, f"{row.hexes:,}", f"{row.inverted:,}", figure(row.q_min))):
                    self._table.setItem(at, column, self._item(text, column))
            self._name.clear()
            self._name.addItems([row.name for row in rows])
            self._name.setCurrentText(name)
            names = [row.name for row in rows]
            if selected in names:
                self._table.selectRow(names.index(selected))
        self._enable()

    def _item(self, text: str, column: int) -> QTableWidgetItem:
        item = QTableWidgetItem(text)
        if column:
            item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
            item.setFlags(item.flags() & ~Qt.ItemFlag.ItemIsEditable)
        else:
            item.setToolTip(tr("Double-click to rename the tag."))
        return item

    def set_state(self, hex_selected: bool, busy: bool) -> None:
        """Set whether a hex is selected, and whether a run prevents tagging."""
        self._hex_selected, self._busy = hex_selected, busy
        self._enable()

    def _selected(self) -> str:
        at = self._table.currentRow() if self._table.selectedItems() else -1
        return self._rows[at].name if 0 <= at < len(self._rows) else ""

    def _on_edited(self, item: QTableWidgetItem) -> None:
        old, new = self._rows[item.row()].name, item.text().strip()
        exists = any(row.name == new for row in self._rows)
        if new and not exists and not self._busy:
            self.renamed.emit(old, new)
        else:
            with QSignalBlocker(self._table):
                item.setText(old)

    def _enable(self) -> None:
        possible = bool(self.name) and not self._busy
        self._hex.setEnabled(self.can_toggle)
        self._shown.setEnabled(possible)
        self._listed.setEnabled(possible)
        self._isolate.setEnabled(bool(self._selected()))
        self._remove.setEnabled(bool(self._selected()) and not self._busy)
        self._table.setEditTriggers(_Trigger.NoEditTriggers if self._busy else _RENAMING)
        hint = tr(_NONE_SELECTED) if self._rows else tr(_HINT)
        reason = self.obstacle
        self._hint.setText(hint if reason == tr(_NONE_SELECTED) else reason)
