"""Panel of the results of all runs: numbers, and a dot for each on the axis of its column."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import (
    QItemSelectionModel,
    QModelIndex,
    QPersistentModelIndex,
    QPointF,
    QRectF,
    QSignalBlocker,
    QSize,
    Qt,
    Signal,
)
from PySide6.QtGui import QColor, QKeyEvent, QPainter, QPen
from PySide6.QtWidgets import QStackedLayout, QStyledItemDelegate, QStyleOptionViewItem, QTableView, QWidget

from hexmend_app.features.runs.run_table import FIRST, NAME, QUANTITIES, SETTINGS, RunRow, RunTable
from hexmend_app.state.mesh.run_record import RunRecord
from hexmend_app.theme.palette import FAINT, LINE
from hexmend_app.theme.style import note
from hexmend_app.translation import tr
from hexmend_app.widgets.tables.hex_table import shape_table

_EMPTY = "No runs yet. Results of all runs will appear here, with those that no other run dominates."

#: Widths of the columns of names and of figures in pixels.
_NAME, _FIGURE = 180, 168


#: Smallest width of the axis, width of the number, and radius of a dot, in pixels.
_AXIS, _NUMBER, _RADIUS = 70, 62, 4.0


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


class DotDelegate(QStyledItemDelegate):
    """Draws numbers at the right, and dots at the left: filled ones for runs that no other dominates.

    The axis of a column extends from the smallest to the largest value of runs that no other dominates, and of the mesh
    at the start, which a line marks; values beyond it are at its ends.
    """

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        """Return a size that has room for the axis."""
        return QSize(_AXIS + _NUMBER, super().sizeHint(option, index).height())

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        """Paint the number and the dot."""
        super().paint(painter, option, index)
        model: Any = index.model()
        low, high = model.range_of(QUANTITIES[index.column() - FIRST].key)
        axis = axis_of(QRectF(option.rect))
        if low == high or axis.width() < _AXIS / 2:
            return
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(QColor(str(LINE)), 1))
        painter.drawLine(QPointF(axis.left(), axis.center().y()), QPointF(axis.right(), axis.center().y()))
        start = place(model, 0, index.column(), axis)
        painter.setPen(QPen(QColor(str(FAINT)), 1, Qt.PenStyle.DashLine))
        painter.drawLine(QPointF(start, option.rect.top()), QPointF(start, option.rect.bottom() + 1))
        row = model.rows[index.row()]
        if row.record is not None:
            colour = QColor(str(FAINT if row.dominated_by else row.colour))
            painter.setPen(QPen(colour, 1.5))
            painter.setBrush(Qt.BrushStyle.NoBrush if row.dominated_by else colour)
            x = place(model, index.row(), index.column(), axis)
            painter.drawEllipse(QPointF(x, axis.center().y()), _RADIUS, _RADIUS)
        painter.restore()


def axis_of(cell: QRectF) -> QRectF:
    """Return the area of the axis in a cell."""
    return cell.adjusted(_RADIUS + 6, 0, -_NUMBER - _RADIUS, 0)


def place(model: RunTable, row: int, column: int, axis: QRectF) -> float:
    """Return the horizontal position of a value on the axis of its column; at its end for one beyond it."""
    key = QUANTITIES[column - FIRST].key
    low, high = model.range_of(key)
    share = (model.rows[row].figures[key] - low) / (high - low)
    return axis.left() + axis.width() * min(max(share, 0.0), 1.0)
