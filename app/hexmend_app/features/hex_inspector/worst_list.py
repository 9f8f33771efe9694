"""The list of the worst elements."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QItemSelection, QItemSelectionModel, QModelIndex, Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QTableView,
    QVBoxLayout,
    QWidget,
)

from hexmend.mesh.mesh import Mesh
from hexmend.quality import METRICS, ElementQuality
from hexmend_app.codec.checks import check_known
from hexmend_app.features.hex_inspector.worst_model import ELEMENT, JACOBIAN, STATE, VALUE, WorstModel
from hexmend_app.state.mesh.worst_hexes import Worst
from hexmend_app.theme.style import icon, note, set_help
from hexmend_app.widgets.metric_texts import described, metrics_offered
from hexmend_app.widgets.tables.hex_table import shape_table
from hexmend_app.widgets.wording import counted


@dataclass(frozen=True)
class WorstListSettings:
    """By which metric the worst hexes are listed, and whether the one that is gone to is isolated."""

    metric: str
    isolates: bool

    def __post_init__(self) -> None:
        check_known("metric", (self.metric,), METRICS)


class WorstList(QWidget):
    """Lists the worst elements, the worst first, and walks through them.

    Signals
    -------
    chosen(int)
        The user wants to see this element.
    metric_chosen(str)
        The list is ranked by another metric.
    save_requested
        The user wants the list as a file.
    """

    chosen = Signal(int)
    metric_chosen = Signal(str)
    save_requested = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._mesh: Mesh | None = None
        self._figures: ElementQuality | None = None
        self._selected: int | None = None
        self._stale = False
        self._metric = QComboBox()
        for metric in metrics_offered():
            self._metric.addItem(metric.title, metric.name)
            self._metric.setItemData(self._metric.count() - 1, described(metric), Qt.ItemDataRole.ToolTipRole)
        set_help(
            self._metric,
            "Worst by",
            "The figure that the list is ordered by, and nothing else; of equal hexes, the lower scaled Jacobian "
            "comes first.",
        )
        self._metric.currentIndexChanged.connect(self._refresh)
        self._metric.currentIndexChanged.connect(lambda: self.metric_chosen.emit(self.chosen_metric))
        self._alone = QCheckBox("Isolate")
        self._alone.setChecked(True)
        set_help(
            self._alone, "Isolate", "Show nothing but the chosen hex and its neighbours; Esc brings back the rest."
        )
        self._previous = self._button("chevron-up", "Previous", "The hex before it in the list (Shift+N).")
        self._next = self._button("chevron-down", "Next", "The next hex of the list, from the worst on (N).")
        self._save = self._button("content-save-outline", "Save list", "Save the list as CSV, a line a hex.")
        self._previous.clicked.connect(self.previous)
        self._next.clicked.connect(self.next)
        self._save.clicked.connect(self.save_requested)
        self._model = WorstModel(self)
        self._table = self._make_table()
        self._text = note()
        self._text.setWordWrap(False)
        self._lay_out()
        self._refresh()

    def _button(self, picture: str, name: str, help: str) -> QPushButton:
        button = QPushButton(icon(picture), "")  # no words: the dock is narrow
        set_help(button, name, help)
        return button

    def _make_table(self) -> QTableView:
        table = QTableView()
        table.setModel(self._model)
        shape_table(table, "Worst hexes", STATE)
        for column, widest in ((ELEMENT, "000,000,000"), (VALUE, "Scaled Jacobian"), (JACOBIAN, "Scaled Jacobian")):
            table.setColumnWidth(column, table.fontMetrics().horizontalAdvance(widest) + 14)
        # Not when a row becomes the current one: the first does so as the list gets the focus.
        table.selectionModel().selectionChanged.connect(self._on_selected)
        table.activated.connect(self._on_row)  # Enter, or a double-click
        return table

    def _lay_out(self) -> None:
        head = QHBoxLayout()
        label = QLabel("Worst by")
        label.setBuddy(self._metric)
        for part in (label, self._metric):
            head.addWidget(part)
        head.addStretch()
        for part in (self._alone, self._previous, self._next, self._save):
            head.addWidget(part)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(6, 4, 6, 4)
        layout.setSpacing(4)
        layout.addLayout(head)
        layout.addWidget(self._table, 1)
        layout.addWidget(self._text)

    def settings(self) -> WorstListSettings:
        """Return the current settings."""
        return WorstListSettings(self.chosen_metric, self.isolates)

    def restore(self, settings: WorstListSettings) -> None:
        """Set all of it."""
        self._metric.setCurrentIndex(self._metric.findData(settings.metric))
        self._alone.setChecked(settings.isolates)

    # What is listed

    def set_figures(self, mesh: Mesh, figures: ElementQuality) -> None:
        """Take the mesh as it is now; the list is made only while it can be seen."""
        self._mesh, self._figures = mesh, figures
        self._stale = not self.isVisible()
        if not self._stale:
            self._refresh()

    def showEvent(self, event: QShowEvent) -> None:
        """Make the list that was put off."""
        super().showEvent(event)
        self._bring_up_to_date()

    def set_selected(self, element: int | None) -> None:
        """Mark an element's row, if it is listed; without a signal."""
        self._selected = element
        self._mark()

    @property
    def isolates(self) -> bool:
        """True if a hex selected in the list is isolated with its neighbours."""
        return self._alone.isChecked()

    @property
    def elements(self) -> np.ndarray:
        """The elements listed, the worst first."""
        self._bring_up_to_date()
        return self._model.elements

    def next(self) -> None:
        """Choose the next worse element of the list: the first where none of it is chosen."""
        self._walk(1)

    def previous(self) -> None:
        """Choose the one before."""
        self._walk(-1)

    @property
    def chosen_metric(self) -> str:
        """Metric by which the list is sorted."""
        return self._metric.currentData()

    def _bring_up_to_date(self) -> None:
        if self._stale:
            self._stale = False
            self._refresh()

    def _walk(self, by: int) -> None:
        elements = self.elements
        if not len(elements):
            return
        at = np.flatnonzero(elements == self._selected) if self._selected is not None else []
        row = (int(at[0]) + by) % len(elements) if len(at) else (0 if by > 0 else len(elements) - 1)
        self.chosen.emit(int(elements[row]))

    def _refresh(self) -> None:
        mesh, figures = self._mesh, self._figures
        for button in (self._previous, self._next, self._save):
            button.setEnabled(mesh is not None)
        if mesh is None:
            self._text.setText("No mesh is open.")
            return
        metric = METRICS[self.chosen_metric]
        found = Worst.of(mesh, figures, metric.name)
        self._model.title = metric.title
        self._table.setColumnHidden(JACOBIAN, metric.name == "scaled-jacobian")
        self._model.fill(found.elements, found.values, found.jacobians, found.states)
        shown = "" if found.elements.size == mesh.n_hexes else f"The {found.elements.size:,} worst of "
        order = "" if metric.name == "scaled-jacobian" else "; equal ones by scaled Jacobian"
        self._text.setText(f"{shown}{counted(mesh.n_hexes, 'hex')}, {figures.n_inverted:,} inverted{order}")
        self._mark()

    def _mark(self) -> None:
        choice = self._table.selectionModel()
        at = np.flatnonzero(self._model.elements == self._selected) if self._selected is not None else []
        choice.blockSignals(True)
        if len(at):
            index = self._model.index(int(at[0]), 0)
            flags = QItemSelectionModel.SelectionFlag
            choice.setCurrentIndex(index, flags.ClearAndSelect | flags.Rows)
            self._table.scrollTo(index)
        else:
            choice.clear()
        choice.blockSignals(False)
        self._table.viewport().update()

    def _on_selected(self, selected: QItemSelection) -> None:
        if selected.indexes():
            self._on_row(selected.indexes()[0])

    def _on_row(self, index: QModelIndex) -> None:
        self.chosen.emit(int(self._model.elements[index.row()]))
