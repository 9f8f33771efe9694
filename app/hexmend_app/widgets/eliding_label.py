"""Label that elides its text."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QLabel


class ElidingLabel(QLabel):
    """Label with one line of plain text, which is elided if the label is too narrow."""

    def minimumSizeHint(self) -> QSize:
        """Return the size of the ellipsis."""
        return QSize(self.fontMetrics().horizontalAdvance("…"), super().minimumSizeHint().height())

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the elided text."""
        rect = self.contentsRect()
        text = self.fontMetrics().elidedText(self.text(), Qt.TextElideMode.ElideRight, rect.width())
        painter = QPainter(self)
        options = self.alignment().value | Qt.TextFlag.TextSingleLine.value
        self.style().drawItemText(painter, rect, options, self.palette(), self.isEnabled(), text, self.foregroundRole())
