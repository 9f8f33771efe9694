"""Panel with the list of the worst hexes, its table model, and the list as a file."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import Any

import numpy as np
from PySide6.QtCore import QItemSelection, QItemSelectionModel, QModelIndex, QObject, QPersistentModelIndex, Qt, Signal
from PySide6.QtGui import QBrush, QColor, QShowEvent
from PySide6.QtWidgets import QHBoxLayout, QTableView, QVBoxLayout, QWidget

from hexmend.io.storage.suffixes import suffix_for
from hexmend.mesh.mesh import Mesh
from hexmend.quality import METRICS, ElementQuality, measure
from hexmend.report.documents import write_text
from hexmend_app.state.mesh.selection import WorstHexes
from hexmend_app.theme.palette import INVERTED_TEXT
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import check_box, icon_button, labelled, set_help, small_label
from hexmend_app.translation import tr
from hexmend_app.widgets.action_button import ActionButton
from hexmend_app.widgets.inputs.combo import ComboBox
from hexmend_app.widgets.metric_texts import described, metrics_offered
from hexmend_app.widgets.tables.row_model import RowModel, shape_table
from hexmend_app.widgets.wording import counted, figure, noun_of, noun_of_cells

_ORDER = (
    "Metric that sorts the list after inverted hexes and those that are invalid inside, which come first; hexes of "
    "equal value are sorted by scaled Jacobian."
)
_TITLES = ("Hex", "Kind", "In the file", "", "Scaled Jacobian", "State")
#: Columns of the table.
HEX, KIND, ID, VALUE, JACOBIAN, STATE = range(6)


class WorstModel(RowModel):
    """Table model with one row per hex.

    Attributes
    ----------
    worst : WorstHexes
        The hexes, whose numbers are the rows.
    metric : str
        Title of the metric that sorts the list.
    """

    worst: WorstHexes

    def __init__(self, parent: QObject | None = None):
        super().__init__(len(_TITLES), (KIND, STATE), parent)
        self.rows = np.empty(0, np.int64)
        self.metric = ""

    def fill(self, worst: WorstHexes, metric: str) -> None:
        """Show the worst hexes by the metric with a title."""
        self.worst, self.metric = worst, metric
        self.set_rows(worst.hexes, len(worst.hexes) == len(self.rows))

    def title(self, column: int) -> str:
        """Return the title of a column."""
        if column == HEX and self.rows.size and self.worst.kinds is not None:
            return tr("Cell")
        return self.metric if column == VALUE else tr(_TITLES[column])

    def data(self, index: QModelIndex | QPersistentModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        row, column, worst = index.row(), index.column(), self.worst
        if role == Qt.ItemDataRole.DisplayRole:
            if column == HEX:
                return str(worst.hexes[row])
            if column == KIND:
                return "" if worst.kinds is None else tr(noun_of(worst.kinds[row]))
            if column == ID:
                return "" if worst.ids is None else str(worst.ids[row])
            if column == STATE:
                return tr(worst.states[row])
            return figure(float((worst.values if column == VALUE else worst.jacobians)[row]))
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return self.alignment(column)
        if role == Qt.ItemDataRole.ForegroundRole and column == STATE:
            return QBrush(QColor(str(INVERTED_TEXT)))
        return None


def write_worst(path: str | Path, mesh: Mesh, metric: str = "q") -> None:
    """Write the worst hexes of a mesh as CSV: number, metric, scaled Jacobian, state.

    Columns follow of the numbers in the file, and of the kinds in a mesh of several, if there are any.

    Parameters
    ----------
    path : path-like
    mesh : Mesh
    metric : str
        A name of `hexmend.quality.METRICS`.

    Raises
    ------
    FileError
        If the suffix is not .csv or the file cannot be written; an existing file is left unchanged.
    """
    suffix_for(Path(path), "a list", (".csv",))
    worst, out = WorstHexes.of(mesh, measure(mesh.points, mesh.elements, mesh.mid_nodes), metric), io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    head = [name for name, values in (("id", worst.ids), ("kind", worst.kinds)) if values is not None]
    writer.writerow(["hex", metric, "scaled-jacobian", "state", *head])
    columns = [worst.hexes.tolist(), worst.values.tolist(), worst.jacobians.tolist(), worst.states]
    columns += [worst.ids.tolist()] if worst.ids is not None else []
    columns += [worst.kinds] if worst.kinds is not None else []
    writer.writerows(zip(*columns, strict=True))
    write_text(Path(path), out.getvalue())


class WorstList(QWidget):
    """Lists the worst hexes by a metric, worst first, and steps through them.

    Signals
    -------
    chosen(int)
        The user selected this hex.
    metric_chosen(str)
        The user chose another metric.
    """

    chosen = Signal(int)
    metric_chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._mesh: Mesh | None = None
        self._quality: ElementQuality | None = None
        self._selected: int | None = None
        self._visited: int | None = None  # the hex from which next and previous go on
        self._stale = False
        self.metric_box = ComboBox()
        for metric in metrics_offered():
            self.metric_box.add(tr(metric.title), described(metric), metric.name)
        set_help(self.metric_box, tr("Worst by"), tr(_ORDER))
        self.metric_box.currentIndexChanged.connect(self._begin_again)
        self.metric_box.currentIndexChanged.connect(self._refresh)
        self.metric_box.currentIndexChanged.connect(lambda: self.metric_chosen.emit(self.chosen_metric))
        help = tr("Show only the selected hex and its neighbours; Esc shows all hexes again.")
        self.isolate = check_box(tr("Isolate"), help, on=True)
        help = tr("Save the list as CSV, one line per hex.")
        self.save_button = icon_button("content-save-outline", tr("Save list"), help)
        self._model = WorstModel(self)
        self._table = self._make_table()
        self._text = small_label()
        self._lay_out()
        self._refresh()

    def _make_table(self) -> QTableView:
        table = QTableView()
        table.setModel(self._model)
        shape_table(table, tr("Worst hexes"), STATE)
        jacobian = tr("Scaled Jacobian")
        widths = {HEX: "000,000,000", KIND: "tetrahedron", ID: "000000000", VALUE: jacobian, JACOBIAN: jacobian}
        for column, widest in widths.items():
            table.setColumnWidth(column, table.fontMetrics().horizontalAdvance(widest) + 14)
        # Not currentChanged: the first row becomes current when the table gets the focus.
        table.selectionModel().selectionChanged.connect(self._on_selected)
        table.activated.connect(self._on_row)  # Enter, or a double-click
        return table

    def _lay_out(self) -> None:
        previous, following = ActionButton("previous_worst", "chevron-up"), ActionButton("next_worst", "chevron-down")
        buttons = (self.isolate, previous, following, self.save_button)
        label = labelled(tr("Worst by"), self.metric_box)
        head = fill(QHBoxLayout(), label, self.metric_box, None, *buttons, spacing=4)
        fill(QVBoxLayout(self), head, (self._table, 1), self._text, margins=(8, 4, 8, 4), spacing=4)

    # Contents

    def set_quality(self, mesh: Mesh, quality: ElementQuality) -> None:
        """Show the worst hexes of a mesh; while the list is hidden, it is filled later, when needed."""
        if self._mesh is None or mesh.points is not self._mesh.points:  # pins and tags do not change the order
            self._begin_again()
        self._mesh, self._quality = mesh, quality
        self._stale = not self.isVisible()
        if not self._stale:
            self._refresh()

    def showEvent(self, event: QShowEvent) -> None:
        """Fill the list if the mesh has changed while it was hidden."""
        super().showEvent(event)
        self._refresh_if_stale()

    def set_selected(self, hex: int | None) -> None:
        """Select the row of a hex if it is listed, without emitting a signal."""
        self._selected = hex
        self._select_row()

    @property
    def hexes(self) -> np.ndarray:
        """Numbers of the listed hexes, worst first: (k,) int64."""
        self._refresh_if_stale()
        return self._model.rows

    def next(self) -> None:
        """Select the next hex of the list, or the worst if the selected hex was not selected in the list."""
        self._step(1)

    def previous(self) -> None:
        """Select the previous hex of the list, or the last if the selected hex was not selected in the list."""
        self._step(-1)

    @property
    def chosen_metric(self) -> str:
        """Metric by which the list is sorted."""
        return self.metric_box.currentData()

    def _refresh_if_stale(self) -> None:
        if self._stale:
            self._stale = False
            self._refresh()

    def _selected_row(self) -> int | None:
        rows = np.flatnonzero(self._model.rows == self._selected) if self._selected is not None else np.empty(0)
        return int(rows[0]) if len(rows) else None

    def _step(self, by: int) -> None:
        hexes = self.hexes
        if not len(hexes):
            return
        row = self._selected_row() if self._selected == self._visited else None
        row = (0 if by > 0 else -1) if row is None else (row + by) % len(hexes)
        self._visit(row)

    def _visit(self, row: int) -> None:
        self._visited = int(self._model.rows[row])
        self.chosen.emit(self._visited)

    def _begin_again(self) -> None:
        """Let the next step begin with the worst hex."""
        self._visited = None

    def _refresh(self) -> None:
        mesh, quality = self._mesh, self._quality
        self.save_button.setEnabled(mesh is not None)
        if mesh is None:
            self._text.setText(tr("No mesh is open."))
            return
        metric = METRICS[self.chosen_metric]
        worst = WorstHexes.of(mesh, quality, metric.name)
        self._table.setColumnHidden(JACOBIAN, metric.name == "scaled-jacobian")
        self._table.setColumnHidden(ID, worst.ids is None)
        self._table.setColumnHidden(KIND, worst.kinds is None)
        self._model.fill(worst, tr(metric.title))
        total = counted(mesh.n_elements, noun_of_cells(mesh))
        counts = {"total": total, "inverted": quality.n_inverted, "invalid": quality.n_invalid}
        if worst.hexes.size == mesh.n_elements:
            text = tr("{total}, {inverted:,} inverted, {invalid:,} invalid.", **counts)
        else:
            counts["listed"] = worst.hexes.size
            text = tr("The {listed:,} worst of {total}, {inverted:,} inverted, {invalid:,} invalid.", **counts)
        if metric.name != "scaled-jacobian":
            text += " " + tr("Ties are sorted by scaled Jacobian.")
        self._text.setText(text)
        self._select_row()

    def _select_row(self) -> None:
        selection, row = self._table.selectionModel(), self._selected_row()
        selection.blockSignals(True)
        if row is None:
            selection.clear()
        else:
            index = self._model.index(row, 0)
            flags = QItemSelectionModel.SelectionFlag
            selection.setCurrentIndex(index, flags.ClearAndSelect | flags.Rows)
            self._table.scrollTo(index)
        selection.blockSignals(False)
        self._table.viewport().update()

    def _on_selected(self, selected: QItemSelection) -> None:
        if selected.indexes():
            self._on_row(selected.indexes()[0])

    def _on_row(self, index: QModelIndex) -> None:
        self._visit(index.row())
