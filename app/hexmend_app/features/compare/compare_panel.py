"""Panel that compares methods and runs on one mesh: selection, progress and results."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QTableView, QVBoxLayout, QWidget

from hexmend.smoothers import METHODS
from hexmend_app.features.compare.comparison_table import KEYS, METHOD, ComparisonModel, ComparisonRow
from hexmend_app.theme.palette import MUTED
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import icon_button, push_button, smaller, tabular, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.action_button import ActionButton
from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.tables.row_model import shape_table

_HINT = "Select methods and press Compare methods. Each starts from the current mesh."


@dataclass(frozen=True)
class ComparisonSettings:
    """Selected methods, and the column that sorts the table: "method", "view" or a figure's key."""

    ticked: frozenset[str]
    sorted_by: str
    descending: bool

    def __post_init__(self) -> None:
        if unknown := {*self.ticked.difference(METHODS), *{self.sorted_by}.difference(KEYS)}:
            raise ValueError(f"there is no method or column {min(unknown)!r}")


class ComparePanel(QWidget):
    """Panel that runs a comparison and shows, applies and saves its results.

    Parameters
    ----------
    ticks : sequence of str
        Methods selected by default.

    Attributes
    ----------
    model : ComparisonModel

    Signals
    -------
    use_requested(name)
        The user replaced the mesh by the result of a row.
    """

    use_requested = Signal(str)

    def __init__(self, ticks: Sequence[str] = (), parent: QWidget | None = None):
        super().__init__(parent)
        self._editable = False
        self.model = ComparisonModel(ticks, self)
        help = tr("Replace the mesh by the result of the selected row. Can be undone.")
        self._use = push_button(tr("Use result"), help)
        help = tr("Save the table of methods as CSV, Markdown, LaTeX or JSON.")
        self.save_button = icon_button("content-save-outline", tr("Save table"), help)
        self._status = ElidingLabel()
        self._status.setFont(tabular(smaller(self._status.font())))
        self._status.setAccessibleName(tr("Comparison progress"))
        tint(self._status, MUTED)
        self._table = self._make_table()
        self._lay_out()
        self._use.clicked.connect(lambda: self.use_requested.emit(self._selected()))
        self.set_status()

    def _make_table(self) -> QTableView:
        table = QTableView()
        table.setModel(self.model)
        shape_table(table, tr("Comparison of methods"), METHOD)
        header = table.horizontalHeader()
        header.setSectionResizeMode(header.ResizeMode.Interactive)
        header.setSortIndicator(METHOD, Qt.SortOrder.AscendingOrder)
        header.setSectionsClickable(True)
        table.setSortingEnabled(True)
        table.setHorizontalScrollMode(QTableView.ScrollMode.ScrollPerPixel)
        table.selectionModel().selectionChanged.connect(self._enable)
        return table

    def _lay_out(self) -> None:
        run, cancel, wipe = (ActionButton(id, with_text=True) for id in ("compare", "cancel_comparison", "wipe"))
        head = fill(QHBoxLayout(), run, cancel, None, wipe, self._use, self.save_button, spacing=4)
        fill(QVBoxLayout(self), head, (self._table, 1), self._status, margins=(8, 4, 8, 4), spacing=4)

    def set_entries(self, entries: Sequence[ComparisonRow], full: bool, busy: bool) -> None:
        """Show rows.

        Parameters
        ----------
        entries : sequence of ComparisonRow
        full : bool
            The largest number of views is open.
        busy : bool
            Methods are running.
        """
        self.model.fill(entries, full, busy)
        self._table.resizeColumnsToContents()
        self._table.setColumnWidth(METHOD, self._table.columnWidth(METHOD) + 8)  # Qt leaves too little for the boxes
        self._enable()

    def settings(self) -> ComparisonSettings:
        """Return the panel's settings."""
        header = self._table.horizontalHeader()
        descending = header.sortIndicatorOrder() == Qt.SortOrder.DescendingOrder
        return ComparisonSettings(frozenset(self.model.ticks), KEYS[header.sortIndicatorSection()], descending)

    def restore(self, settings: ComparisonSettings) -> None:
        """Apply settings."""
        self.model.tick(settings.ticked)
        order = Qt.SortOrder.DescendingOrder if settings.descending else Qt.SortOrder.AscendingOrder
        self._table.sortByColumn(KEYS.index(settings.sorted_by), order)

    def set_editable(self, editable: bool) -> None:
        """Set whether the mesh may be changed."""
        self._editable = editable
        self._enable()

    def set_status(self, text: str = "") -> None:
        """Show the progress, or a hint if there is none."""
        self._status.setText(text or tr(_HINT))
        self._status.setToolTip(text)

    def _selected(self) -> str:
        """Return the name of the selected row, "" if none is."""
        rows = self._table.selectionModel().selectedRows()
        return self.model.rows[rows[0].row()].name if rows else ""

    def _enable(self) -> None:
        model, name = self.model, self._selected()
        has_mesh = any(one.name == name and one.has_mesh for one in model.rows)
        self._use.setEnabled(self._editable and has_mesh)
        self.save_button.setEnabled(any(one.record and one.is_method for one in model.rows) and not model.busy)
