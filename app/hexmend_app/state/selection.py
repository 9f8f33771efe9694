"""The element that is looked at."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal


class Selection(QObject):
    """One element of the open mesh, or none.

    Signals
    -------
    changed
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.hex: int | None = None

    def choose(self, hex: int | None) -> None:
        """Look at another element, or at none; says nothing where nothing changes."""
        if hex != self.hex:
            self.hex = hex
            self.changed.emit()
