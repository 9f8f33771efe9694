"""Panel that compares methods and runs on one mesh: selection, progress and results."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QModelIndex, Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QTableView, QVBoxLayout, QWidget

from hexmend.smoothers import METHODS
from hexmend_app.codec.checks import check_known
from hexmend_app.features.compare.comparison_table import KEYS, METHOD, VIEW, ComparisonModel, ComparisonRow
from hexmend_app.theme.palette import MUTED
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import icon, set_help, smaller, tabular, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.tables.hex_table import shape_table

_HINT = "Select methods and press Compare. Each starts from the current mesh."

#: Width of a column in addition to its text, without and with a check box, in pixels.
_PADDING, _CHECK_PADDING = 14, 26


@dataclass(frozen=True)
class ComparisonSettings:
    """Selected methods, and the column that sorts the table: "method", "view" or a figure's key."""

    ticked: frozenset[str]
    sorted_by: str
    descending: bool

    def __post_init__(self) -> None:
        from hexmend.report.comparison import LINES

        check_known("method", self.ticked, METHODS)
        check_known("column", (self.sorted_by,), ("method", "view", *(figure.key for figure in LINES)))


class ComparePanel(QWidget):
    """Panel that runs a comparison and shows, applies and saves its results.

    Parameters
    ----------
    ticks : sequence of str
        Methods selected by default.

    Signals
    -------
    run_requested(names)
        The user started these methods, in the order of the unsorted table.
    view_toggled(name, on)
        The user showed or hid the mesh of a row.
    use_requested(name)
        The user replaced the mesh by the result of a row.
    can_run_changed
        The value of `can_run` changed.
    """

    run_requested = Signal(list)
    view_toggled = Signal(str, bool)
    use_requested = Signal(str)
    can_run_changed = Signal()

    def __init__(self, ticks: Sequence[str] = (), parent: QWidget | None = None):
        super().__init__(parent)
        self._runnable = self._editable = False
        self._names: list[str] = []
        self._model = ComparisonModel(ticks, self)
        self._model.view_toggled.connect(self.view_toggled)
        self._model.ticked.connect(self._enable)
        self._run = QPushButton(icon("play"), tr("Compare"))
        set_help(self._run, tr("Compare methods"), tr("Run the selected methods in turn. The mesh does not change."))
        self.cancel_button = QPushButton(icon("stop"), tr("Cancel"))
        set_help(
            self.cancel_button, tr("Cancel comparison"), tr("Stop after the current iteration and keep the results.")
        )
        self.wipe_button = QPushButton(icon("compare"), tr("Wipe"))
        self.wipe_button.setCheckable(True)
        set_help(self.wipe_button, tr("Wipe"), tr("Show two views in one, with an edge between them to drag (W)."))
        self._use = QPushButton(tr("Use result"))
        set_help(self._use, tr("Use result"), tr("Replace the mesh by the result of the selected row. Can be undone."))
        self.save_button = QPushButton(icon("content-save-outline"), "")
        set_help(self.save_button, tr("Save table"), tr("Save the table of methods as CSV, Markdown, LaTeX or JSON."))
        self._status = ElidingLabel()
        self._status.setFont(tabular(smaller(self._status.font())))
        self._status.setAccessibleName(tr("Comparison progress"))
        tint(self._status, MUTED)
        self._table = self._make_table()
        self._lay_out()
        self._run.clicked.connect(self.run)
        self._use.clicked.connect(lambda: self.use_requested.emit(self._selected()))
        self.set_status()

    def _make_table(self) -> QTableView:
        table = QTableView()
        table.setModel(self._model)
        shape_table(table, tr("Comparison of methods"), METHOD)
        header = table.horizontalHeader()
        header.setSectionResizeMode(header.ResizeMode.Interactive)
        header.setSortIndicator(METHOD, Qt.SortOrder.AscendingOrder)
        header.setSectionsClickable(True)
        table.setSortingEnabled(True)
        table.setHorizontalScrollMode(QTableView.ScrollMode.ScrollPerPixel)
        table.selectionModel().selectionChanged.connect(self._enable)
        table.doubleClicked.connect(self._toggle)
        return table

    def _lay_out(self) -> None:
        row = (self._run, self.cancel_button, None, self.wipe_button, self._use, self.save_button)
        buttons = [button for button in row if button is not None]
        height = max(button.sizeHint().height() for button in buttons)  # buttons with an icon are taller
        for button in buttons:
            button.setFixedHeight(height)
        head = fill(QHBoxLayout(), *row, spacing=4)
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
        self._names = [entry.name for entry in entries]
        self._model.fill(entries, full, busy)
        self._fit_columns()
        self._enable()

    def settings(self) -> ComparisonSettings:
        """Return the panel's settings."""
        header = self._table.horizontalHeader()
        descending = header.sortIndicatorOrder() == Qt.SortOrder.DescendingOrder
        return ComparisonSettings(frozenset(self._model.ticks), KEYS[header.sortIndicatorSection()], descending)

    def restore(self, settings: ComparisonSettings) -> None:
        """Apply settings."""
        self._model.tick(settings.ticked)
        order = Qt.SortOrder.DescendingOrder if settings.descending else Qt.SortOrder.AscendingOrder
        self._table.sortByColumn(KEYS.index(settings.sorted_by), order)

    def _fit_columns(self) -> None:
        """Fit the column widths to their contents."""
        table, model = self._table, self._model
        header_metrics, cell_metrics = table.horizontalHeader().fontMetrics(), table.fontMetrics()
        for column in range(model.columnCount()):
            title = model.headerData(column, Qt.Orientation.Horizontal)
            texts = [model.index(row, column).data() for row in range(model.rowCount())]
            width = max((cell_metrics.horizontalAdvance(f"{text}0") for text in texts if text), default=0)
            width += _CHECK_PADDING if column == METHOD else _PADDING
            table.setColumnWidth(column, max(header_metrics.horizontalAdvance(title) + _PADDING, width))

    def set_state(self, runnable: bool, editable: bool, several: bool, wiping: bool) -> None:
        """Enable the controls.

        Parameters
        ----------
        runnable : bool
            Methods may run.
        editable : bool
            The mesh may be changed.
        several : bool
            There are several views.
        wiping : bool
            Two views are shown as a wipe.
        """
        self._runnable, self._editable = runnable, editable
        self.wipe_button.setEnabled(several)
        self.wipe_button.setChecked(wiping)
        self._enable()

    def set_status(self, text: str = "") -> None:
        """Show the progress, or a hint if there is none."""
        self._status.setText(text or tr(_HINT))
        self._status.setToolTip(text)

    def run(self) -> None:
        """Request a run of the selected methods."""
        if self._run.isEnabled():
            self.run_requested.emit([name for name in self._names if name in self._model.ticks])

    @property
    def can_run(self) -> bool:
        """Return True if methods are selected and may run."""
        return self._runnable and bool(self._model.ticks)

    def _selected(self) -> str:
        """Return the name of the selected row, "" if none is."""
        rows = self._table.selectionModel().selectedRows()
        return self._model.rows[rows[0].row()].name if rows else ""

    def _toggle(self, index: QModelIndex) -> None:
        if index.column() != METHOD:
            view = self._model.index(index.row(), VIEW)
            if self._model.flags(view) & Qt.ItemFlag.ItemIsUserCheckable:
                entry = self._model.rows[index.row()]
                self.view_toggled.emit(entry.name, not entry.shown)

    def _enable(self) -> None:
        model, name = self._model, self._selected()
        if self._run.isEnabled() != self.can_run:
            self._run.setEnabled(self.can_run)
            self.can_run_changed.emit()
        self.cancel_button.setEnabled(model.busy)
        has_mesh = any(one.name == name and one.has_mesh for one in model.rows)
        self._use.setEnabled(self._editable and has_mesh)
        self.save_button.setEnabled(any(one.record and one.is_method for one in model.rows) and not model.busy)
