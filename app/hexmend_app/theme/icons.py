"""Icons of the program, in one set that follows the theme."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QRect, QSize, Qt
from PySide6.QtGui import QIcon, QIconEngine, QPainter, QPixmap

from hexmend_app.theme.palette import FAINT, TEXT, Role


class _IconEngine(QIconEngine):
    """Paints an icon in the current colour of a role."""

    def __init__(self, name: str, role: Role):
        super().__init__()
        self._name, self._role = name, role

    def paint(self, painter: QPainter, rect: QRect, mode: QIcon.Mode, state: QIcon.State) -> None:
        """Paint the icon in the size of the rectangle."""
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
    """Return an icon of Material Design, which is sharp at all scales and follows the theme.

    Parameters
    ----------
    name : str
    role : Role
        Its colour.
    """
    return QIcon(_IconEngine(name, role))
