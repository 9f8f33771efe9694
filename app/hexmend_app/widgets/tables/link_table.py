"""Table in which some cells are links."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QTableWidget, QWidget


class LinkTable(QTableWidget):
    """Table in which a link is followed by a click on its cell, or by Enter in its row.

    Signals
    -------
    link_activated(str)
        The user followed this link.
    """

    link_activated = Signal(str)

    def __init__(self, rows: int, columns: int, parent: QWidget | None = None):
        super().__init__(rows, columns, parent)
        self._links: dict[tuple[int, int], str] = {}
        self.setMouseTracking(True)
        self.cellClicked.connect(lambda row, column: self._follow(self._links.get((row, column))))

    def set_link(self, row: int, column: int, link: str | None) -> None:
        """Make a cell a link; None removes its link."""
        if link is None:
            self._links.pop((row, column), None)
        else:
            self._links[row, column] = link

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Follow the link of the row by Enter."""
        row = self.currentRow()
        link = next((link for (at, _), link in self._links.items() if at == row), None)
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and link is not None:
            self._follow(link)
        else:
            super().keyPressEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Show a pointing hand over links."""
        index = self.indexAt(event.position().toPoint())
        over = (index.row(), index.column()) in self._links
        self.viewport().setCursor(Qt.CursorShape.PointingHandCursor if over else Qt.CursorShape.ArrowCursor)
        super().mouseMoveEvent(event)

    def _follow(self, link: str | None) -> None:
        if link is not None:
            self.link_activated.emit(link)
