"""Row of controls below the histogram, for the ends of the range."""

from __future__ import annotations

import math
from dataclasses import replace

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QLineEdit, QToolButton, QWidget

from hexmend.quality import METRICS
from hexmend_app.picture.visibility import Show
from hexmend_app.report.distribution import Axis
from hexmend_app.theme.palette import INVERTED
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import narrow, push_button, set_help, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.legend import swatch_icon
from hexmend_app.widgets.metric_texts import in_sentence

_INVERTED = "Show inverted hexes as well, of any value; they have a separate column left of the bins."

#: Width of the fields in pixels. It does not depend on the metric, so that the width of the column of panels does not
#: either.
_WIDTH = 68


class RangeRow(QWidget):
    """Fields for the lowest and highest value that is shown, and a button for inverted hexes.

    Signals
    -------
    chosen(Show or None)
        The user changed an end of the range, showed or hid inverted hexes, or chose all hexes (None).
    """

    chosen = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._axis, self._range = Axis("q"), Show()
        self.low, self.high = QLineEdit(), QLineEdit()
        self.all = push_button(
            tr("All"), tr("Show the hexes of all values (or double-click the plot)."), name=tr("Show all")
        )
        narrow(self.all)
        self.all.clicked.connect(lambda: self.chosen.emit(None))
        self.inverted = QToolButton()
        self.inverted.setCheckable(True)
        self.inverted.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.inverted.setIcon(swatch_icon(INVERTED))
        self.inverted.setIconSize(QSize(12, 12))
        set_help(self.inverted, tr("Show inverted"), tr(_INVERTED))
        self.inverted.clicked.connect(lambda on: self._choose(replace(self._range, inverted=on)))
        for box in (self.low, self.high):
            box.setFixedWidth(_WIDTH)
            box.setAlignment(Qt.AlignmentFlag.AlignRight)
            box.setFont(tabular(box.font()))
            box.editingFinished.connect(lambda box=box: self._on_end(box))
        parts = (self.low, QLabel(tr("to")), self.high, self.inverted, None, self.all)
        fill(QHBoxLayout(self), *parts, margins=(0, 0, 0, 0), spacing=4)
        self.show_range(self._axis, None)

    def show_range(self, axis: Axis, range: Show | None) -> None:
        """Show a range of a metric, or None for all hexes, without a signal."""
        metric = in_sentence(METRICS[axis.metric])
        for box, name in ((self.low, tr("Minimum {metric} shown")), (self.high, tr("Maximum {metric} shown"))):
            name = name.format(metric=metric)
            set_help(
                box,
                name,
                tr("{name}; hexes beyond it are hidden. Dragging over the plot sets the same range.", name=name),
            )
        self.all.setEnabled(range is not None)
        minimum, maximum = METRICS[axis.metric].full_range
        self._axis, self._range = axis, range or Show((minimum, maximum), axis.metric, inverted=True)
        self.inverted.setChecked(self._range.inverted)
        ends = (max(self._range.low, minimum), min(self._range.high, maximum))
        for box, end in zip((self.low, self.high), ends, strict=True):
            if not box.isModified():  # not while a number is typed
                box.setText(_text(end))

    def _on_end(self, box: QLineEdit) -> None:
        """Use a new number; a text that is none is replaced by the end of the range."""
        if not box.isModified():  # a brushed end has more digits than its field
            return
        box.setModified(False)
        is_low = box is self.low
        try:
            end = _number(box.text())
        except ValueError:
            end = self._range.low if is_low else self._range.high
        # Inverted hexes are left of all values: a lower end excludes them.
        if is_low and self._range.low <= METRICS[self._axis.metric].full_range[0]:
            self.inverted.setChecked(False)
        low, high = sorted((end, self._range.high) if is_low else (self._range.low, end))
        self._choose(Show((low, high), self._axis.metric, self.inverted.isChecked()))

    def _choose(self, range: Show) -> None:
        minimum, maximum = METRICS[range.metric].full_range
        everything = range.inverted and range.low <= minimum and range.high >= maximum
        self.show_range(self._axis, None if everything else range)
        self.chosen.emit(None if everything else range)


def _text(value: float) -> str:
    return f"{value:.6g}".replace("inf", "∞").replace("-", "−")


def _number(text: str) -> float:
    """Read a number in any notation, also infinity; raise ValueError for other texts and nan."""
    number = float(text.strip().replace("−", "-").replace("∞", "inf"))
    if math.isnan(number):
        raise ValueError(text)
    return number
