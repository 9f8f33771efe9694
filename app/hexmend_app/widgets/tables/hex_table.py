"""Style and keyboard navigation of tables."""

from __future__ import annotations

from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView

from hexmend_app.theme.style import tabular


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
