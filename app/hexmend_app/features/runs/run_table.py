"""Table model of the results of all runs, with those that others dominate."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

from PySide6.QtCore import QModelIndex, QObject, QPersistentModelIndex, Qt
from PySide6.QtGui import QBrush, QColor, QFont

from hexmend.quality import SUMMARY_QUANTITIES
from hexmend_app.features.runs.dominance import KEY_FIGURES
from hexmend_app.state.mesh.run_record import RunRecord
from hexmend_app.theme.palette import MUTED, TEXT, WORSE, Role
from hexmend_app.theme.style import bold, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.tables.row_model import RowModel
from hexmend_app.widgets.wording import figure

#: Quantities with a column.
QUANTITIES = tuple(SUMMARY_QUANTITIES[key] for key in KEY_FIGURES)
#: Columns before those of the quantities.
NAME, SETTINGS, FIRST = 0, 1, 2

_HELP = (
    "Click a run to show its result. Grey runs are dominated: another run is no worse in any key figure, and better in "
    "at least one.",
    "Rules of motion, and values of the method and limits that differ from the defaults.",
)
_Role = Qt.ItemDataRole


@dataclass(frozen=True, eq=False)
class RunRow:
    """Row of the table.

    Parameters
    ----------
    record : RunRecord or None
        None for the mesh at the start.
    name, settings : str
        Name of the run, and its values that differ from the defaults.
    figures : mapping
        Values by the keys of `KEY_FIGURES`.
    colour : Role
    dominated_by : tuple of str
        Names of the rows that are as good in all figures, and better in one.
    running : bool
        True for the active run, whose figures are those of its newest iteration.
    """

    record: RunRecord | None
    name: str
    settings: str
    figures: dict[str, Any]
    colour: Role
    dominated_by: tuple[str, ...] = ()
    running: bool = False

    @property
    def help(self) -> str:
        """Sentence about the dominance of the row."""
        if self.dominated_by:
            return tr(
                "Dominated by {names}: no worse in any key figure, and better in at least one.",
                names=", ".join(self.dominated_by),
            )
        return tr("Every other result is worse in at least one key figure.")


class RunTable(RowModel):
    """Model of the table, with the mesh at the start first, then the runs, the oldest first."""

    def __init__(self, parent: QObject | None = None):
        super().__init__(FIRST + len(QUANTITIES), range(FIRST), parent)

    def fill(self, rows: Sequence[RunRow]) -> None:
        """Show rows."""
        self.set_rows(rows, [row.record for row in rows] == [row.record for row in self.rows])

    def range_of(self, key: str) -> tuple[float, float]:
        """Return the smallest and the largest value of a figure, without those of dominated runs."""
        values = [row.figures[key] for row in self.rows if row.record is None or not row.dominated_by]
        return min(values), max(values)

    def data(self, index: QModelIndex | QPersistentModelIndex, role: int = _Role.DisplayRole) -> Any:
        row, column = self.rows[index.row()], index.column()
        if role == _Role.DisplayRole:
            name = tr("{name} (active)", name=row.name) if row.running else row.name
            texts = name, row.settings, *(figure(row.figures[one.key]) for one in QUANTITIES)
            return texts[column]
        if role == _Role.TextAlignmentRole:
            return self.alignment(column)
        if role == _Role.ForegroundRole:
            return QBrush(QColor(str(self._colour(row, column))))
        if role == _Role.FontRole and column >= FIRST and self._is_best(row, QUANTITIES[column - FIRST].key):
            return bold(tabular(QFont()))
        if role == _Role.ToolTipRole:
            settings = f"<br>{escape(row.settings)}" if row.settings else ""
            return f"<qt><b>{escape(row.name)}</b>{settings}<br>{escape(row.help)}</qt>"
        if role == _Role.AccessibleTextRole and column == NAME and row.dominated_by:
            return tr("{name}, dominated", name=row.name)
        return None

    def _colour(self, row: RunRow, column: int) -> Role:
        key = QUANTITIES[column - FIRST].key if column >= FIRST else ""
        if key in ("inverted", "invalid") and row.figures[key]:
            return WORSE
        return MUTED if row.dominated_by or column == SETTINGS else TEXT

    def _is_best(self, row: RunRow, key: str) -> bool:
        low, high = self.range_of(key)
        return low < high and row.figures[key] == (high if SUMMARY_QUANTITIES[key].better > 0 else low)

    def title(self, column: int) -> str:
        """Return the title of a column."""
        return tr(QUANTITIES[column - FIRST].label) if column >= FIRST else (tr("Run"), tr("Settings"))[column]

    def help(self, column: int) -> str:
        """Return the help of a column."""
        return tr(QUANTITIES[column - FIRST].help) if column >= FIRST else tr(_HELP[column])
