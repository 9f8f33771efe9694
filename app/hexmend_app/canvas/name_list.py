"""List of names with their colours, in place of the gradient of a colour bar."""

from __future__ import annotations

import math

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from hexmend_app.theme.palette import LINE, TEXT
from hexmend_app.translation import tr

#: Sizes in pixels: swatch, gap to the text, and space between rows.
_SIZE, _GAP, _SPACE = 12.0, 5.0, 4.0


class NameList(QWidget):
    """Names with swatches, one a row; those that do not fit are counted in the last row.

    Attributes
    ----------
    names : tuple of str
    """

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.names: tuple[str, ...] = ()
        self._table = np.zeros((0, 3), dtype=np.uint8)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Expanding)

    def show_names(self, names: tuple[str, ...], table: np.ndarray) -> None:
        """Show k names, each with its colour from a table, (k, 3) uint8."""
        if names != self.names or (names and not np.array_equal(table, self._table)):
            self.names, self._table = names, table
            self.updateGeometry()
            self.update()

    @property
    def _row(self) -> float:
        """Height of a row."""
        return max(QFontMetricsF(self.font()).height(), _SIZE) + _SPACE

    def rows(self) -> list[str]:
        """Return the texts of the rows that fit."""
        fitting = max(int(self.height() / self._row), 1)
        if len(self.names) <= fitting:
            return list(self.names)
        first = list(self.names[: fitting - 1])
        return [*first, tr("and {count:,} more", count=len(self.names) - len(first))]

    def sizeHint(self) -> QSize:
        """Return the size of all rows."""
        metrics = QFontMetricsF(self.font())
        widest = max((metrics.horizontalAdvance(name) for name in self.names), default=0.0)
        return QSize(math.ceil(_SIZE + _GAP + widest) + 2, math.ceil(self._row * len(self.names)))

    def minimumSizeHint(self) -> QSize:
        """Return a height that fits into small views."""
        return QSize(self.sizeHint().width(), 20)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the rows."""
        painter, metrics = QPainter(self), QFontMetricsF(self.font())
        painter.setFont(self.font())
        for row, text in enumerate(self.rows()):
            middle = (row + 0.5) * self._row
            left = 0.0
            if row < len(self.names) and text == self.names[row]:
                painter.setPen(QPen(QColor(str(LINE)), 0))
                painter.setBrush(QColor(*map(int, self._table[row])))
                painter.drawRect(QRectF(0.5, middle - _SIZE / 2, _SIZE, _SIZE))
                left = _SIZE + _GAP
            painter.setPen(QColor(str(TEXT)))
            text = metrics.elidedText(text, Qt.TextElideMode.ElideMiddle, self.width() - left)
            painter.drawText(QPointF(left, middle + metrics.ascent() / 2 - 1), text)
