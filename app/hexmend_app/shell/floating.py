"""Floating panels are windows of their own, which belong to the main window."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget


def is_in(window: QWidget, widget: QWidget) -> bool:
    """Return True if a widget is in a window or in one of its floating panels, but not in a dialog or popup."""
    top = widget.window()
    return top is window or is_floating(window, top)


def is_floating(window: QWidget, top: QWidget) -> bool:
    """Return True if a window of the desktop is a floating panel, or a group of them, of a main window."""
    parent = top.parentWidget()
    return top.windowType() == Qt.WindowType.Tool and parent is not None and parent.window() is window
