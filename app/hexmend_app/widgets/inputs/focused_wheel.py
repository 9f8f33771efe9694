"""Wheel events of inputs in panels that scroll."""

from __future__ import annotations

from PySide6.QtGui import QWheelEvent


class FocusedWheel:
    """Base of inputs that ignore the wheel unless focused, so that scrolling a panel does not change their values."""

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Change the value if the input has the focus."""
        if self.hasFocus():  # type: ignore[attr-defined]  # of the widget that this is mixed into
            super().wheelEvent(event)  # type: ignore[misc]
        else:
            event.ignore()
