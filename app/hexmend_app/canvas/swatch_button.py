"""Clickable swatch of a special colour with its name and number of hexes."""

from __future__ import annotations

import math

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton, QSizePolicy, QWidget

from hexmend_app.theme.palette import BLUE, LINE, MUTED, TEXT
from hexmend_app.theme.style import set_help
from hexmend_app.translation import tr

_SIZE, _GAP = 12, 5


def swatch_text(name: str, count: int) -> str:
    """Format a name with its count, unless the count is 0.

    >>> swatch_text("inverted", 2707), swatch_text("inverted", 0)
    ('inverted (2,707)', 'inverted')
    """
    return f"{tr(name)} ({count:,})" if count else tr(name)


class SwatchButton(QAbstractButton):
    """Swatch that isolates the hexes with its colour when clicked; disabled if there are none.

    Attributes
    ----------
    name : str
    count : int
    """

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.name, self.count = "", 0
        self._colour = QColor()
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAttribute(Qt.WidgetAttribute.WA_Hover)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)

    def show_kind(self, name: str, count: int, colour: QColor) -> None:
        """Set name, count and colour."""
        if (name, count, colour) == (self.name, self.count, self._colour):
            return
        self.name, self.count, self._colour = name, count, colour
        self.setEnabled(count > 0)
        self.setCursor(Qt.CursorShape.PointingHandCursor if count else Qt.CursorShape.ArrowCursor)
        set_help(
            self, tr("Isolate {name}", name=tr(name)), tr("Show only {name} hexes; Esc shows all again.", name=tr(name))
        )
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QSize:
        """Return a size that fits large numbers, so that the layout does not change with the number."""
        metrics = QFontMetricsF(self.font())
        text = f"{tr(self.name)} (00,000)" if 0 < self.count < 100_000 else swatch_text(self.name, self.count)
        return QSize(math.ceil(_SIZE + _GAP + metrics.horizontalAdvance(text)) + 2, math.ceil(metrics.height()) + 4)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the swatch and its text, underlined under the mouse and framed with keyboard focus."""
        painter = QPainter(self)
        metrics, middle = QFontMetricsF(self.font()), self.height() / 2
        painter.setPen(QPen(QColor(str(LINE)), 0))
        painter.setBrush(self._colour)
        painter.drawRect(QRectF(0, round(middle - _SIZE / 2), _SIZE, _SIZE))
        font = self.font()
        font.setUnderline(self.isEnabled() and self.underMouse())
        painter.setFont(font)
        painter.setPen(QColor(str(TEXT if self.count else MUTED)))
        text = swatch_text(self.name, self.count)
        painter.drawText(QPointF(_SIZE + _GAP, middle + metrics.ascent() / 2 - 1), text)
        if self.hasFocus():
            painter.setPen(QPen(QColor(str(BLUE)), 1))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(QRectF(_SIZE + 1.5, 0.5, self.width() - _SIZE - 2, self.height() - 1))
