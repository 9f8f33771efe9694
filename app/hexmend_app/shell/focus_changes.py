"""Objects that are told which widget has the focus, until they are destroyed."""

from __future__ import annotations

import weakref
from typing import Protocol

from PySide6.QtWidgets import QApplication, QWidget
from shiboken6 import isValid


class FollowsFocus(Protocol):
    """A QObject that is told of the focus."""

    def focus_moved(self, now: QWidget | None) -> None:
        """React to the widget that has the focus now."""


def follow_focus(receiver: FollowsFocus) -> None:
    """Tell a QObject of each focus from now on, until it is destroyed.

    A connection to its method would be followed even while it is destroyed, which itself moves the focus: the method is
    not found then (PySide 6.11).
    """
    alive = weakref.ref(receiver)

    def tell(before: QWidget | None, now: QWidget | None) -> None:
        found = alive()
        if found is None or not isValid(found):
            QApplication.instance().focusChanged.disconnect(tell)  # type: ignore[attr-defined]
        else:
            found.focus_moved(now)

    QApplication.instance().focusChanged.connect(tell)  # type: ignore[attr-defined]
