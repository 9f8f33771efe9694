"""The rows of a comparison: the mesh as it was, and each method with its figures once they are known."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, Qt, Signal
from PySide6.QtGui import QBrush, QColor, QFont

from hexmend.quality import REGRESSION_KEYS
from hexmend.quantity import Quantity
from hexmend.report.comparison import LINES, label
from hexmend.smoothers import METHODS
from hexmend_app.theme.style import BETTER, MUTED, WORSE, tabular

METHOD, VIEW, _FIRST = 0, 1, 2

#: What columns are known by.
KEYS = ("method", "view", *(figure.key for figure in LINES))

#: What the row of the mesh as it was is called.
INITIAL = "initial"

_RIGHT = int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
_LEFT = int(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
_Role, _Flag = Qt.ItemDataRole, Qt.ItemFlag
_CHECKS = {True: Qt.CheckState.Checked, False: Qt.CheckState.Unchecked}


@dataclass(frozen=True, eq=False)
class ComparisonRow:
    """A row.

    Parameters
    ----------
    name : str
        Of the method, or `INITIAL`.
    help : str
        What the row's tooltip says.
    record : mapping
        The figures, by the keys of `hexmend.report.comparison.LINES`, and "worse", names of those that are worse than
        the initial mesh's; empty while there are none.
    has_mesh : bool
        Whether there is a mesh to be shown or taken.
    shown : bool
        Whether it is in a view.
    """

    name: str
    help: str
    record: Mapping[str, Any]
    has_mesh: bool = False
    shown: bool = False


def title_of(name: str) -> str:
    """Return the title of a row: the method's title, or `INITIAL`.

    >>> title_of("local-sd"), title_of(INITIAL)
    ('Local steepest descent', 'initial')
    """
    return METHODS[name].title if name in METHODS else name


def best(entries: Sequence[ComparisonRow], figure: Quantity) -> set[str]:
    """Names of the methods whose figure is the best; none where there is nothing to choose.

    >>> rows = [ComparisonRow("a", "", {"q_min": 0.1}), ComparisonRow("b", "", {"q_min": 0.3}), ComparisonRow("c", "", {})]
    >>> best(rows, next(one for one in LINES if one.key == "q_min"))
    {'b'}
    """
    sense = figure.better
    known = {
        one.name: sense * one.record[figure.key]
        for one in entries
        if one.name != INITIAL and one.record.get(figure.key) is not None
    }
    if not sense or len(set(known.values())) < 2:
        return set()
    most = max(known.values())
    return {name for name, value in known.items() if value == most}


class ComparisonModel(QAbstractTableModel):
    """Rows that can be sorted, the mesh as it was always first; checks for what is to run and what is in a view.

    Signals
    -------
    view_toggled(name, on)
        The user wants a row's mesh in a view, or out of it.
    ticked
        Other methods are to run.
    """

    view_toggled = Signal(str, bool)
    ticked = Signal()

    def __init__(self, ticks: Sequence[str], parent: QObject | None = None):
        super().__init__(parent)
        self.entries: list[ComparisonRow] = []
        self.ticks = set(ticks)
        self.full = self.busy = False
        self._order = (METHOD, Qt.SortOrder.AscendingOrder)
        self._best: list[set[str]] = [set() for _ in LINES]

    def fill(self, entries: Sequence[ComparisonRow], full: bool, busy: bool) -> None:
        """Take rows, whether there is no room for another view, and whether methods are at work."""
        entries = self._sorted(entries)
        same = [one.name for one in entries] == [one.name for one in self.entries]
        if not same:
            self.beginResetModel()
        self.entries, self.full, self.busy = entries, full, busy
        self._best = [best(entries, figure) for figure in LINES]
        if same:  # the view keeps what is chosen, and where it is scrolled to
            self.dataChanged.emit(self.index(0, 0), self.index(len(entries) - 1, self.columnCount() - 1))
        else:
            self.endResetModel()

    def sort(self, column: int, order: Qt.SortOrder = Qt.SortOrder.AscendingOrder) -> None:
        """Order the rows by a column; what has no figure comes last."""
        self._order = (column, order)
        self.layoutAboutToBeChanged.emit()
        before = [one.name for one in self.entries]
        self.entries = self._sorted(self.entries)
        now = [one.name for one in self.entries]
        for index in self.persistentIndexList():
            self.changePersistentIndex(index, self.index(now.index(before[index.row()]), index.column()))
        self.layoutChanged.emit()

    def _sorted(self, entries: Sequence[ComparisonRow]) -> list[ComparisonRow]:
        column, order = self._order
        first = [one for one in entries if one.name == INITIAL]
        known, without = [], []
        for one in entries:
            if one.name != INITIAL:
                (known if self._value(one, column) is not None else without).append(one)
        known.sort(key=lambda one: self._value(one, column), reverse=order == Qt.SortOrder.DescendingOrder)
        return first + known + without

    def _value(self, entry: ComparisonRow, column: int) -> Any:
        if column == METHOD:  # those that have run first
            return not entry.record, title_of(entry.name)
        return entry.shown if column == VIEW else entry.record.get(LINES[column - _FIRST].key)

    def tick(self, names: Iterable[str]) -> None:
        """Have these methods run, and no others."""
        self.ticks = set(names)
        if self.entries:
            self.dataChanged.emit(self.index(0, METHOD), self.index(len(self.entries) - 1, METHOD))
        self.ticked.emit()

    def rowCount(self, parent: QModelIndex | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(self.entries)

    def columnCount(self, parent: QModelIndex | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else _FIRST + len(LINES)

    def flags(self, index: QModelIndex) -> Qt.ItemFlag:
        entry, simple = self.entries[index.row()], _Flag.ItemIsEnabled | _Flag.ItemIsSelectable
        if index.column() == METHOD and entry.name != INITIAL:
            return simple | _Flag.ItemIsUserCheckable if not self.busy else simple
        if index.column() == VIEW:
            free = entry.has_mesh and (entry.shown or not self.full)
            return simple | _Flag.ItemIsUserCheckable if free else _Flag.ItemIsSelectable
        return simple

    def data(self, index: QModelIndex, role: int = _Role.DisplayRole) -> Any:
        entry, column = self.entries[index.row()], index.column()
        figure = LINES[column - _FIRST] if column >= _FIRST else None
        if role == _Role.DisplayRole:
            return (
                title_of(entry.name) if column == METHOD else figure.of(entry.record) if figure and entry.record else ""
            )
        if role == _Role.CheckStateRole:
            return self._check(entry, column)
        if role == _Role.TextAlignmentRole:
            return _RIGHT if figure and figure.key != "outcome" else _LEFT
        if role == _Role.ToolTipRole:
            if column == VIEW and entry.has_mesh and self.full and not entry.shown:
                return "Close a view first: there is room for four."
            return f"<qt>{entry.help}</qt>"
        if figure is not None:
            return self._emphasis(entry, figure, entry.name in self._best[column - _FIRST], role)
        return None

    def _check(self, entry: ComparisonRow, column: int) -> Qt.CheckState | None:
        if column == METHOD and entry.name != INITIAL:
            return _CHECKS[entry.name in self.ticks]
        return _CHECKS[entry.shown] if column == VIEW and entry.has_mesh else None

    def _emphasis(self, entry: ComparisonRow, figure: Quantity, is_best: bool, role: int) -> Any:
        if role == _Role.FontRole and is_best:
            font = tabular(QFont())
            font.setBold(True)
            return font
        fallen = figure.key in {REGRESSION_KEYS[name] for name in entry.record.get("worse", ())}
        if role == _Role.AccessibleTextRole and (is_best or fallen):
            words = [figure.of(entry.record), *["best"] * is_best, *["worse than initial"] * fallen]
            return ", ".join(words)
        if role == _Role.ForegroundRole:
            wrong = fallen or (figure.key == "inverted" and entry.record.get("inverted"))
            colour = WORSE if wrong else BETTER if is_best else None
            return colour and QBrush(QColor(str(colour)))
        return None

    def setData(self, index: QModelIndex, value: Any, role: int = _Role.EditRole) -> bool:
        if role != _Role.CheckStateRole:
            return False
        on, name = Qt.CheckState(value) == Qt.CheckState.Checked, self.entries[index.row()].name
        if index.column() == VIEW:
            self.view_toggled.emit(name, on)
        else:
            (self.ticks.add if on else self.ticks.discard)(name)
            self.dataChanged.emit(index, index)
            self.ticked.emit()
        return True

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = _Role.DisplayRole) -> Any:
        if orientation != Qt.Orientation.Horizontal:
            return None
        figure = LINES[section - _FIRST] if section >= _FIRST else None
        if role == _Role.DisplayRole:
            return label(figure, [one.record for one in self.entries]) if figure else ("Method", "View")[section]
        if role == _Role.TextAlignmentRole:
            return _RIGHT if figure and figure.key != "outcome" else _LEFT
        if role == _Role.ForegroundRole:
            return QBrush(QColor(str(MUTED)))
        if role == _Role.ToolTipRole:
            words = figure.help if figure else (
                "What is ticked runs. A click on a column's head sorts by it.",
                "Selected results are shown in views next to the present mesh.",
            )[section]  # fmt: skip
            return f"<qt>{words}</qt>"
        return None
