"""Delegate that draws a value as a dot on the axis of its column, next to the number."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPen
from PySide6.QtWidgets import QStyledItemDelegate, QStyleOptionViewItem

from hexmend_app.features.runs.run_table import FIRST, QUANTITIES, RunTable
from hexmend_app.theme.palette import FAINT, LINE

#: Smallest width of the axis, width of the number, and radius of a dot, in pixels.
_AXIS, _NUMBER, _RADIUS = 70, 62, 4.0


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
