"""The element and the node that are looked at."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal


class Selection(QObject):
    """One element of the open mesh and one of its nodes, or none.

    Signals
    -------
    changed
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.hex: int | None = None
        self.node: int | None = None

    def choose(self, hex: int | None, node: int | None = None) -> None:
        """Look at another element and node, or at none; says nothing where nothing changes."""
        if (hex, node) != (self.hex, self.node):
            self.hex, self.node = hex, node
            self.changed.emit()
