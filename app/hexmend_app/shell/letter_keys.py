"""Letters typed in lists of the window are shortcuts, and never change what is selected there."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractItemView, QComboBox, QWidget
from shiboken6 import isValid

from hexmend_app.shell.floating import is_in
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
