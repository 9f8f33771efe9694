"""Row of controls below the histogram, for the ends of the range."""

from __future__ import annotations

import math

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QColor, QIcon, QPainter, QPen, QPixmap, QResizeEvent, QValidator
from PySide6.QtWidgets import QDoubleSpinBox, QHBoxLayout, QLabel, QPushButton, QSizePolicy, QToolButton, QWidget

from hexmend.quality import METRICS
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.picture.visibility import Show
from hexmend_app.theme.palette import INVERTED
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import narrow, set_help, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.metric_texts import in_sentence

_SPACING, _SWATCH = 4, 12
_INVERTED = "Show inverted hexes as well, of any value; they have a separate bar left of the bins."


#: Represents infinity, which a spin box cannot have as value.
_HUGE = 1e300

#: Minimum and maximum width in pixels. The minimum does not depend on the metric, so that the width of the column of
#: panels does not either.
_MIN_WIDTH, _MAX_WIDTH = 68, 80


class RangeRow(QWidget):
    """Controls for the lowest and highest value that is shown, and for inverted hexes.

    Signals
    -------
    chosen(low, high, inverted)
        The user changed an end of the range, or showed or hid inverted hexes.
    """

    chosen = Signal(float, float, bool)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._axis = Axis("q")
        self._shown: Show | None = None
        #: Ends of the range; a brushed end has more digits than its box.
        self._ends: dict[EndBox, float] = {}
        self.low, self.high, self.all = EndBox(), EndBox(), QPushButton(tr("All"))
        set_help(self.all, tr("Show all"), tr("Show the hexes of all values (or double-click the plot)."))
        narrow(self.all)
        self.inverted = QToolButton()
        self.inverted.setCheckable(True)
        self.inverted.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.inverted.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonIconOnly)
        self.inverted.setIconSize(QSize(_SWATCH, _SWATCH))
        set_help(self.inverted, tr("Show inverted"), tr(_INVERTED))
        self.inverted.clicked.connect(self._choose)
        self.inverted.setIcon(_swatch())
        self._label, to = QLabel(tr("Show")), QLabel(tr("to"))
        self.controls = (self.low, to, self.high, self.inverted, self.all)
        parts = (self._label, *self.controls[:-1], None, self.all)
        fill(QHBoxLayout(self), *parts, margins=(0, 0, 0, 0), spacing=_SPACING)
        for box in (self.low, self.high):
            box.valueChanged.connect(lambda _, box=box: self._on_end(box))
        self.set_axis(self._axis)
        self.show_range(None)

    def set_axis(self, axis: Axis) -> None:
        """Change the metric and the range of its values."""
        self._axis = axis
        metric = in_sentence(METRICS[axis.metric])
        for box, name in ((self.low, tr("Minimum {metric} shown")), (self.high, tr("Maximum {metric} shown"))):
            with QSignalBlocker(box):
                box.set_axis(axis)
            box.updateGeometry()
            name = name.format(metric=metric)
            set_help(
                box,
                name,
                tr("{name}; hexes beyond it are hidden. Dragging over the plot sets the same range.", name=name),
            )

    def show_range(self, range: Show | None) -> None:
        """Show a range, or None for all hexes, without emitting a signal."""
        self.all.setEnabled(range is not None)
        self.inverted.setChecked(range is None or range.inverted)
        # Ends that the user typed in reverse order stay as they are.
        if range is None or range != self._shown:
            minimum, maximum = METRICS[self._axis.metric].full_range
            ends = (minimum, maximum) if range is None else (max(range.low, minimum), min(range.high, maximum))
            for box, end in zip((self.low, self.high), ends, strict=True):
                box.set_end(end)
                self._ends[box] = end
        self._shown = range

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show the label if it fits."""
        super().resizeEvent(event)
        self._label.setVisible(self.width() >= self.minimumSizeHint().width() + self._label.sizeHint().width())

    def minimumSizeHint(self) -> QSize:
        """Return the size without the label."""
        widths = (control.minimumWidth() or control.minimumSizeHint().width() for control in self.controls)
        return QSize(sum(width + _SPACING for width in widths), super().minimumSizeHint().height())

    def _on_end(self, box: EndBox) -> None:
        self._ends[box] = box.end()
        # Inverted hexes are left of all values: a lower end excludes them.
        if self._shown is None and box is self.low:
            self.inverted.setChecked(False)
        self._choose()

    def _choose(self) -> None:
        low, high = sorted(self._ends.values())
        self._shown = Show((low, high), self._axis.metric, self.inverted.isChecked())
        self.chosen.emit(low, high, self._shown.inverted)


def _swatch() -> QIcon:
    """Return an icon that is filled while its button is checked, and else only a border."""
    icon = QIcon()
    for state in (QIcon.State.On, QIcon.State.Off):
        picture = QPixmap(_SWATCH, _SWATCH)
        picture.fill(QColor(INVERTED) if state == QIcon.State.On else Qt.GlobalColor.transparent)
        painter = QPainter(picture)
        painter.setPen(QPen(QColor(INVERTED), 2))
        painter.drawRect(1, 1, _SWATCH - 2, _SWATCH - 2)
        painter.end()
        icon.addPixmap(picture, state=state)
    return icon


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
