"""A number at an end of the range that is shown."""

from __future__ import annotations

import math

from PySide6.QtCore import QSignalBlocker, QSize, Qt
from PySide6.QtGui import QValidator
from PySide6.QtWidgets import QDoubleSpinBox, QSizePolicy

from hexmend.quality import METRICS
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.theme.style import tabular

#: Stands for infinity in a spin box, which has no other number for it.
_HUGE = 1e300

#: Pixels that it has at least and wants at most. The least is the same for every metric, or the column would grow and
#: shrink as others are chosen.
_LEAST, _MOST = 68, 80


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
        self.setButtonSymbols(QDoubleSpinBox.ButtonSymbols.NoButtons)  # which would have half of it; arrow keys step
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)

    def set_axis(self, axis: Axis) -> None:
        """Take numbers of another metric."""
        self._axis = axis
        least, most = METRICS[axis.metric].full_range
        self.setDecimals(max(axis.decimals, 2) + 2)  # as many as `Axis.end` writes
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
        text = self._axis.end(math.copysign(math.inf, value) if abs(value) >= _HUGE else value)
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
        """Replace an unfinished entry by the current value."""
        return self.textFromValue(self.value())

    def stepBy(self, steps: int) -> None:
        """Step by a hundredth of the axis; from infinity back to its end."""
        if abs(self.value()) >= _HUGE:
            self.setValue(self._axis.high if self.value() > 0 else self._axis.low)
        else:
            super().stepBy(steps)

    def sizeHint(self) -> QSize:
        """Wide enough for the axis' numbers."""
        middle = self._axis.low + 0.567 * (self._axis.high - self._axis.low)
        texts = [self.textFromValue(value) for value in (middle, self._axis.high, self.minimum())]
        widest = max(self.fontMetrics().horizontalAdvance(text) for text in (*texts, "0.00"))
        return QSize(min(max(widest + 14, _LEAST), _MOST), super().sizeHint().height())

    def minimumSizeHint(self) -> QSize:
        """Wide enough for most numbers."""
        return QSize(_LEAST, super().minimumSizeHint().height())


def _number(text: str) -> float:
    """Any notation of a number, infinity among them; ValueError for what is none."""
    number = float(text.strip().replace("−", "-").replace("∞", "inf"))
    if math.isnan(number):
        raise ValueError(text)
    return min(max(number, -_HUGE), _HUGE)
