"""A spin box that takes any notation of a number and says what is wrong instead of changing it."""

from __future__ import annotations

import math

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor, QPalette, QWheelEvent
from PySide6.QtWidgets import QAbstractSpinBox, QHBoxLayout, QLabel, QWidget

from hexmend.errors import ParameterError
from hexmend.parameters import Parameter
from hexmend_app.theme.palette import FIELD, MUTED, PANEL, TEXT, WORSE, WRONG, Role
from hexmend_app.theme.style import on_theme_change, smaller, tabular
from hexmend_app.widgets.wording import short_number

#: Letters of the longest unit that a box has room for behind its number.
LONGEST_UNIT = 6


class NumberBox(QAbstractSpinBox):
    """Editor of a declared number, whole or not.

    What is typed is read at each key. A text that is no admitted value stays as typed, is coloured, and `problem` says
    what was expected; `value` is then the one from before the typing began.

    Parameters
    ----------
    declaration : Parameter
        Of type int or float; its unit is shown behind the number, unless it is longer than `LONGEST_UNIT`.

    Signals
    -------
    changed
        The user changed the value, or its text became wrong or right.
    """

    changed = Signal()

    def __init__(self, declaration: Parameter, parent: QWidget | None = None):
        super().__init__(parent)
        self._declaration = declaration
        self._value = self._committed = declaration.default
        self.problem = ""
        # Values change while the user types on, so Qt must neither hold keys back nor correct the text.
        self.setKeyboardTracking(True)
        self.setFont(tabular(self.font()))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        line = self.lineEdit()
        line.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        line.textEdited.connect(self._read)
        line.editingFinished.connect(self._commit)
        self._show_unit(declaration.unit if len(declaration.unit) <= LONGEST_UNIT else "")
        self.set_value(declaration.default)
        on_theme_change(self, self._paint)

    def _show_unit(self, unit: str) -> None:
        line = self.lineEdit()
        suffix = QLabel(unit, line)
        suffix.setFont(smaller(suffix.font()))
        suffix.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        on_theme_change(suffix, lambda: suffix.setPalette(_enabled(QPalette.ColorRole.WindowText, MUTED)))
        layout = QHBoxLayout(line)
        layout.setContentsMargins(0, 0, 4, 0)
        layout.addStretch()
        layout.addWidget(suffix)
        width = suffix.sizeHint().width() + 6 if unit else 2
        line.setTextMargins(0, 0, width, 0)
        self.setMinimumWidth(width + self.fontMetrics().horizontalAdvance("0.00000") + 34)

    def value(self) -> float | int | str:
        """The last admitted value: a number, or the declaration's word for no limit."""
        return self._value

    def set_value(self, value: float | int | str) -> None:
        """Show a value, without a signal.

        Raises
        ------
        ParameterError
            Where the declaration does not admit it.
        """
        self._value = self._committed = self._declaration.check(value)
        self.lineEdit().setText(_text(self._value))
        self._mark("")

    def _read(self, text: str) -> None:
        try:
            value = self._declaration.parse(text.strip())
            if not isinstance(value, str) and not math.isfinite(value):
                raise ParameterError(f"{text} is not finite")
        except ParameterError:
            # Not the value of what was typed so far: on the way to 1e-3 that is 1.
            self._value = self._committed
            expected, kept = self._declaration.range, _text(self._value)
            self._mark(f"Expected {expected}. {kept} stays in use until this is corrected.")
        else:
            self._value = value
            self._mark("")
        self.changed.emit()

    def _mark(self, problem: str) -> None:
        self.problem = problem
        self._paint()

    def _paint(self) -> None:
        text, ground = (WORSE, WRONG) if self.problem else (TEXT, FIELD)
        palette = _enabled(QPalette.ColorRole.Text, text, _enabled(QPalette.ColorRole.Base, ground))
        palette.setColor(QPalette.ColorGroup.Disabled, QPalette.ColorRole.Base, QColor(str(PANEL)))
        self.setPalette(palette)

    def stepBy(self, steps: int) -> None:
        """Step a whole number by one, any other by one in its leading digit; stop at the bounds.

        Beyond the upper bound is no limit, where the declaration has a word for that.
        """
        value = self._value
        for _ in range(abs(steps)):
            value = self._neighbour(value, 1 if steps > 0 else -1)
        if value != self._value or self.problem:
            self.set_value(value)
            self.changed.emit()
        self.lineEdit().selectAll()

    def _neighbour(self, value: float | str, sign: int) -> float | str:
        low = -math.inf if self._declaration.low is None else self._declaration.low
        high = math.inf if self._declaration.high is None else self._declaration.high
        if isinstance(value, str):
            return value if sign > 0 else high
        if sign > 0 and value >= high and self._declaration.no_limit:
            return self._declaration.no_limit
        if self._declaration.type is int:
            return int(min(max(value + sign, low), high))
        magnitude = abs(value) or abs(self._declaration.default) or 0.1
        exponent = math.floor(math.log10(magnitude) + 1e-9)
        if value * sign < 0 and math.isclose(abs(value), 10.0**exponent):
            exponent -= 1  # below 1 comes 0.9, not 0
        moved = round(value + sign * 10.0**exponent, 12 - exponent)
        return min(max(moved, low), high)

    def stepEnabled(self) -> QAbstractSpinBox.StepEnabledFlag:
        """The arrows that are enabled."""
        flags = QAbstractSpinBox.StepEnabledFlag.StepNone
        unlimited, high, low = isinstance(self._value, str), self._declaration.high, self._declaration.low
        if not unlimited and (high is None or self._value < high or self._declaration.no_limit):
            flags |= QAbstractSpinBox.StepEnabledFlag.StepUpEnabled
        if unlimited or low is None or self._value > low:
            flags |= QAbstractSpinBox.StepEnabledFlag.StepDownEnabled
        return flags

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Turn only while focused: scrolling the panel must not change what lies under the pointer."""
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()

    def _commit(self) -> None:
        # An admitted value is written in its shortest form once the user is done with it.
        if not self.problem:
            self.set_value(self._value)


def _text(value: float | int | str) -> str:
    return value if isinstance(value, str) else short_number(value)


def _enabled(role: QPalette.ColorRole, colour: Role, palette: QPalette | None = None) -> QPalette:
    """A palette that colours a role of what is enabled: disabled, it is to look so."""
    palette = palette or QPalette()
    for group in (QPalette.ColorGroup.Active, QPalette.ColorGroup.Inactive):
        palette.setColor(group, role, QColor(str(colour)))
    return palette
