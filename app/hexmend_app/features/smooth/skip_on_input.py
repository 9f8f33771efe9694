"""Ends the easing of a run when the user presses a key or a button: the result is there at once."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QApplication, QWidget

from hexmend_app.state.run.run_controller import RunController

#: Events by which the user goes on.
_PRESSES = QEvent.Type.KeyPress, QEvent.Type.MouseButtonPress, QEvent.Type.ShortcutOverride


class SkipOnInput(QObject):
    """Filters events while a run is shown eased.

    Parameters
    ----------
    run : RunController
    view : callable
        Returns the widget of the view, in which the camera may be moved meanwhile, or None.
    """

    def __init__(self, run: RunController, view: Callable[[], QWidget | None]):
        super().__init__(run)
        self._run, self._view = run, view
        run.view.eased.active_changed.connect(self._on_active)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Show the result before the event gets where it goes."""
        if event.type() in _PRESSES and isinstance(watched, QWidget) and not self._in_view(watched, event):
            self._run.view.skip_easing()
        return False

    def _in_view(self, widget: QWidget, event: QEvent) -> bool:
        """Return True for a button pressed in the view, and not on what is laid over it."""
        return event.type() == QEvent.Type.MouseButtonPress and widget is self._view()

    def _on_active(self) -> None:
        """Filter events while needed alone: each costs a call."""
        application = QApplication.instance()
        (application.installEventFilter if self._run.view.eased.active else application.removeEventFilter)(self)
