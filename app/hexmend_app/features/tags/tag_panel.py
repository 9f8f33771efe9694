"""Tags: named groups of elements that are saved with the mesh."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from hexmend_app.theme.style import note, set_help
from hexmend_app.widgets.tables.hex_table import shape_table
from hexmend_app.widgets.wording import figure

_TITLES = ("Tag", "Hexes", "Inverted", "q min")
_HINT = (
    "No hex is tagged. Choose one and press T, or tag all that are shown or listed as worst. "
    "Tags are saved with the mesh in VTK and VTU files; groups of hexes that a file holds appear here."
)
_BUSY = "Nothing can be tagged while a run is under way, paused or not: end it with Stop, which keeps what it reached."
_NAMELESS = "Tags need a name: write one into “Tag as”."
_NONE_CHOSEN = "No hex is chosen: click on one in the view, or press N for the worst, then T tags it."
_Trigger = QAbstractItemView.EditTrigger
_RENAMING = _Trigger.DoubleClicked | _Trigger.EditKeyPressed | _Trigger.AnyKeyPressed


@dataclass(frozen=True)
class TagRow:
    """A tag, how many elements have it, how many of these are inverted, and the least q among them (None of none)."""

    name: str
    elements: int
    inverted: int
    q_min: float | None


class TagPanel(QWidget):
    """Lists the tags and gives them.

    Signals
    -------
    toggle_requested(name)
        The user wants the chosen element tagged, or no more.
    shown_requested(name), listed_requested(name)
        The user wants all elements tagged that are shown in the view, or listed as the worst.
    isolate_requested(name), remove_requested(name)
    renamed(name, other)
    refused(str)
        The chosen hex was to be tagged, and cannot be: why, as a sentence.
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
        self._busy = self._chosen = False
        self._name = QComboBox()
        self._name.setEditable(True)
        self._name.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)  # the list is of tags that there are
        self._name.completer().setCaseSensitivity(Qt.CaseSensitivity.CaseSensitive)
        self._name.setCurrentText("tagged")
        set_help(self._name, "Tag as", "The name of the tag that hexes are given.")
        self._element = self._button("Hex", "Tag the chosen hex, or take the tag from it (T).")
        self._shown = self._button("Shown", "Tag all hexes that are shown in the view: what is hidden is left out.")
        self._listed = self._button("Worst", "Tag all hexes of the list of the worst.")
        self._isolate = self._button("Isolate", "Show the hexes of this tag and their neighbours, and nothing else.")
        self._remove = self._button("Remove", "Take this tag from all its hexes.")
        self._table = self._make_table()
        self._hint = note(_HINT)
        self._lay_out()
        self._element.clicked.connect(self.toggle)
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
        table.setHorizontalHeaderLabels(_TITLES)
        shape_table(table, "Tags", 0)
        table.horizontalHeaderItem(0).setTextAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        for column in range(1, len(_TITLES)):
            table.setColumnWidth(column, table.fontMetrics().horizontalAdvance("0,000,000") + 14)
        return table

    def _lay_out(self) -> None:
        head, foot = QHBoxLayout(), QHBoxLayout()
        label = QLabel("Tag as")
        label.setBuddy(self._name)
        head.addWidget(label)
        head.addWidget(self._name, 1)
        for part in (self._element, self._shown, self._listed):
            head.addWidget(part)
        foot.addWidget(self._hint, 1)
        for part in (self._isolate, self._remove):
            foot.addWidget(part)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(6, 4, 6, 4)
        layout.setSpacing(4)
        layout.addLayout(head)
        layout.addWidget(self._table, 1)
        layout.addLayout(foot)

    @property
    def name(self) -> str:
        """The name of the tag that elements are given; "" while there is none."""
        return self._name.currentText().strip()

    def set_name(self, name: str) -> None:
        """Set the name of the tag."""
        self._name.setCurrentText(name)

    @property
    def can_toggle(self) -> bool:
        """Return True if a hex is selected and a name is given."""
        return not self.reason_against

    @property
    def reason_against(self) -> str:
        """Why the chosen hex cannot be tagged, as a sentence; "" where it can."""
        if self._busy:
            return _BUSY
        if not self.name:
            return _NAMELESS
        return "" if self._chosen else _NONE_CHOSEN

    def toggle(self) -> None:
        """Ask for the chosen hex's tag, or to take it away; or say why that cannot be."""
        if self.can_toggle:
            self.toggle_requested.emit(self.name)
        else:
            self.refused.emit(self.reason_against)

    def set_tags(self, rows: list[TagRow]) -> None:
        """Show the tags; without a signal."""
        if rows == self._rows:
            return
        selected, name = self._selected(), self._name.currentText()
        self._rows = rows
        with QSignalBlocker(self._table), QSignalBlocker(self._name):
            self._table.setRowCount(len(rows))
            for at, row in enumerate(rows):
                for column, text in enumerate((row.name, f"{row.elements:,}", f"{row.inverted:,}", figure(row.q_min))):
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
            item.setToolTip("Double-click to rename the tag.")
        return item

    def set_state(self, chosen: bool, busy: bool) -> None:
        """Say whether an element is chosen, and whether a run is under way, in which nothing can be tagged."""
        self._chosen, self._busy = chosen, busy
        self._enable()

    def _selected(self) -> str:
        at = self._table.currentRow() if self._table.selectedItems() else -1
        return self._rows[at].name if 0 <= at < len(self._rows) else ""

    def _on_edited(self, item: QTableWidgetItem) -> None:
        old, new = self._rows[item.row()].name, item.text().strip()
        taken = any(row.name == new for row in self._rows)
        if new and not taken and not self._busy:
            self.renamed.emit(old, new)
        else:
            with QSignalBlocker(self._table):
                item.setText(old)

    def _enable(self) -> None:
        possible = bool(self.name) and not self._busy
        self._element.setEnabled(self.can_toggle)
        self._shown.setEnabled(possible)
        self._listed.setEnabled(possible)
        self._isolate.setEnabled(bool(self._selected()))
        self._remove.setEnabled(bool(self._selected()) and not self._busy)
        self._table.setEditTriggers(_Trigger.NoEditTriggers if self._busy else _RENAMING)
        free = _NONE_CHOSEN if self._rows else _HINT
        reason = self.reason_against
        self._hint.setText(free if reason == _NONE_CHOSEN else reason)
