"""Row of the structure panel: one layer with its check box and legend."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QVBoxLayout, QWidget

from hexmend_app.theme.palette import MUTED, RIM, Role
from hexmend_app.theme.spacing import clear, fill
from hexmend_app.theme.style import set_help, smaller, tabular, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.eliding_label import ElidingLabel

#: Legend entry: colour (None without a mark), True for a line, and text.
Entry = tuple[str | Role | None, bool, str]


class LayerRow:
    """Check box and legend of a layer.

    Parameters
    ----------
    name, help : str
        Text of the check box, and its tooltip.
    reason : str
        Tooltip if the layer is empty.
    hidden_when_empty : bool
        True if the row is hidden while the layer is empty.

    Attributes
    ----------
    box : QCheckBox
    entries : QWidget
    """

    def __init__(self, name: str, help: str, reason: str, hidden_when_empty: bool = False):
        self._name, self._help, self._reason = name, help, reason
        self._hidden_when_empty = hidden_when_empty
        self._entries: list[Entry] | None = []
        self._error: BaseException | None = None
        self.box = QCheckBox(name)
        self.entries = QWidget()
        self._lines = fill(QVBoxLayout(self.entries), margins=(0, 4, 0, 0), spacing=4)

    def set_on(self, on: bool) -> None:
        """Check or uncheck the box."""
        self.box.setChecked(on)
        self._enable()

    def set_entries(self, entries: list[Entry] | None, error: BaseException | None = None) -> None:
        """Show the legend; None while it is unknown, with the error if finding it failed."""
        self._entries, self._error = entries, error
        clear(self._lines)
        text = tr("failed") if error is not None else tr("counting…") if entries is None else tr("none")
        for entry in entries or [(None, False, text)]:
            self._lines.addWidget(_entry(*entry))
        self._enable()

    def _enable(self) -> None:
        # A layer that is on before its contents are known is drawn once they are.
        offered = bool(self._entries) or (self._entries is None and self._error is None)
        # A layer that is on can be switched off.
        self.box.setEnabled(offered or (self.box.isChecked() and not self._hidden_when_empty))
        if self._hidden_when_empty:
            self.box.setVisible(offered)
            self.entries.setVisible(offered)
        reason = self._reason
        if self._error is not None:
            reason = tr("Not counted: {error}.", error=str(self._error).rstrip("."))
        set_help(self.box, self._name, self._help if offered else reason)


class _Mark(QWidget):
    """Mark of a line or point: a coloured rectangle with a rim, as in the view."""

    def __init__(self, colour: str | Role, line: bool, parent: QWidget | None = None):
        super().__init__(parent)
        self._colour = colour
        self.setFixedSize(QSize(11, 7) if line else QSize(9, 9))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the rectangle and its rim."""
        painter = QPainter(self)
        painter.setPen(QColor(str(RIM)))
        painter.setBrush(QColor(str(self._colour)))
        painter.drawRect(QRectF(0.5, 0.5, self.width() - 1, self.height() - 1))


def _entry(colour: str | Role | None, line: bool, text: str) -> QWidget:
    entry, label = QWidget(), ElidingLabel(text)
    label.setFont(tabular(smaller(label.font())))
    label.setToolTip(text)
    tint(label, MUTED)
    marks = [] if colour is None else [_Mark(colour, line)]
    fill(QHBoxLayout(entry), *marks, (label, 1), margins=(0, 0, 0, 0), spacing=4)
    return entry
