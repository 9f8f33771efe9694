"""Keys of the window in lists and fields: letters are shortcuts, and Return moves the focus to the view."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractItemView, QAbstractSpinBox, QApplication, QComboBox, QLineEdit, QWidget
from shiboken6 import isValid

from hexmend_app.shell.focus_changes import follow_focus

#: Modifiers with which a key still types a letter.
_TYPING = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.KeypadModifier


class LetterKeys(QObject):
    """Event filter that keeps letters from combo boxes, lists and tables of a window and of its floating panels.

    Qt would select the next entry that begins with the letter. The open list of a combo box and text fields receive
    letters as usual, and so do dialogs, which have no single-letter shortcuts.

    Parameters
    ----------
    window : QWidget
        Window with single-letter shortcuts.
    """

    def __init__(self, window: QWidget):
        super().__init__(window)
        self._window = window
        follow_focus(self)

    def focus_moved(self, now: QWidget | None) -> None:
        """Watch a list of the window that receives the focus."""
        if isinstance(now, (QComboBox, QAbstractItemView)) and isValid(self._window) and is_in(self._window, now):
            now.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Pass a typed letter on to the window."""
        takes_text = isinstance(watched, QComboBox) and watched.isEditable()
        if event.type() == QEvent.Type.KeyPress and _types(event) and not takes_text:  # type: ignore[arg-type]
            event.ignore()
            return True
        return super().eventFilter(watched, event)


def _types(event: QKeyEvent) -> bool:
    """Return True if a key event types a letter; the space bar opens lists and marks rows."""
    text = event.text()
    return bool(text.strip()) and text.isprintable() and not event.modifiers() & ~_TYPING


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


def is_in(window: QWidget, widget: QWidget) -> bool:
    """Return True if a widget is in a window or in one of its floating panels, but not in a dialog or popup."""
    top = widget.window()
    return top is window or is_floating(window, top)


def is_floating(window: QWidget, top: QWidget) -> bool:
    """Return True if a window of the desktop is a floating panel, or a group of them, of a main window."""
    parent = top.parentWidget()
    return top.windowType() == Qt.WindowType.Tool and parent is not None and parent.window() is window
