"""Table of results: a row for the initial mesh, one for each method, and one for each run."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

from PySide6.QtCore import QModelIndex, QObject, QPersistentModelIndex, Qt, Signal
from PySide6.QtGui import QBrush, QColor, QFont

from hexmend.quality import REGRESSION_KEYS, SUMMARY_QUANTITIES
from hexmend.quantity import Quantity
from hexmend.report.comparison import KEPT_START, LINES, label
from hexmend.smoothers import METHODS
from hexmend_app.theme.palette import BETTER, MUTED, WORSE
from hexmend_app.theme.style import bold, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.tables.row_model import RowModel
from hexmend_app.widgets.wording import with_minus

METHOD, VIEW, _FIRST = 0, 1, 2

#: Keys of the columns.
KEYS = ("method", "view", *(quantity.key for quantity in LINES))

#: Name of the row of the initial mesh.
INITIAL = "initial"

#: Figures by which one result dominates another, and the largest difference by rounding alone.
_KEY_FIGURES = ("inverted", "invalid", "q_min", "q_mean", "scaled_jacobian_min")
_ROUNDING = 1e-12

#: Columns of texts, and help of the columns before those of the quantities.
_TEXTS = (METHOD, VIEW, KEYS.index("outcome"))
_HELP = (
    "Select the methods to run. Click a column header to sort. Grey results are dominated: another one is no worse in "
    "any key figure, and better in at least one.",
    "Select the results to show in views next to the current mesh.",
)
_Role, _Flag = Qt.ItemDataRole, Qt.ItemFlag
_CHECKS = {True: Qt.CheckState.Checked, False: Qt.CheckState.Unchecked}


@dataclass(frozen=True, eq=False)
class ComparisonRow:
    """Row of the table.

    Parameters
    ----------
    name : str
        Name of the method, `INITIAL`, or name of a run after "Run: ".
    help : str
        Tooltip of the row.
    record : mapping
        Values by the keys of `hexmend.report.comparison.LINES`, and "worse", the names of the regressions; empty
        without a result.
    has_mesh : bool
        There is a mesh to show or use.
    shown : bool
        The mesh is in a view.
    """

    name: str
    help: str
    record: Mapping[str, Any]
    has_mesh: bool = False
    shown: bool = False

    @property
    def is_method(self) -> bool:
        """True for a method, which can be selected to run."""
        return self.name in METHODS

    def dominates(self, other: ComparisonRow) -> bool:
        """Return True if this result is as good as another in all key figures, and better in at least one.

        >>> figures = {"inverted": 0, "invalid": 0, "q_min": 0.4, "q_mean": 0.89, "scaled_jacobian_min": 0.2}
        >>> a, b = ComparisonRow("a", "", figures), ComparisonRow("b", "", figures | {"inverted": 2})
        >>> a.dominates(b), b.dominates(a), a.dominates(a)
        (True, False, False)
        """
        pairs = [(key, self.record.get(key), other.record.get(key)) for key in _KEY_FIGURES]
        if any(own is None or its is None for _, own, its in pairs):
            return False
        gains = [SUMMARY_QUANTITIES[key].better * (own - its) for key, own, its in pairs]
        return min(gains) >= -_ROUNDING and max(gains) > _ROUNDING


def title_of(name: str) -> str:
    """Return the title of a row: the method's title, the name of a run, or `INITIAL`.

    >>> title_of("local-sd"), title_of(INITIAL)
    ('Local steepest descent', 'initial')
    """
    return tr(METHODS[name].title) if name in METHODS else tr(name)


def column_texts(entries: Sequence[ComparisonRow], quantity: Quantity) -> dict[str, str]:
    """Return the texts of a column by the names of the rows; "" without a result."""
    texts = {entry.name: with_minus(quantity.of(entry.record)) if entry.record else "" for entry in entries}
    if quantity.key == "outcome":
        kept = tr("initial mesh kept: no iteration was better")
        texts = {name: kept if text == KEPT_START else tr(text) for name, text in texts.items()}
    return texts


def best(entries: Sequence[ComparisonRow], quantity: Quantity, texts: Mapping[str, str]) -> set[str]:
    """Return the names of the methods with the best value; none if all values are equal or neither is better.

    Values whose texts of `column_texts` are equal are equal.

    >>> rows = [ComparisonRow(name, "", {"q_min": value}) for name, value in (("a", 0.1), ("b", 0.3), ("c", 0.30001))]
    >>> q_min = next(one for one in LINES if one.key == "q_min")
    >>> sorted(best(rows, q_min, column_texts(rows, q_min)))
    ['b', 'c']
    """
    sign = quantity.better
    values = {
        entry.name: sign * entry.record[quantity.key]
        for entry in entries
        if entry.name != INITIAL and entry.record.get(quantity.key) is not None
    }
    if not sign or len({texts[name] for name in values}) < 2:
        return set()
    highest = max(values, key=values.get)
    return {name for name in values if texts[name] == texts[highest]}


class ComparisonModel(RowModel):
    """Model of the table, the initial mesh always first, with check boxes for methods to run and meshes to show.

    Signals
    -------
    view_toggled(name, on)
        The user showed or hid the mesh of a row.
    ticked
        The selection of methods changed.
    """

    view_toggled = Signal(str, bool)
    ticked = Signal()

    def __init__(self, ticks: Sequence[str], parent: QObject | None = None):
        super().__init__(_FIRST + len(LINES), _TEXTS, parent)
        self.ticks = set(ticks)
        self.full = self.busy = False
        self._order = (METHOD, Qt.SortOrder.AscendingOrder)
        self._best: list[set[str]] = [set() for _ in LINES]
        self._texts: list[dict[str, str]] = [{} for _ in LINES]
        self._dominating: dict[str, list[str]] = {}  # titles of the rows that dominate a row

    def fill(self, entries: Sequence[ComparisonRow], full: bool, busy: bool) -> None:
        """Show rows; see `ComparePanel.set_entries` for the parameters."""
        entries = self._sorted(entries)
        self.full, self.busy = full, busy
        self._texts = [column_texts(entries, quantity) for quantity in LINES]
        self._best = [best(entries, quantity, texts) for quantity, texts in zip(LINES, self._texts, strict=True)]
        self._dominating = {
            one.name: [title_of(other.name) for other in entries if one.name != INITIAL and other.dominates(one)]
            for one in entries
        }
        self.set_rows(entries, [one.name for one in entries] == [one.name for one in self.rows])

    def sort(self, column: int, order: Qt.SortOrder = Qt.SortOrder.AscendingOrder) -> None:
        """Sort the rows by a column; rows without a value come last."""
        self._order = (column, order)
        self.layoutAboutToBeChanged.emit()
        before = [one.name for one in self.rows]
        self.rows = self._sorted(self.rows)
        now = [one.name for one in self.rows]
        for index in self.persistentIndexList():
            self.changePersistentIndex(index, self.index(now.index(before[index.row()]), index.column()))
        self.layoutChanged.emit()

    def _sorted(self, entries: Sequence[ComparisonRow]) -> list[ComparisonRow]:
        column, order = self._order
        first = [one for one in entries if one.name == INITIAL]
        methods = [one for one in entries if one.name != INITIAL]
        with_value = [one for one in methods if self._value(one, column) is not None]
        without_value = [one for one in methods if self._value(one, column) is None]
        with_value.sort(key=lambda one: self._value(one, column), reverse=order == Qt.SortOrder.DescendingOrder)
        return first + with_value + without_value

    def _value(self, entry: ComparisonRow, column: int) -> Any:
        if column == METHOD:  # methods with a result first
            return not entry.record, title_of(entry.name)
        return entry.shown if column == VIEW else entry.record.get(LINES[column - _FIRST].key)

    def tick(self, names: Iterable[str]) -> None:
        """Select these methods only."""
        self.ticks = set(names)
        if self.rows:
            self.dataChanged.emit(self.index(0, METHOD), self.index(len(self.rows) - 1, METHOD))
        self.ticked.emit()

    def flags(self, index: QModelIndex | QPersistentModelIndex) -> Qt.ItemFlag:
        entry, selectable = self.rows[index.row()], _Flag.ItemIsEnabled | _Flag.ItemIsSelectable
        if index.column() == METHOD and entry.is_method:
            return selectable | _Flag.ItemIsUserCheckable if not self.busy else selectable
        if index.column() == VIEW:
            can_toggle = entry.has_mesh and (entry.shown or not self.full)
            return selectable | _Flag.ItemIsUserCheckable if can_toggle else _Flag.ItemIsSelectable
        return selectable

    def data(self, index: QModelIndex | QPersistentModelIndex, role: int = _Role.DisplayRole) -> Any:
        entry, column = self.rows[index.row()], index.column()
        quantity = LINES[column - _FIRST] if column >= _FIRST else None
        if role == _Role.DisplayRole:
            if column == METHOD:
                return title_of(entry.name)
            return self._texts[column - _FIRST][entry.name] if quantity else ""
        if role == _Role.CheckStateRole:
            return self._check(entry, column)
        if role == _Role.TextAlignmentRole:
            return self.alignment(column)
        if role == _Role.ToolTipRole:
            if column == VIEW and entry.has_mesh and self.full and not entry.shown:
                return tr("Close a view first: at most four can be open.")
            dominating = self._dominating[entry.name]
            names = tr("<br>Dominated by {names}.", names=escape(", ".join(dominating))) if dominating else ""
            return f"<qt>{entry.help}{names}</qt>"
        if role == _Role.ForegroundRole and column == METHOD and self._dominating[entry.name]:
            return QBrush(QColor(str(MUTED)))
        if quantity is not None:
            return self._emphasis(entry, quantity, column - _FIRST, role)
        return None

    def _check(self, entry: ComparisonRow, column: int) -> Qt.CheckState | None:
        if column == METHOD and entry.is_method:
            return _CHECKS[entry.name in self.ticks]
        return _CHECKS[entry.shown] if column == VIEW and entry.has_mesh else None

    def _emphasis(self, entry: ComparisonRow, quantity: Quantity, at: int, role: int) -> Any:
        is_best, texts = entry.name in self._best[at], self._texts[at]
        if role == _Role.FontRole and is_best:
            return bold(tabular(QFont()))
        regressed = quantity.key in {REGRESSION_KEYS.get(name, name) for name in entry.record.get("worse", ())}
        regressed = regressed and texts[entry.name] != texts.get(INITIAL)
        if role == _Role.AccessibleTextRole and (is_best or regressed):
            return ", ".join([texts[entry.name], *[tr("best")] * is_best, *[tr("worse than initial")] * regressed])
        if role == _Role.ForegroundRole:
            bad = regressed or (quantity.key in ("inverted", "invalid") and entry.record.get(quantity.key))
            colour = WORSE if bad else BETTER if is_best else MUTED if self._dominating[entry.name] else None
            return colour and QBrush(QColor(str(colour)))
        return None

    def setData(self, index: QModelIndex | QPersistentModelIndex, value: Any, role: int = _Role.EditRole) -> bool:
        if role != _Role.CheckStateRole:
            return False
        on, name = Qt.CheckState(value) == Qt.CheckState.Checked, self.rows[index.row()].name
        if index.column() == VIEW:
            self.view_toggled.emit(name, on)
        else:
            (self.ticks.add if on else self.ticks.discard)(name)
            self.dataChanged.emit(index, index)
            self.ticked.emit()
        return True

    def title(self, column: int) -> str:
        """Return the title of a column."""
        if column < _FIRST:
            return (tr("Method or run"), tr("View"))[column]
        return tr(label(LINES[column - _FIRST], [one.record for one in self.rows]))

    def help(self, column: int) -> str:
        """Return the help of a column."""
        return tr(LINES[column - _FIRST].help if column >= _FIRST else _HELP[column])
