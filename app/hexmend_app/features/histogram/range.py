"""The row below the histogram: the ends of the range in numbers."""

from __future__ import annotations

import math

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QFontMetrics, QResizeEvent, QValidator
from PySide6.QtWidgets import QDoubleSpinBox, QHBoxLayout, QLabel, QPushButton, QWidget

from hexmend.quality import METRICS
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.widgets.metrics import in_sentence
from hexmend_app.widgets.style import explain, tabular

#: Stands for infinity in a spin box, which has no other number for it.
_HUGE = 1e300
_WIDEST = 86


class EndBox(QDoubleSpinBox):
    """A number in any notation, or ∞ where the axis goes on without end."""

    def __init__(self) -> None:
        super().__init__()
        self._axis = Axis("q")
        # A half-typed number is not a wish.
        self.setKeyboardTracking(False)
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.setFont(tabular(self.font()))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    def set_axis(self, axis: Axis) -> None:
        """Take numbers of another metric."""
        self._axis = axis
        least, most = METRICS[axis.metric].full_range
        self.setDecimals(max(axis.decimals, 2))
        self.setRange(max(least, -_HUGE), min(most, _HUGE))
        self.setSingleStep(axis.grain)

    def end(self) -> float:
        """The number, infinite where there is no bound."""
        value = self.value()
        if abs(value) >= _HUGE:
            return math.copysign(math.inf, value)
        return round(value, self.decimals())

    def set_end(self, value: float) -> None:
        """Show a number, without a signal."""
        with QSignalBlocker(self):
            self.setValue(value)

    def textFromValue(self, value: float) -> str:
        """The number as the axis writes it."""
        text = self._axis.text(math.copysign(math.inf, value) if abs(value) >= _HUGE else value)
        return text.replace("-", "−")

    def valueFromText(self, text: str) -> float:
        """The number of a text that `validate` accepts."""
        return min(max(_number(text), self.minimum()), self.maximum())

    def validate(self, text: str, position: int) -> tuple:
        """Any notation of a number, finished or not."""
        try:
            _number(text)
        except ValueError:
            started = all(letter in "0123456789.+-−eE∞inf" for letter in text)
            return (QValidator.State.Intermediate if started else QValidator.State.Invalid), text, position
        return QValidator.State.Acceptable, text, position

    def fixup(self, text: str) -> str:
        """What was not finished is given up."""
        return self.textFromValue(self.value())

    def stepBy(self, steps: int) -> None:
        """Step by a hundredth of the axis; from infinity back to its end."""
        if abs(self.value()) >= _HUGE:
            self.setValue(self._axis.high if self.value() > 0 else self._axis.low)
        else:
            super().stepBy(steps)

    def sizeHint(self) -> QSize:
        """Wide enough for the axis' numbers."""
        return self.minimumSizeHint()

    def minimumSizeHint(self) -> QSize:
        """Wide enough for the axis' numbers, but never so wide that the window would have to grow."""
        middle = self._axis.low + 0.567 * (self._axis.high - self._axis.low)
        texts = [self.textFromValue(value) for value in (middle, self._axis.high, self.minimum())]
        widest = max(self.fontMetrics().horizontalAdvance(text) for text in (*texts, "0.00"))
        return QSize(min(widest + 32, _WIDEST), super().minimumSizeHint().height())


class RangeRow(QWidget):
    """Chooses the lowest and the highest value that is shown.

    Signals
    -------
    chosen(low, high)
        The user did, by numbers.
    cleared
        The user wants all.
    """

    chosen = Signal(float, float)
    cleared = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._axis = Axis("q")
        self.low, self.high, self.all = EndBox(), EndBox(), QPushButton("Show all")
        explain(self.all, "Show all", "Show the elements of every value again (or double-click on the plot).")
        self.all.clicked.connect(self.cleared)
        self._label, to = QLabel(), QLabel("to")
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        for part in (self._label, self.low, to, self.high):
            row.addWidget(part)
        row.addStretch()
        row.addWidget(self.all)
        self._rest = (self.low, to, self.high, self.all)
        for box in (self.low, self.high):
            box.valueChanged.connect(self._on_ends)
        self.set_axis(self._axis)
        self.show_ends(None)

    def set_axis(self, axis: Axis) -> None:
        """Take numbers of another metric."""
        self._axis = axis
        words = in_sentence(METRICS[axis.metric])
        for box, which in ((self.low, "Lowest"), (self.high, "Highest")):
            with QSignalBlocker(box):
                box.set_axis(axis)
            box.updateGeometry()
            name = f"{which} {words} shown"
            explain(box, name, f"{name}: elements beyond it are hidden. Dragging over the plot sets the same range.")
        self._fit()

    def show_ends(self, ends: tuple[float, float] | None) -> None:
        """Show a range, or that all are shown; without a signal."""
        low, high = ends or METRICS[self._axis.metric].full_range
        # Ends that were typed in the other order stay where the user typed them.
        if sorted((self.low.end(), self.high.end())) != [low, high]:
            self.low.set_end(low)
            self.high.set_end(high)
        self.all.setEnabled(ends is not None)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Name the metric where there is room."""
        super().resizeEvent(event)
        self._fit()

    def minimumSizeHint(self) -> QSize:
        """Without a text before the numbers."""
        spacing = self.layout().spacing()
        width = sum(part.minimumSizeHint().width() + spacing for part in self._rest)
        return QSize(width, super().minimumSizeHint().height())

    def _fit(self) -> None:
        metric = METRICS[self._axis.metric]
        texts = (f"Show {in_sentence(metric)} from", "Show from", "Show", "")
        spacing = self.layout().spacing()
        room = self.width() - sum(part.minimumSizeHint().width() + spacing for part in self._rest) - spacing
        widths = [QFontMetrics(self.font()).horizontalAdvance(text) for text in texts]
        self._label.setText(next((text for text, width in zip(texts, widths, strict=True) if width <= room), texts[-1]))

    def _on_ends(self) -> None:
        low, high = sorted((self.low.end(), self.high.end()))
        self.chosen.emit(low, high)


def _number(text: str) -> float:
    """Any notation of a number, infinity among them; ValueError for what is none."""
    number = float(text.strip().replace("−", "-").replace("∞", "inf"))
    if math.isnan(number):
        raise ValueError(text)
    return min(max(number, -_HUGE), _HUGE)
