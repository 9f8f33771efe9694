"""Table model of the list of the worst hexes."""

from __future__ import annotations

from typing import Any

import numpy as np
from PySide6.QtCore import QModelIndex, QObject, QPersistentModelIndex, Qt
from PySide6.QtGui import QBrush, QColor

from hexmend_app.state.mesh.worst_hexes import WorstHexes
from hexmend_app.theme.style import INVERTED_TEXT
from hexmend_app.translation import tr
from hexmend_app.widgets.tables.row_model import RowModel
from hexmend_app.widgets.wording import figure

_TITLES = ("Hex", "In the file", "", "Scaled Jacobian", "State")
#: Columns of the table.
HEX, ID, VALUE, JACOBIAN, STATE = range(5)


class WorstModel(RowModel):
    """Table model with one row per hex.

    Attributes
    ----------
    values, jacobians : (k,) float64
        Values of the metric that sorts the list, and scaled Jacobians.
    states : list of str
        "locked", "inverted", "inside" (invalid inside) or "" for each hex.
    ids : (k,) int, optional
        Numbers of the hexes in the file.
    metric : str
        Title of the metric.
    """

    def __init__(self, parent: QObject | None = None):
        super().__init__(len(_TITLES), (STATE,), parent)
        self.rows = np.empty(0, np.int64)
        self.values = self.jacobians = np.empty(0)
        self.states: list[str] = []
        self.ids: np.ndarray | None = None
        self.metric = ""

    def fill(self, worst: WorstHexes) -> None:
        """Replace the rows, which are numbers of hexes, (k,) int64."""
        self.values, self.jacobians, self.states, self.ids = worst.values, worst.jacobians, worst.states, worst.ids
        self.set_rows(worst.hexes, len(worst.hexes) == len(self.rows))

    def title(self, column: int) -> str:
        """Return the title of a column."""
        return self.metric if column == VALUE else tr(_TITLES[column])

    def data(self, index: QModelIndex | QPersistentModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        row, column = index.row(), index.column()
        if role == Qt.ItemDataRole.DisplayRole:
            if column == HEX:
                return f"{self.rows[row]:,}"
            if column == ID:
                return "" if self.ids is None else str(self.ids[row])
            if column == STATE:
                return tr(self.states[row])
            return figure(float((self.values if column == VALUE else self.jacobians)[row]))
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return self.alignment(column)
        if role == Qt.ItemDataRole.ForegroundRole and column == STATE:
            return QBrush(QColor(str(INVERTED_TEXT)))
        return None
