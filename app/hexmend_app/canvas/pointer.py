"""Clicks in the 3D view; VTK itself rotates, pans and zooms."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QEvent, QObject, QPointF, Qt, QTimer, Signal
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QWidget

#: Maximum movement of the mouse during a click, in pixels; more is a drag.
_MAX_MOVEMENT = 3


class Pointer(QObject):
    """Distinguishes clicks from drags.

    Parameters
    ----------
    view : QWidget

    Signals
    -------
    pressed
        A button was pressed; a click or a drag begins.
    clicked(place), hide_clicked(place)
        Click of the left button, without or with Ctrl.
    double_clicked(place)
        Double click of the left button; its first click is reported by `clicked` too.
    menu_requested_at(place)
        Click of the right button.

    The last two are emitted after VTK has handled the release of the button. Otherwise VTK would continue to zoom under
    an open menu, and would interrupt flights of the camera.
    """

    pressed = Signal()
    clicked = Signal(QPointF)
    hide_clicked = Signal(QPointF)
    double_clicked = Signal(QPointF)
    menu_requested_at = Signal(QPointF)

    def __init__(self, view: QWidget):
        super().__init__(view)
        self._down: tuple[Qt.MouseButton, QPointF] | None = None
        self._double = False
        view.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: Any) -> bool:
        """Observe the mouse buttons; VTK receives all events too."""
        kind = event.type()
        if kind == QEvent.Type.MouseButtonPress:
            self._press(event)
        elif kind == QEvent.Type.MouseButtonDblClick:
            self._press(event)
            self._double = not _with_ctrl(event)  # with Ctrl, two clicks remain two clicks
        elif kind == QEvent.Type.MouseButtonRelease:
            self._release(event)
        return super().eventFilter(watched, event)

    def _press(self, event: QMouseEvent) -> None:
        self._down, self._double = (event.button(), event.position()), False
        self.pressed.emit()

    def _release(self, event: QMouseEvent) -> None:
        down, self._down = self._down, None
        if down is None or down[0] != event.button():
            return
        place = event.position()
        movement = place - down[1]
        if max(abs(movement.x()), abs(movement.y())) > _MAX_MOVEMENT:
            return
        if event.button() == Qt.MouseButton.LeftButton and self._double:
            QTimer.singleShot(0, self, lambda: self.double_clicked.emit(place))
        elif event.button() == Qt.MouseButton.LeftButton:
            (self.hide_clicked if _with_ctrl(event) else self.clicked).emit(place)
        elif event.button() == Qt.MouseButton.RightButton:
            QTimer.singleShot(0, self, lambda: self.menu_requested_at.emit(place))


def _with_ctrl(event: QMouseEvent) -> bool:
    return bool(event.modifiers() & Qt.KeyboardModifier.ControlModifier)
