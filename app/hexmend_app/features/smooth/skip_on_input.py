"""Ends the easing of a run when the user presses a key or a button: the result is there at once."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QApplication, QWidget

from hexmend_app.state.run.run_controller import RunController

if TYPE_CHECKING:
    from hexmend_app.canvas.canvas import Canvas

#: Keys that do nothing without another one.
_MODIFIERS = Qt.Key.Key_Shift, Qt.Key.Key_Control, Qt.Key.Key_Alt, Qt.Key.Key_Meta


class SkipOnInput(QObject):
    """Filters events while a run is shown eased.

    Keys and buttons that move the camera alone do not end the easing. Keys of actions do so by the action.

    Parameters
    ----------
    run : RunController
    canvas : callable
        Returns the 3D view, or None.
    """

    def __init__(self, run: RunController, canvas: Callable[[], Canvas | None]):
        super().__init__(run)
        self._run, self._canvas = run, canvas
        run.view.eased.active_changed.connect(self._on_active)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Show the result before the event gets where it goes."""
        if isinstance(watched, QWidget) and self._ends(watched, event):
            self._run.view.skip_easing()
        return False

    def _ends(self, widget: QWidget, event: Any) -> bool:
        canvas = self._canvas()
        in_view = canvas is not None and widget is canvas.interactor
        if event.type() == QEvent.Type.ShortcutOverride:  # Escape also closes a message
            return event.key() == Qt.Key.Key_Escape
        if event.type() == QEvent.Type.KeyPress:
            return event.key() not in _MODIFIERS and not (in_view and canvas.camera_move(event) is not None)
        return event.type() == QEvent.Type.MouseButtonPress and not in_view  # a drag in the view moves the camera

    def _on_active(self) -> None:
        """Filter events while needed alone: each costs a call."""
        application = QApplication.instance()
        (application.installEventFilter if self._run.view.eased.active else application.removeEventFilter)(self)
