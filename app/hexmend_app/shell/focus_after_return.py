"""Return in a field ends typing: the keyboard goes back to the view, whose keys are single letters."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QAbstractSpinBox, QApplication, QLineEdit, QWidget
from shiboken6 import isValid

from hexmend_app.shell.floating import is_floating
from hexmend_app.shell.focus_changes import follow_focus


class FocusAfterReturn(QObject):
    """Event filter that gives the focus to the view after Return in a field of the window or of a floating panel.

    Parameters
    ----------
    window : QWidget
        Receives keys that its fields do not keep for themselves, as do its floating panels.
    view : callable
        Returns the widget that gets the focus, or None.
    """

    def __init__(self, window: QWidget, view: Callable[[], QWidget | None]):
        super().__init__(window)
        self._window = window
        self._view = view
        window.installEventFilter(self)
        follow_focus(self)

    def focus_moved(self, now: QWidget | None) -> None:
        """Watch a floating panel that receives the focus: its keys do not reach the window."""
        if now is not None and isValid(self._window) and is_floating(self._window, now.window()):
            now.window().installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Move the focus on a Return that the field has acted on and passed on."""
        if event.type() == QEvent.Type.KeyPress and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):  # type: ignore[attr-defined]
            view = self._view()
            if view is not None and isinstance(QApplication.focusWidget(), (QLineEdit, QAbstractSpinBox)):
                if watched is not self._window:
                    self._window.activateWindow()
                view.setFocus(Qt.FocusReason.OtherFocusReason)
        return super().eventFilter(watched, event)
