"""Panel of the results of all runs: numbers, and a dot for each on the axis of its column."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QItemSelectionModel, QModelIndex, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QStackedLayout, QTableView, QWidget

from hexmend_app.features.runs.dot_delegate import DotDelegate
from hexmend_app.features.runs.run_table import FIRST, NAME, SETTINGS, RunRow, RunTable
from hexmend_app.state.mesh.run_record import RunRecord
from hexmend_app.theme.style import note
from hexmend_app.translation import tr
from hexmend_app.widgets.tables.hex_table import shape_table

_EMPTY = "No runs yet. Results of all runs will appear here, with those that no other run dominates."

#: Widths of the columns of names and of figures in pixels.
_NAME, _FIGURE = 180, 168


class RunsPanel(QWidget):
    """Panel that compares the results of runs.

    Attributes
    ----------
    table : QTableView
    model : RunTable

    Signals
    -------
    chosen(RunRecord or None)
        The user selected a run, or the mesh at the start.
    """

    chosen = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.model = RunTable(self)
        self.table = _Table(self)
        self.table.setModel(self.model)
        shape_table(self.table, tr("Results of all runs"), SETTINGS)
        self.table.setAlternatingRowColors(False)  # the lines of the start run through all rows
        header = self.table.horizontalHeader()
        header.setMinimumSectionSize(60)
        self.table.setColumnWidth(NAME, _NAME)
        self._dots = DotDelegate(self.table)
        for column in range(FIRST, self.model.columnCount()):
            self.table.setItemDelegateForColumn(column, self._dots)
            self.table.setColumnWidth(column, _FIGURE)
        self.table.clicked.connect(self._choose)
        self.table.entered_row.connect(self._choose)
        self._empty = note(tr(_EMPTY))
        self._empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._stack = QStackedLayout(self)
        self._stack.addWidget(self._empty)
        self._stack.addWidget(self.table)

    def set_rows(self, rows: Sequence[RunRow]) -> None:
        """Show rows: the mesh at the start, then the runs; none for a hint."""
        self.model.fill(rows)
        self._stack.setCurrentWidget(self.table if rows else self._empty)

    def set_shown(self, record: RunRecord | None, at_start: bool) -> None:
        """Select the row of the mesh that is shown; none if it is the result of no run."""
        rows = self.model.rows
        row = next((k for k, one in enumerate(rows) if (one.record is record if record else at_start and not k)), None)
        selection = self.table.selectionModel()
        with QSignalBlocker(self.table):
            if row is None:
                selection.clear()
            else:
                flags = QItemSelectionModel.SelectionFlag
                selection.setCurrentIndex(self.model.index(row, NAME), flags.ClearAndSelect | flags.Rows)
        self.table.viewport().update()

    def _choose(self, index: QModelIndex) -> None:
        self.chosen.emit(self.model.rows[index.row()].record)


class _Table(QTableView):
    """Table in which Enter selects the current row.

    Signals
    -------
    entered_row(QModelIndex)
    """

    entered_row = Signal(QModelIndex)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Select the current row by Enter or the space bar."""
        keys = (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Space)
        if event.key() in keys and self.currentIndex().isValid():
            self.entered_row.emit(self.currentIndex())
        else:
            super().keyPressEvent(event)
