"""Table model of the list of the worst hexes."""

from __future__ import annotations

from typing import Any

import numpy as np
from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, QPersistentModelIndex, Qt
from PySide6.QtGui import QBrush, QColor

from hexmend_app.state.mesh.worst_hexes import WorstHexes
from hexmend_app.theme.style import INVERTED_TEXT, MUTED
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import figure

_TITLES = ("Hex", "In the file", "", "Scaled Jacobian", "State")
#: Columns of the table.
HEX, ID, VALUE, JACOBIAN, STATE = range(5)
_RIGHT = int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
_LEFT = int(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)


class WorstModel(QAbstractTableModel):
    """Table model with one row per hex.

    Attributes
    ----------
    hexes : (k,) int64
        Numbers of the hexes.
    values, jacobians : (k,) float64
        Values of the metric that sorts the list, and scaled Jacobians.
    states : list of str
        "locked", "inverted", "inside" (invalid inside) or "" for each hex.
    ids : (k,) int, optional
        Numbers of the hexes in the file.
    title : str
        Title of the metric.
    """

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.hexes = np.empty(0, np.int64)
        self.values = self.jacobians = np.empty(0)
        self.states: list[str] = []
        self.ids: np.ndarray | None = None
        self.title = ""

    def fill(self, worst: WorstHexes) -> None:
        """Replace the rows."""
        hexes = worst.hexes
        same = len(hexes) == len(self.hexes)
        if not same:
            self.beginResetModel()
        self.hexes, self.values, self.jacobians = hexes, worst.values, worst.jacobians
        self.states, self.ids = worst.states, worst.ids
        if same:  # no reset: the table keeps its scroll position
            self.dataChanged.emit(self.index(0, 0), self.index(max(len(hexes) - 1, 0), len(_TITLES) - 1))
        else:
            self.endResetModel()

    def rowCount(self, parent: QModelIndex | QPersistentModelIndex | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(self.hexes)

    def columnCount(self, parent: QModelIndex | QPersistentModelIndex | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(_TITLES)

    def data(self, index: QModelIndex | QPersistentModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        row, column = index.row(), index.column()
        if role == Qt.ItemDataRole.DisplayRole:
            if column == HEX:
                return f"{self.hexes[row]:,}"
            if column == ID:
                return "" if self.ids is None else str(self.ids[row])
            if column == STATE:
                return tr(self.states[row])
            return figure(float((self.values if column == VALUE else self.jacobians)[row]))
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return _LEFT if column == STATE else _RIGHT
        if role == Qt.ItemDataRole.ForegroundRole and column == STATE:
            return QBrush(QColor(str(INVERTED_TEXT)))
        return None

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == Qt.ItemDataRole.DisplayRole:
            return self.title if section == VALUE else tr(_TITLES[section])
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return _LEFT if section == STATE else _RIGHT
        if role == Qt.ItemDataRole.ForegroundRole:
            return QBrush(QColor(str(MUTED)))
        return None
