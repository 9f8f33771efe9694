"""Table of quality statistics, at the start and now."""

from __future__ import annotations

import math
from typing import Any

from PySide6.QtCore import QPoint, QSize, Qt, Signal
from PySide6.QtGui import QAction, QBrush, QColor, QGuiApplication, QKeyEvent, QKeySequence, QMouseEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QFrame,
    QHeaderView,
    QMenu,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from hexmend.quality import REGRESSION_KEYS, SUMMARY_QUANTITIES, regressions
from hexmend.quantity import Quantity
from hexmend_app.theme.palette import BETTER, MUTED, TEXT, WORSE
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import icon, on_theme_change, set_variant, smaller, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import figure

#: Quantities with a row; the quality of the best hex tells nothing about a mesh.
ROWS = tuple(quantity for quantity in SUMMARY_QUANTITIES.values() if quantity.key != "q_max")
_COLUMNS = ("", "start", "now", "change")
_START, _NOW, _CHANGE = 1, 2, 3

#: Horizontal padding of a cell, in pixels.
_PADDING = 10


#: Rows whose present number is a link to the hexes that it counts, and the names of these groups of hexes.
LINKS = {"inverted": "inverted", "locked_inverted": "locked", "invalid": "invalid"}


def _title(row: Quantity) -> str:
    return f"– {tr(row.label)}" if row.part_of else tr(row.title)


def _cell_text(value: float | None) -> str:
    """Write a figure in at most seven characters, the width of a column; longer only for integers.

    >>> _cell_text(1559.3478), _cell_text(32735), _cell_text(0.4035)
    ('1559.35', '32,735', '0.4035')
    """
    text = figure(value)
    return text if len(text) <= 7 or isinstance(value, int) else f"{value:.6g}".replace("-", "−")


def change(row: Quantity, start: float | None, now: float | None) -> tuple[str, int]:
    """Return the text of a change, and 1 if it is an improvement, -1 if it is a regression, else 0.

    >>> change(ROWS[3], 36, 0)
    ('▼ 36', 1)
    """
    if start is None or now is None:
        if start is now:
            return "", 0
        return (tr("finite"), 1) if start is None else (tr("infinite"), -1)
    difference = now - start
    if difference == 0 or not math.isfinite(difference):
        return "=", 0
    size = figure(abs(difference))
    if isinstance(difference, float) and abs(difference) < 0.5e-4:
        size = "<0.0001"
    return f"{'▲' if difference > 0 else '▼'} {size}", row.better * (1 if difference > 0 else -1)


