"""Entry of a legend: a coloured rectangle with a text."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize
from PySide6.QtGui import QColor, QIcon, QPainter, QPaintEvent, QPixmap
from PySide6.QtWidgets import QHBoxLayout, QWidget

from hexmend_app.theme.palette import Role
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import small_label


class Swatch(QWidget):
    """Small filled rectangle, pale inside its border in the style of the plots, or with a rim of another colour."""

    def __init__(self, colour: Role | str, width: int = 12, height: int = 10, rim: Role | None = None):
        super().__init__()
        self._colour, self._rim = colour, rim
        self.setFixedSize(QSize(width, height))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Fill the rectangle."""
        painter, inside = QPainter(self), QColor(str(self._colour))
        painter.setPen(QColor(str(self._rim or self._colour)))
        if self._rim is None:
            inside.setAlpha(90)
        painter.setBrush(inside)
        painter.drawRect(QRectF(0.5, 0.5, self.width() - 1, self.height() - 1))


def swatch_icon(colour: Role | str) -> QIcon:
    """Return an icon of one colour."""
    picture = QPixmap(12, 10)
    picture.fill(QColor(str(colour)))
    return QIcon(picture)


def legend_entry(text: str, colour: Role | str) -> QWidget:
    """Return a widget with a swatch and a text."""
    entry = QWidget()
    label = small_label(text)
    label.setWordWrap(False)
    label.setSizePolicy(entry.sizePolicy())
    fill(QHBoxLayout(entry), Swatch(colour), label, margins=(0, 0, 8, 0), spacing=4)
    return entry
