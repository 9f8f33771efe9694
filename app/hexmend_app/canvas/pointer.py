"""Clicks in the 3D view; VTK itself rotates, pans and zooms."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QPointF, Qt, QTimer, Signal
from PySide6.QtWidgets import QWidget

#: How far the mouse may stray in a click, in pixels; beyond it drags.
_STRAY = 3


class Pointer(QObject):
    """Tells clicks from drags.

    Parameters
    ----------
    view : QWidget

    Signals
    -------
    pressed
        A button is down: a click or a drag begins.
    clicked(place), dug(place)
        A click of the left button in the view, or one with Ctrl held down.
    double_clicked(place)
        Double click of the left button; its first click is reported as a click.
    menu_wanted(place)
        A click of the right button.

    The last two are emitted after VTK has released the button: it would turn or zoom on under a menu that waits for an
    answer, and end what leads the camera.
    """

    pressed = Signal()
    clicked = Signal(QPointF)
    dug = Signal(QPointF)
    double_clicked = Signal(QPointF)
    menu_wanted = Signal(QPointF)

    def __init__(self, view: QWidget):
        super().__init__(view)
        self._down: tuple[Qt.MouseButton, QPointF] | None = None
        self._second = False  # of a double click
        view.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Watch the mouse buttons; VTK receives each event too."""
        kind = event.type()
        if kind == QEvent.Type.MouseButtonPress:
            self._press(event)
        elif kind == QEvent.Type.MouseButtonDblClick:
            self._press(event)
            self._second = not _with_ctrl(event)  # with Ctrl held down, two clicks are two clicks
        elif kind == QEvent.Type.MouseButtonRelease:
            self._release(event)
        return super().eventFilter(watched, event)

    def _press(self, event: QEvent) -> None:
        self._down, self._second = (event.button(), event.position()), False
        self.pressed.emit()

    def _release(self, event: QEvent) -> None:
        down, self._down = self._down, None
        if down is None or down[0] != event.button():
            return
        place = event.position()
        away = place - down[1]
        if max(abs(away.x()), abs(away.y())) > _STRAY:
            return
        if event.button() == Qt.MouseButton.LeftButton and self._second:
            QTimer.singleShot(0, self, lambda: self.double_clicked.emit(place))
        elif event.button() == Qt.MouseButton.LeftButton:
            (self.dug if _with_ctrl(event) else self.clicked).emit(place)
        elif event.button() == Qt.MouseButton.RightButton:
            QTimer.singleShot(0, self, lambda: self.menu_wanted.emit(place))


def _with_ctrl(event: QEvent) -> bool:
    return bool(event.modifiers() & Qt.KeyboardModifier.ControlModifier)