class StatisticsTable(QWidget):
    """Table of quality figures at the start and now, and their change; Ctrl+C copies it for a spreadsheet.

    Signals
    -------
    isolate_requested(str)
        The user clicked the number of "inverted", "locked" or "invalid" hexes, or pressed Enter in its row.
    """

    isolate_requested = Signal(str)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._summaries: tuple[Any, Any] = (None, None)
        self._measured_width = ("", 0)  # key of the font, and width of the longest title in it
        self._table = table = LinkTable(len(ROWS), len(_COLUMNS))
        table.link_activated.connect(self.isolate_requested)
        table.setHorizontalHeaderLabels([tr(text) if text else "" for text in _COLUMNS])
        table.setAccessibleName(tr("Statistics of the mesh"))
        table.setFont(tabular(smaller(table.font())))
        table.setShowGrid(False)
        table.setFrameShape(QFrame.Shape.NoFrame)
        set_variant(table, "panel")
        table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        table.setTabKeyNavigation(False)  # Tab leaves the table; arrow keys move in it
        table.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        table.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        table.customContextMenuRequested.connect(self._open_menu)
        table.verticalHeader().hide()
        table.verticalHeader().setDefaultSectionSize(table.fontMetrics().height() + 5)
        self._fill()
        self._shape_columns()
        on_theme_change(self, self._paint)
        self._copy = QAction(icon("content-copy"), tr("Copy table"), self)
        self._copy.setShortcut(QKeySequence.StandardKey.Copy)
        self._copy.setShortcutContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
        self._copy.triggered.connect(self.copy)
        self.addAction(self._copy)
        fill(QVBoxLayout(self), table, None, margins=(4, 4, 4, 4))
        height = table.horizontalHeader().sizeHint().height() + table.verticalHeader().length() + 2
        table.setFixedHeight(height)
        table.setMinimumWidth(self._title_width() + self._figures_width() - 56)  # the longest titles may be elided

    def _paint(self) -> None:
        for column in range(len(_COLUMNS)):
            self._table.horizontalHeaderItem(column).setForeground(QBrush(QColor(str(MUTED))))
        self.set_summaries(*self._summaries)

    def _fill(self) -> None:
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        for number, row in enumerate(ROWS):
            for column in range(len(_COLUMNS)):
                item = QTableWidgetItem(_title(row) if column == 0 else "")
                item.setToolTip(_help(row))
                if column:
                    item.setTextAlignment(right)
                self._table.setItem(number, column, item)
        for column in range(len(_COLUMNS)):
            head = self._table.horizontalHeaderItem(column)
            head.setTextAlignment(right if column else Qt.AlignmentFlag.AlignLeft)

    def _shape_columns(self) -> None:
        header = self._table.horizontalHeader()
        set_variant(header, "lined")
        header.setHighlightSections(False)
        header.setSectionsClickable(False)
        header.setMinimumSectionSize(20)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        # Fixed widths: the columns stay in place when figures change.
        for column in (_START, _NOW, _CHANGE):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.Fixed)
            widest = ("infinite", "▼ 0.0000", _COLUMNS[column]) if column == _CHANGE else ("000,000",)
            width = max(map(self._table.fontMetrics().horizontalAdvance, widest))
            header.resizeSection(column, width + _PADDING)

    def set_summaries(self, start: Any, now: Any) -> None:
        """Show two summaries of `hexmend.quality.summarise`; None for both clears the table."""
        self._summaries = (start, now)
        both = start is not None and now is not None
        worse = {REGRESSION_KEYS[name] for name in regressions(start, now)} if both else set()
        for number, row in enumerate(ROWS):
            before, after = self._values(row)
            text, sense = change(row, before, after) if both else ("", 0)
            self._table.item(number, _START).setText(_cell_text(before) if start is not None else "")
            self._table.item(number, _NOW).setText(_cell_text(after) if now is not None else "")
            item = self._table.item(number, _CHANGE)
            item.setText(text)
            font = item.font()
            font.setBold(row.key in worse)
            item.setFont(font)
            item.setForeground(QBrush(QColor(str({1: BETTER, -1: WORSE, 0: MUTED}[sense]))))
            word = {1: "better", -1: "worse", 0: ""}[sense]
            item.setData(Qt.ItemDataRole.AccessibleTextRole, f"{text} {word}".strip())
        self._mark_links(now)

    def _values(self, row: Quantity) -> list[Any]:
        return [None if summary is None else getattr(summary, row.key) for summary in self._summaries]

    def _mark_links(self, now: Any) -> None:
        """Mark positive numbers of inverted, locked and invalid hexes as links, in the colour of bad figures."""
        for number, row in enumerate(ROWS):
            if row.key in LINKS:
                linked = now is not None and getattr(now, row.key) > 0
                item = self._table.item(number, _NOW)
                font = item.font()
                font.setBold(linked and not row.part_of)
                font.setUnderline(linked)
                item.setFont(font)
                item.setForeground(QBrush(QColor(str(WORSE if linked else TEXT))))
                kind = LINKS[row.key]
                help = tr(
                    "Show only the {kind} hexes: click, or press Enter in this row. Esc shows all hexes again.",
                    kind=tr(kind),
                )
                item.setToolTip(f"<qt>{help}</qt>" if linked else _help(row))
                self._table.set_link(number, _NOW, kind if linked else None)

    def text(self) -> str:
        """Return the table as tab-separated text with a title line, in full precision; infinite figures are empty."""
        lines = ["figure\tstart\tnow"]
        for row in ROWS:
            lines.append("\t".join([row.title, *("" if value is None else str(value) for value in self._values(row))]))
        return "\n".join(lines) + "\n"

    def copy(self) -> None:
        """Copy the table to the clipboard."""
        QGuiApplication.clipboard().setText(self.text())

    def _open_menu(self, position: QPoint) -> None:
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.addAction(self._copy)
        menu.popup(self._table.viewport().mapToGlobal(position))

    def sizeHint(self) -> QSize:
        """Return the size at which all rows and the longest title are visible."""
        margins = self.layout().contentsMargins()
        size = QSize(self._title_width() + self._figures_width(), self._table.height())
        return size.grownBy(margins)

    def _title_width(self) -> int:
        """Return the width of the longest title in pixels; measured once, as Qt asks for it many times a frame."""
        font = self._table.font().key()
        if font != self._measured_width[0]:
            self._measured_width = font, max(map(self._table.fontMetrics().horizontalAdvance, map(_title, ROWS))) + 9
        return self._measured_width[1]

    def _figures_width(self) -> int:
        return sum(self._table.columnWidth(column) for column in (_START, _NOW, _CHANGE))


def _help(row: Quantity) -> str:
    return f"<qt><b>{tr(row.title)}</b><br>{tr(row.help)}</qt>"


class LinkTable(QTableWidget):
    """Table in which a link is followed by a click on its cell, or by Enter in its row.

    Signals
    -------
    link_activated(str)
        The user followed this link.
    """

    link_activated = Signal(str)

    def __init__(self, rows: int, columns: int, parent: QWidget | None = None):
        super().__init__(rows, columns, parent)
        self._links: dict[tuple[int, int], str] = {}
        self.setMouseTracking(True)
        self.cellClicked.connect(lambda row, column: self._follow(self._links.get((row, column))))

    def set_link(self, row: int, column: int, link: str | None) -> None:
        """Make a cell a link; None removes its link."""
        if link is None:
            self._links.pop((row, column), None)
        else:
            self._links[row, column] = link

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Follow the link of the row by Enter."""
        row = self.currentRow()
        link = next((link for (at, _), link in self._links.items() if at == row), None)
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and link is not None:
            self._follow(link)
        else:
            super().keyPressEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Show a pointing hand over links."""
        index = self.indexAt(event.position().toPoint())
        over = (index.row(), index.column()) in self._links
        self.viewport().setCursor(Qt.CursorShape.PointingHandCursor if over else Qt.CursorShape.ArrowCursor)
        super().mouseMoveEvent(event)

    def _follow(self, link: str | None) -> None:
        if link is not None:
            self.link_activated.emit(link)
