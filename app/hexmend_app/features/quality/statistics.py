"""The table of a mesh's figures, at the start and now."""

from __future__ import annotations

import math
from typing import Any

from PySide6.QtCore import QPoint, QSize, Qt, Signal
from PySide6.QtGui import QAction, QBrush, QColor, QGuiApplication, QKeySequence, QPalette
from PySide6.QtWidgets import (
    QAbstractItemView,
    QFrame,
    QHeaderView,
    QMenu,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from hexmend.quality import REGRESSION_KEYS, SUMMARY_QUANTITIES, regressions
from hexmend.quantity import Quantity
from hexmend_app.theme.style import BETTER, LINE, MUTED, PANEL, TEXT, WORSE, icon, on_theme_change, smaller, tabular
from hexmend_app.widgets.tables.link_table import LinkTable
from hexmend_app.widgets.wording import figure

#: What has a row: all but the quality of the best element, which says nothing.
ROWS = tuple(one for one in SUMMARY_QUANTITIES.values() if one.key != "q_max")
_COLUMNS = ("", "start", "now", "change")
_START, _NOW, _CHANGE = 1, 2, 3

#: Pixels that a cell keeps free beside its text.
_AROUND = 10


def _name(row: Quantity) -> str:
    return f"– {row.label}" if row.part_of else row.title


def _cell(value: float | None) -> str:
    """A figure in seven letters, which is what a column has room for.

    >>> _cell(1559.3478), _cell(32735), _cell(0.4035)
    ('1559.35', '32,735', '0.4035')
    """
    text = figure(value)
    return text if len(text) <= 7 or isinstance(value, int) else f"{value:.6g}".replace("-", "−")


def change(row: Quantity, start: float | None, now: float | None) -> tuple[str, int]:
    """Text of a change and whether it is for the better (1), for the worse (-1) or neither (0).

    >>> change(ROWS[3], 36, 0)
    ('▼ 36', 1)
    """
    if start is None or now is None:
        if start is now:
            return "", 0
        return ("finite", 1) if start is None else ("infinite", -1)
    moved = now - start
    if moved == 0 or not math.isfinite(moved):
        return "=", 0
    size = figure(abs(moved))
    if isinstance(moved, float) and abs(moved) < 0.5e-4:
        size = "<0.0001"
    return f"{'▲' if moved > 0 else '▼'} {size}", row.better * (1 if moved > 0 else -1)


#: Rows whose number now is a link to the elements that it counts, and what those are called.
LINKS = {"inverted": "inverted", "locked_inverted": "locked"}


class StatisticsTable(QWidget):
    """Figures at the start and now, and how they changed; Ctrl+C copies them for a spreadsheet.

    Signals
    -------
    isolate_requested(str)
        The user clicked on the number of "inverted" or "locked" elements, or pressed Enter in its row.
    """

    isolate_requested = Signal(str)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._summaries: tuple[Any, Any] = (None, None)
        self._measured = ("", 0)  # for which font, and what
        self._table = table = LinkTable(len(ROWS), len(_COLUMNS))
        table.link_activated.connect(self.isolate_requested)
        table.setHorizontalHeaderLabels(_COLUMNS)
        table.setAccessibleName("Statistics of the mesh")
        table.setFont(tabular(smaller(table.font())))
        table.setShowGrid(False)
        table.setFrameShape(QFrame.Shape.NoFrame)
        table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        table.setTabKeyNavigation(False)  # Tab leaves the table; arrow keys walk in it
        table.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        table.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        table.customContextMenuRequested.connect(self._open_menu)
        table.verticalHeader().hide()
        table.verticalHeader().setDefaultSectionSize(table.fontMetrics().height() + 5)
        self._fill()
        self._shape_columns()
        on_theme_change(self, self._paint)
        self._copy = QAction(icon("content-copy"), "Copy table", self)
        self._copy.setShortcut(QKeySequence.StandardKey.Copy)
        self._copy.setShortcutContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
        self._copy.triggered.connect(self.copy)
        self.addAction(self._copy)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(2, 4, 2, 4)
        layout.addWidget(table)
        layout.addStretch()
        height = table.horizontalHeader().sizeHint().height() + table.verticalHeader().length() + 2
        table.setFixedHeight(height)
        table.setMinimumWidth(self._title_width() + self._figures_width() - 32)  # the longest titles may end in …

    def _paint(self) -> None:
        palette = QPalette()
        palette.setColor(QPalette.ColorRole.Base, QColor(str(PANEL)))
        self._table.setPalette(palette)
        self._table.horizontalHeader().setStyleSheet(
            f"QHeaderView::section {{ background: {PANEL}; padding: 2px 4px;"
            f" border: none; border-bottom: 1px solid {LINE}; }}"
        )
        for column in range(len(_COLUMNS)):
            self._table.horizontalHeaderItem(column).setForeground(QBrush(QColor(str(MUTED))))
        self.set_summaries(*self._summaries)

    def _fill(self) -> None:
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        for at, row in enumerate(ROWS):
            for column in range(len(_COLUMNS)):
                item = QTableWidgetItem(_name(row) if column == 0 else "")
                item.setToolTip(_help(row))
                if column:
                    item.setTextAlignment(right)
                self._table.setItem(at, column, item)
        for column in range(len(_COLUMNS)):
            head = self._table.horizontalHeaderItem(column)
            head.setTextAlignment(right if column else Qt.AlignmentFlag.AlignLeft)

    def _shape_columns(self) -> None:
        header = self._table.horizontalHeader()
        header.setHighlightSections(False)
        header.setSectionsClickable(False)
        header.setMinimumSectionSize(20)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        # Widths that hold still while figures change.
        for column in (_START, _NOW, _CHANGE):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.Fixed)
            widest = ("infinite", "▼ 0.0000", _COLUMNS[column]) if column == _CHANGE else ("000,000",)
            letters = max(map(self._table.fontMetrics().horizontalAdvance, widest))
            header.resizeSection(column, letters + _AROUND)

    def set_summaries(self, start: Any, now: Any) -> None:
        """Take two summaries, as `hexmend.quality.summarise` gives them; None for both clears the table."""
        self._summaries = (start, now)
        fallen = (
            {REGRESSION_KEYS[name] for name in regressions(start, now)}
            if start is not None and now is not None
            else set()
        )
        for at, row in enumerate(ROWS):
            was, is_ = (None if summary is None else getattr(summary, row.key) for summary in (start, now))
            shown = start is not None and now is not None
            text, sense = change(row, was, is_) if shown else ("", 0)
            self._table.item(at, _START).setText(_cell(was) if start is not None else "")
            self._table.item(at, _NOW).setText(_cell(is_) if now is not None else "")
            item = self._table.item(at, _CHANGE)
            item.setText(text)
            font = item.font()
            font.setBold(row.key in fallen)
            item.setFont(font)
            item.setForeground(QBrush(QColor(str({1: BETTER, -1: WORSE, 0: MUTED}[sense]))))
            word = {1: "better", -1: "worse", 0: ""}[sense]
            item.setData(Qt.ItemDataRole.AccessibleTextRole, f"{text} {word}".strip())
        self._mark_links(now)

    def _mark_links(self, now: Any) -> None:
        """Let the numbers of inverted elements look like what they are: bad news, and links."""
        for at, row in enumerate(ROWS):
            if row.key in LINKS:
                there = now is not None and getattr(now, row.key) > 0
                item = self._table.item(at, _NOW)
                font = item.font()
                font.setBold(there and row.key == "inverted")
                font.setUnderline(there)
                item.setFont(font)
                item.setForeground(QBrush(QColor(str(WORSE if there else TEXT))))
                kind = LINKS[row.key]
                item.setToolTip(
                    f"<qt>Show only the {kind} hexes: click, or press Enter in this row. Esc brings back the rest.</qt>"
                    if there
                    else _help(row)
                )
                self._table.set_link(at, _NOW, kind if there else None)

    def text(self) -> str:
        """The table as tab-separated text with full precision and a line of titles; an infinite figure is empty."""
        lines = ["figure\tstart\tnow"]
        for row in ROWS:
            cells = (None if summary is None else getattr(summary, row.key) for summary in self._summaries)
            lines.append("\t".join([row.title, *("" if c is None else str(c) for c in cells)]))
        return "\n".join(lines) + "\n"

    def copy(self) -> None:
        """Copy the table to the clipboard."""
        QGuiApplication.clipboard().setText(self.text())

    def _open_menu(self, at: QPoint) -> None:
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.addAction(self._copy)
        menu.popup(self._table.viewport().mapToGlobal(at))

    def sizeHint(self) -> QSize:
        """All rows and the longest title, without scrolling."""
        margins = self.layout().contentsMargins()
        size = QSize(self._title_width() + self._figures_width(), self._table.height())
        return size.grownBy(margins)

    def _title_width(self) -> int:
        """Of the longest title; Qt asks for it many times a frame."""
        font = self._table.font().key()
        if font != self._measured[0]:
            self._measured = font, max(map(self._table.fontMetrics().horizontalAdvance, map(_name, ROWS))) + 9
        return self._measured[1]

    def _figures_width(self) -> int:
        return sum(self._table.columnWidth(column) for column in (_START, _NOW, _CHANGE))


def _help(row: Quantity) -> str:
    return f"<qt><b>{row.title}</b><br>{row.help}</qt>"
