"""Spin box for an end of a range of values."""

from __future__ import annotations

import math

from PySide6.QtCore import QSignalBlocker, QSize, Qt
from PySide6.QtGui import QValidator
from PySide6.QtWidgets import QDoubleSpinBox, QSizePolicy

from hexmend.quality import METRICS
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.theme.style import tabular

#: Represents infinity, which a spin box cannot have as value.
_HUGE = 1e300

#: Minimum and maximum width in pixels. The minimum does not depend on the metric, so that the width of the column of
#: panels does not either.
_MIN_WIDTH, _MAX_WIDTH = 68, 80


class EndBox(QDoubleSpinBox):
    """Spin box for a number in any notation, or ∞ if the metric is unbounded."""

    def __init__(self) -> None:
        super().__init__()
        self._axis = Axis("q")
        self.setKeyboardTracking(False)  # an incomplete number is no value
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.setFont(tabular(self.font()))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setButtonSymbols(QDoubleSpinBox.ButtonSymbols.NoButtons)  # too wide; arrow keys step
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)

    def set_axis(self, axis: Axis) -> None:
        """Change the metric and the range of its values."""
        self._axis = axis
        minimum, maximum = METRICS[axis.metric].full_range
        self.setDecimals(max(axis.decimals, 2) + 2)  # as many as `Axis.end_text` writes
        self.setRange(max(minimum, -_HUGE), min(maximum, _HUGE))
        self.setSingleStep(axis.resolution)

    def end(self) -> float:
        """Return the number, which may be infinite."""
        value = self.value()
        if abs(value) >= _HUGE:
            return math.copysign(math.inf, value)
        return round(value, self.decimals())

    def set_end(self, value: float) -> None:
        """Show a number without emitting a signal."""
        with QSignalBlocker(self):
            self.setValue(value)

    def textFromValue(self, value: float) -> str:
        """Write a number as the axis does."""
        text = self._axis.end_text(math.copysign(math.inf, value) if abs(value) >= _HUGE else value)
        return text.replace("-", "−")

    def valueFromText(self, text: str) -> float:
        """Read a text that `validate` accepts."""
        return min(max(_number(text), self.minimum()), self.maximum())

    def validate(self, text: str, position: int) -> tuple:
        """Accept any notation of a number; a text with only its characters is incomplete."""
        try:
            _number(text)
        except ValueError:
            incomplete = all(letter in "0123456789.+-−eE∞inf" for letter in text)
            return (QValidator.State.Intermediate if incomplete else QValidator.State.Invalid), text, position
        return QValidator.State.Acceptable, text, position

    def fixup(self, text: str) -> str:
        """Replace an incomplete entry by the current value."""
        return self.textFromValue(self.value())

    def stepBy(self, steps: int) -> None:
        """Step by a hundredth of the axis; from infinity to the end of the axis."""
        if abs(self.value()) >= _HUGE:
            self.setValue(self._axis.high if self.value() > 0 else self._axis.low)
        else:
            super().stepBy(steps)

    def sizeHint(self) -> QSize:
        """Return a size for the numbers of the axis."""
        middle = self._axis.low + 0.567 * (self._axis.high - self._axis.low)
        texts = [self.textFromValue(value) for value in (middle, self._axis.high, self.minimum())]
        widest = max(self.fontMetrics().horizontalAdvance(text) for text in (*texts, "0.00"))
        return QSize(min(max(widest + 14, _MIN_WIDTH), _MAX_WIDTH), super().sizeHint().height())

    def minimumSizeHint(self) -> QSize:
        """Return a size for most numbers."""
        return QSize(_MIN_WIDTH, super().minimumSizeHint().height())


def _number(text: str) -> float:
    """Read a number in any notation, also infinity; raise ValueError for other texts and nan."""
    number = float(text.strip().replace("−", "-").replace("∞", "inf"))
    if math.isnan(number):
        raise ValueError(text)
    return min(max(number, -_HUGE), _HUGE)
