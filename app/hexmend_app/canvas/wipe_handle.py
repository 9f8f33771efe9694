"""Draggable edge between the two views of a wipe."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QRect, Qt, Signal
from PySide6.QtGui import QColor, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen, QRegion
from PySide6.QtWidgets import QWidget

from hexmend_app.theme.palette import ACCENT, FIELD, LINE, TEXT
from hexmend_app.theme.style import set_help
from hexmend_app.translation import tr

#: Sizes in pixels: width of the line, diameter of its knob.
_LINE, _KNOB = 5, 22


class WipeHandle(QWidget):
    """Vertical line over the view with a knob in the middle, moved by mouse or arrow keys.

    Parameters
    ----------
    over : QWidget
        The view.

    Signals
    -------
    moved(share)
        The user moved the edge to a fraction of the width of the view.
    stepped(step)
        The user moved the edge by a step to the left, -1, or to the right, 1.
    """

    moved = Signal(float)
    stepped = Signal(int)

    def __init__(self, over: QWidget):
        super().__init__(over)
        self._share = 0.5
        self._grip: int | None = None  # distance of the mouse from the line during a drag
        self.setCursor(Qt.CursorShape.SplitHCursor)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        set_help(self, tr("Wipe"), tr("Drag, or press the arrow keys, to move the edge between the two views."))
        self.hide()
        over.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Preserve the relative position when the view is resized."""
        if event.type() == QEvent.Type.Resize:
            self._place()
        return super().eventFilter(watched, event)

    def set_share(self, share: float) -> None:
        """Move to a fraction of the width of the view."""
        self._share = share
        self._place()

    def _place(self) -> None:
        """Place the handle for the current size of the view."""
        share = self._share
        over = self.parentWidget().size()
        self.setGeometry(round(share * over.width()) - _KNOB // 2, 0, _KNOB, over.height())
        self.setMask(QRegion(self._line) + QRegion(self.knob(), QRegion.RegionType.Ellipse))

    @property
    def _line(self) -> QRect:
        return QRect((_KNOB - _LINE) // 2, 0, _LINE, self.height())

    def knob(self) -> QRect:
        """Return the rectangle of the knob."""
        return QRect(0, (self.height() - _KNOB) // 2, _KNOB, _KNOB)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the line and the knob, in the accent colour if focused or dragged."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(str(LINE)))
        inside = QColor(str(ACCENT if self.hasFocus() or self._grip is not None else TEXT))
        painter.fillRect(self._line.adjusted(1, 0, -1, 0), inside)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(inside, 2))
        painter.setBrush(QColor(str(FIELD)))
        painter.drawEllipse(self.knob().adjusted(1, 1, -2, -2))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Start to drag."""
        if event.button() == Qt.MouseButton.LeftButton:
            self._grip = round(event.position().x()) - _KNOB // 2
            self.update()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Continue to drag."""
        if self._grip is not None:
            place = self.mapToParent(event.position().toPoint()).x() - self._grip
            self.moved.emit(place / max(self.parentWidget().width(), 1))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Stop dragging."""
        self._grip = None
        self.update()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move by a step for an arrow key."""
        step = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}.get(Qt.Key(event.key()))
        if step is None:
            super().keyPressEvent(event)
        else:
            self.stepped.emit(step)
