"""Icons of the program, in one set that follows the theme; some are drawn here."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QLineF, QPoint, QPointF, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QIcon, QIconEngine, QPainter, QPen, QPixmap, QPolygonF

from hexmend_app.theme.palette import FAINT, TEXT, Role

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


class _IconEngine(QIconEngine):
    """Paints an icon in the current colour of a role."""

    def __init__(self, name: str, role: Role):
        super().__init__()
        self._name, self._role = name, role

    def paint(self, painter: QPainter, rect: QRect, mode: QIcon.Mode, state: QIcon.State) -> None:
        """Paint the icon in the size of the rectangle."""
        if self._name in DRAWN:
            colour = FAINT if mode is QIcon.Mode.Disabled else self._role
            draw(self._name, painter, QRectF(rect), QColor(str(colour)))
            return
        import qtawesome  # imported late, as it loads fonts

        glyph = qtawesome.icon(f"mdi6.{self._name}", color=str(self._role), color_disabled=str(FAINT), scale_factor=1.1)
        glyph.paint(painter, rect, Qt.AlignmentFlag.AlignCenter, mode, state)

    def pixmap(self, size: QSize, mode: QIcon.Mode, state: QIcon.State) -> QPixmap:
        """Return the icon on a transparent background; `size` is in device pixels."""
        pixmap = QPixmap(size)
        pixmap.fill(Qt.GlobalColor.transparent)
        painter = QPainter(pixmap)
        self.paint(painter, QRect(QPoint(0, 0), size), mode, state)
        painter.end()
        return pixmap

    def clone(self) -> QIconEngine:
        """Return a copy."""
        return _IconEngine(self._name, self._role)


def icon(name: str, role: Role = TEXT) -> QIcon:
    """Return an icon, which is sharp at all scales and follows the theme.

    Parameters
    ----------
    name : str
        Name of an icon of `hexmend_app.theme.icons` or of Material Design.
    role : Role
        Its colour.
    """
    return QIcon(_IconEngine(name, role))
