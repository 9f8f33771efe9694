"""Type-ahead search in lists, which takes precedence over the single-key shortcuts of the window."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractItemView, QApplication, QComboBox, QWidget

#: Modifiers with which a key still types a letter.
_TYPING = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.KeypadModifier


class TypeToFind(QObject):
    """Event filter that gives typed letters to the focused list although they are shortcuts of the window.

    A combo box receives every letter if it was focused or last used by keyboard. After a click it does not: the user
    types in its open list, and later letters are meant for the window. A list or a table receives only letters that
    match one of its entries, so that shortcuts which move through it continue to work.

    Parameters
    ----------
    window : QWidget
        Window with single-letter shortcuts.
    """

    def __init__(self, window: QWidget):
        super().__init__(window)
        self._window = window
        self._clicked = False  # the focused combo box was last used by mouse
        window.installEventFilter(self)
        QApplication.instance().focusChanged.connect(self._on_focus)

    def _on_focus(self, before: QWidget | None, now: QWidget | None) -> None:
        """Watch a combo box that receives the focus, unless it comes back from its open list."""
        from_popup = before is not None and before.window().windowType() == Qt.WindowType.Popup
        if isinstance(now, QComboBox) and not from_popup and self._window.isAncestorOf(now):
            self._clicked = False
            now.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Give a letter to the focused widget before the shortcuts of the window."""
        kind = event.type()
        if watched is not self._window:
            if kind in (QEvent.Type.MouseButtonPress, QEvent.Type.KeyPress):
                self._clicked = kind == QEvent.Type.MouseButtonPress
        elif kind == QEvent.Type.ShortcutOverride and self._wants(QApplication.focusWidget(), event):
            event.accept()
            return True
        return super().eventFilter(watched, event)

    def _wants(self, widget: QWidget | None, event: QKeyEvent) -> bool:
        """Return True if a key event types a letter for a widget."""
        text = event.text()
        if not text.strip() or not text.isprintable() or event.modifiers() & ~_TYPING:
            return False
        if isinstance(widget, QComboBox):
            return not self._clicked
        return isinstance(widget, QAbstractItemView) and _has_match(widget, text)


def _has_match(view: QAbstractItemView, text: str) -> bool:
    """Return True if an entry of the current column begins with a text."""
    at = view.currentIndex()
    if not at.isValid():
        return False
    flags = Qt.MatchFlag.MatchStartsWith | Qt.MatchFlag.MatchWrap
    return bool(view.model().match(at, Qt.ItemDataRole.DisplayRole, text, 1, flags))
