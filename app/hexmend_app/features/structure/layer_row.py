"""Row of the structure panel: one layer with its check box and legend."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QCheckBox, QGridLayout, QHBoxLayout, QWidget

from hexmend_app.theme.palette import RIM, Role
from hexmend_app.theme.style import note, set_help, tabular

_NOT_YET = "Being counted."
#: What is said where it could not be found out what there is.
_FAILED = "could not be worked out"
_COLUMNS = 2

#: Letters up to which texts stand beside each other: two more and they are cut off in a narrow column.
_WIDEST = 6

#: What one mark of a layer stands for: its colour, or None for a remark without a mark, whether it is a line, and the
#: text beside it.
Entry = tuple[str | Role | None, bool, str]


class LayerRow:
    """Check box of one layer with a legend.

    Parameters
    ----------
    name, help : str
        Text of the check box, and its tooltip.
    reason : str
        Tooltip if the layer is empty.
    at_once : bool
        True if the layer can be selected before its contents are known.
    unless : bool
        True if the layer is on by default; an empty layer is hidden.

    Attributes
    ----------
    box : QCheckBox
    entries : QWidget
    """

    def __init__(self, name: str, help: str, reason: str, at_once: bool = False, unless: bool = False):
        self._name, self._help, self._reason, self._at_once = name, help, reason, at_once
        self._unless = unless
        self._known: list[Entry] | None = []
        self._error: BaseException | None = None
        self.box = QCheckBox(name)
        self.entries = QWidget()
        self._grid = QGridLayout(self.entries)
        self._grid.setContentsMargins(0, 2, 0, 0)
        self._grid.setHorizontalSpacing(4)
        self._grid.setVerticalSpacing(3)
        for column in range(_COLUMNS):
            self._grid.setColumnStretch(column, 1)

    def set_on(self, on: bool) -> None:
        """Show whether it is drawn."""
        self.box.setChecked(on)
        self._enable()

    def set_entries(self, entries: list[Entry] | None, error: BaseException | None = None) -> None:
        """Show the legend; None while unknown, with the error if finding it failed."""
        self._known, self._error = entries, error
        while self._grid.count():
            old = self._grid.takeAt(0).widget()
            old.hide()
            old.deleteLater()
        if not entries:
            sentence = _FAILED if error is not None else "counting…" if entries is None else "none"
            self._grid.addWidget(_text(sentence), 0, 0, 1, _COLUMNS)
        neighbour = _COLUMNS if len(entries or ()) > 1 and max(len(text) for *_, text in entries) <= _WIDEST else 1
        for at, entry in enumerate(entries or ()):
            self._grid.addWidget(_entry(*entry), at // neighbour, at % neighbour, 1, _COLUMNS // neighbour)
        self._enable()

    def _enable(self) -> None:
        failed = self._error is not None
        waits = self._known is None and not self._at_once
        there = bool(self._known) or (self._known is None and self._at_once and not failed)
        self.box.setEnabled(there or (self.box.isChecked() and not self._unless))  # what is on can be switched off
        if self._unless:
            self.box.setVisible(there)
            self.entries.setVisible(there)
        reason = f"This could not be worked out: {self._error}." if failed else _NOT_YET if waits else self._reason
        set_help(self.box, self._name, self._help if there else reason)


class _Mark(QWidget):
    """Line or point as the view draws it: a colour with a rim."""

    def __init__(self, colour: str | Role, line: bool, parent: QWidget | None = None):
        super().__init__(parent)
        self._colour = colour
        self.setFixedSize(QSize(11, 7) if line else QSize(9, 9))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Fill the rim."""
        painter = QPainter(self)
        painter.setPen(QColor(str(RIM)))
        painter.setBrush(QColor(str(self._colour)))
        painter.drawRect(QRectF(0.5, 0.5, self.width() - 1, self.height() - 1))


def _entry(colour: str | Role | None, line: bool, text: str) -> QWidget:
    entry = QWidget()
    layout = QHBoxLayout(entry)
    layout.setContentsMargins(0, 0, 0, 0)
    layout.setSpacing(4)
    if colour is not None:
        layout.addWidget(_Mark(colour, line))
    layout.addWidget(_text(text), 1)
    return entry


def _text(text: str) -> QWidget:
    label = note(text)
    label.setFont(tabular(label.font()))
    label.setWordWrap(False)
    return label
