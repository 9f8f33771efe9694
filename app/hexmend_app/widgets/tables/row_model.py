"""Base of table models with a row for each of some things."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, QPersistentModelIndex, Qt
from PySide6.QtGui import QBrush, QColor
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView

from hexmend_app.theme.palette import MUTED
from hexmend_app.theme.style import tabular


class RowModel(QAbstractTableModel):
    """Model of rows; subclasses have the data of a row, and the titles of the columns.

    Attributes
    ----------
    rows : sequence or array

    Parameters
    ----------
    columns : int
        Number of columns.
    texts : collection of int
        Columns of texts, which are aligned on the left; the others have numbers.
    """

    def __init__(self, columns: int, texts: Collection[int], parent: QObject | None = None):
        super().__init__(parent)
        self.rows: Any = ()
        self._columns, self._text_columns = columns, texts

    def set_rows(self, rows: Any, same: bool) -> None:
        """Replace the rows; with the `same` ones of other values, the view keeps its selection and scroll position."""
        if not same:
            self.beginResetModel()
        self.rows = rows
        if not same:
            self.endResetModel()
        elif len(rows):
            self.dataChanged.emit(self.index(0, 0), self.index(len(rows) - 1, self._columns - 1))

    def title(self, column: int) -> str:
        """Return the title of a column."""
        raise NotImplementedError

    def help(self, column: int) -> str:
        """Return the help of a column."""
        return ""

    def alignment(self, column: int) -> int:
        """Return the alignment of a column."""
        side = Qt.AlignmentFlag.AlignLeft if column in self._text_columns else Qt.AlignmentFlag.AlignRight
        return int(side | Qt.AlignmentFlag.AlignVCenter)

    def rowCount(self, parent: QModelIndex | QPersistentModelIndex | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(self.rows)

    def columnCount(self, parent: QModelIndex | QPersistentModelIndex | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else self._columns

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == Qt.ItemDataRole.DisplayRole:
            return self.title(section)
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return self.alignment(section)
        if role == Qt.ItemDataRole.ForegroundRole:
            return QBrush(QColor(str(MUTED)))
        return f"<qt>{self.help(section)}</qt>" if role == Qt.ItemDataRole.ToolTipRole and self.help(section) else None


def shape_table(table: QTableView, name: str, stretched: int) -> None:
    """Style a table: single selection of rows, no grid and row numbers, and one stretched column.

    Parameters
    ----------
    table : QTableView
        Table with its model or columns set.
    name : str
        Accessible name.
    stretched : int
        Column that fills the remaining width.
    """
    table.setFont(tabular(table.font()))
    table.setAccessibleName(name)
    table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
    table.setShowGrid(False)
    table.setAlternatingRowColors(True)
    table.setTabKeyNavigation(False)
    table.setWordWrap(False)
    table.verticalHeader().hide()
    table.verticalHeader().setDefaultSectionSize(table.fontMetrics().height() + 5)
    header = table.horizontalHeader()
    header.setHighlightSections(False)
    header.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
    header.setSectionResizeMode(stretched, QHeaderView.ResizeMode.Stretch)
