"""Entry of a legend: a coloured rectangle with a text."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize
from PySide6.QtGui import QColor, QIcon, QPainter, QPaintEvent, QPixmap
from PySide6.QtWidgets import QHBoxLayout, QWidget

from hexmend_app.theme.palette import Role
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import note


class Swatch(QWidget):
    """Small filled rectangle."""

    def __init__(self, colour: Role | str, parent: QWidget | None = None):
        super().__init__(parent)
        self._colour = colour
        self.setFixedSize(QSize(12, 10))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Fill the rectangle in the style of the plots: pale inside, full colour at the border."""
        painter = QPainter(self)
        painter.setPen(QColor(str(self._colour)))
        pale = QColor(str(self._colour))
        pale.setAlpha(90)
        painter.setBrush(pale)
        painter.drawRect(QRectF(0.5, 0.5, self.width() - 1, self.height() - 1))


def swatch_icon(colour: Role | str) -> QIcon:
    """Return an icon of one colour."""
    picture = QPixmap(12, 10)
    picture.fill(QColor(str(colour)))
    return QIcon(picture)


def legend_entry(text: str, colour: Role | str) -> QWidget:
    """Return a widget with a swatch and a text."""
    entry = QWidget()
    label = note(text)
    label.setWordWrap(False)
    label.setSizePolicy(entry.sizePolicy())
    fill(QHBoxLayout(entry), Swatch(colour), label, margins=(0, 0, 8, 0), spacing=4)
    return entry
