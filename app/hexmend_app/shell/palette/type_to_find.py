"""Type-ahead search in lists, which takes precedence over single-key shortcuts of the window."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractItemView, QApplication, QComboBox, QWidget

#: Modifiers with which a key still types a letter.
_TYPING = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.KeypadModifier


class TypeToFind(QObject):
    """Gives typed letters to lists although single letters are shortcuts of the window.

    A drop-down box that keys have brought the focus to, or have chosen in, has every letter. One that was clicked was
    typed in while it was open: what is pressed later is meant for the window, and would change what was chosen unseen.
    A list or a table has the letters that it finds something by, so that keys that lead through it go on doing so.

    Parameters
    ----------
    window : QWidget
        Of which the letters are keys.
    """

    def __init__(self, window: QWidget):
        super().__init__(window)
        self._window = window
        self._clicked = False  # the box that has the focus, since a key was pressed in it
        window.installEventFilter(self)
        QApplication.instance().focusChanged.connect(self._on_focus)

    def _on_focus(self, before: QWidget | None, now: QWidget | None) -> None:
        """Track clicks in a combo box and its list."""
        opened = before is not None and before.window().windowType() == Qt.WindowType.Popup
        if isinstance(now, QComboBox) and not opened and self._window.isAncestorOf(now):
            self._clicked = False
            now.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Give a letter to the focused widget before the shortcuts of the window."""
        kind = event.type()
        if watched is not self._window:
            if kind in (QEvent.Type.MouseButtonPress, QEvent.Type.KeyPress):
                self._clicked = kind == QEvent.Type.MouseButtonPress
        elif kind == QEvent.Type.ShortcutOverride and self._is_for(QApplication.focusWidget(), event):
            event.accept()
            return True
        return super().eventFilter(watched, event)

    def _is_for(self, widget: QWidget | None, event: QKeyEvent) -> bool:
        text = event.text()
        if not text.strip() or not text.isprintable() or event.modifiers() & ~_TYPING:
            return False
        if isinstance(widget, QComboBox):
            return not self._clicked
        return isinstance(widget, QAbstractItemView) and _finds(widget, text)


def _finds(view: QAbstractItemView, text: str) -> bool:
    """Return True if an entry of the current column begins with a text."""
    at = view.currentIndex()
    if not at.isValid():
        return False
    begins = Qt.MatchFlag.MatchStartsWith | Qt.MatchFlag.MatchWrap
    return bool(view.model().match(at, Qt.ItemDataRole.DisplayRole, text, 1, begins))
