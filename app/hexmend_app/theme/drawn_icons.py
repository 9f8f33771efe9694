"""Icons that Hexmend draws itself, where those of Material Design look alike or mislead."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

#: Lines of the letters, in a box of 7 by 9.
_LETTERS = {
    "x": (((0, 0), (7, 9)), ((7, 0), (0, 9))),
    "y": (((0, 0), (3.5, 4.5)), ((7, 0), (3.5, 4.5)), ((3.5, 4.5), (3.5, 9))),
    "z": (((0, 0), (7, 0)), ((7, 0), (0, 9)), ((0, 9), (7, 9))),
}


def _axis(painter: QPainter, colour: QColor, letter: str, positive: bool) -> None:
    """Draw the sign and the letter of an axis."""
    painter.setPen(QPen(colour, 1.7, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap, Qt.PenJoinStyle.RoundJoin))
    for start, end in _LETTERS[letter]:
        painter.drawLine(QLineF(QPointF(*start), QPointF(*end)).translated(7.6, 3.5))
    painter.setPen(QPen(colour, 1.4, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
    painter.drawLine(QLineF(1.2, 8, 5.4, 8))
    if positive:
        painter.drawLine(QLineF(3.3, 5.7, 3.3, 10.3))


def _cut(painter: QPainter, colour: QColor) -> None:
    """Draw a box that a plane cuts in two; one half is only indicated."""
    painter.setPen(QPen(colour, 1.3, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap, Qt.PenJoinStyle.RoundJoin))
    painter.setBrush(colour)
    painter.drawPolygon(QPolygonF([QPointF(2.5, 6.5), QPointF(9.5, 13.5), QPointF(2.5, 13.5)]))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawLine(QLineF(1.5, 1.5, 14.5, 14.5))
    painter.setPen(QPen(colour, 1.2, Qt.PenStyle.SolidLine, Qt.PenCapStyle.FlatCap))
    for line in (
        QLineF(6.5, 2.6, 9, 2.6),
        QLineF(11, 2.6, 13.5, 2.6),
        QLineF(13.4, 2, 13.4, 5),
        QLineF(13.4, 7, 13.4, 9.5),
    ):
        painter.drawLine(line)


#: Functions that draw an icon into a square of 16 by 16, by name.
DRAWN: dict[str, Callable[[QPainter, QColor], None]] = {
    "cut": _cut,
    **{
        f"{sign}-{letter}": partial(_axis, letter=letter, positive=sign == "plus")
        for sign in ("plus", "minus")
        for letter in _LETTERS
    },
}


def draw(name: str, painter: QPainter, area: QRectF, colour: QColor) -> None:
    """Draw an icon of `DRAWN` as large as possible in the middle of an area."""
    side = min(area.width(), area.height())
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.translate(area.center() - QPointF(side, side) / 2)
    painter.scale(side / 16, side / 16)
    DRAWN[name](painter, colour)
    painter.restore()
