"""Spin box that accepts any notation of a number, and explains invalid texts instead of correcting them."""

from __future__ import annotations

import math
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QAbstractSpinBox, QWidget

from hexmend.errors import ParameterError
from hexmend.parameters import Parameter
from hexmend_app.theme.style import set_variant, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.combo import FocusedWheel
from hexmend_app.widgets.wording import short_number


class NumberBox(FocusedWheel, QAbstractSpinBox):
    """Editor of a declared number.

    The text is parsed at each key press. An invalid text is kept and coloured, `problem` explains what is expected, and
    `value` is the value from before editing.

    Parameters
    ----------
    declaration : Parameter
        Of type int or float.

    Signals
    -------
    changed
        The user changed the value, or its text became invalid or valid.
    """

    changed = Signal()

    def __init__(self, declaration: Parameter, parent: QWidget | None = None):
        super().__init__(parent)
        self._declaration = declaration
        self._zero = tr(declaration.zero) if declaration.zero else ""
        self._value = self._committed = declaration.default
        self.problem = ""
        # Values change while the user types, so Qt must neither delay signals nor correct the text.
        self.setKeyboardTracking(True)
        self.setFont(tabular(self.font()))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        line = self.lineEdit()
        line.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        line.textEdited.connect(self._parse)
        line.editingFinished.connect(self._commit)
        line.setTextMargins(0, 0, 2, 0)
        self.setMinimumWidth(self.fontMetrics().horizontalAdvance("0.00000") + 36)
        self.set_value(declaration.default)

    def value(self) -> Any:
        """Return the last valid value: a number, a declared word or a percentage."""
        return self._value

    def set_value(self, value: float | int | str) -> None:
        """Show a value, without a signal.

        Raises
        ------
        ParameterError
            If the declaration does not admit it.
        """
        self._value = self._committed = self._declaration.check(value)
        self.lineEdit().setText(self._text_of(self._value))
        self._set_problem("")

    def _parse(self, text: str) -> None:
        try:
            value = self._declaration.parse("0" if self._zero and text.strip() == self._zero else text.strip())
            if not isinstance(value, str) and not math.isfinite(value):
                raise ParameterError(f"{text} is not finite")
        except ParameterError:
            # Not the last valid text: while 1e-3 is typed, that is 1.
            self._value = self._committed
            expected, previous = self._declaration.range, self._text_of(self._value)
            self._set_problem(
                tr(
                    "Expected {expected}. {previous} is used until this is corrected.",
                    expected=expected,
                    previous=previous,
                )
            )
        else:
            self._value = value
            self._set_problem("")
        self.changed.emit()

    def _set_problem(self, problem: str) -> None:
        self.problem = problem
        set_variant(self, bool(problem), "invalid")

    def stepBy(self, steps: int) -> None:
        """Step an integer by one, another number by one in its leading digit; stop at the bounds.

        The step after the upper bound is the declared word for no limit, that below the lower one the word for an
        automatic value, if there is one.
        """
        value = self._value
        for _ in range(abs(steps)):
            value = self._stepped(value, 1 if steps > 0 else -1)
        if value != self._value or self.problem:
            self.set_value(value)
            self.changed.emit()
        self.lineEdit().selectAll()

    def _stepped(self, value: float | str, sign: int) -> float | str:
        """Return the next value up (sign 1) or down (-1); words are beyond the bounds."""
        declared = self._declaration
        end, word = (declared.high, declared.no_limit) if sign > 0 else (declared.low, declared.automatic)
        if value in (declared.automatic, declared.no_limit):
            bound = declared.low if sign > 0 else declared.high
            return value if value == word or bound is None else bound
        if isinstance(value, str):  # a percentage
            return f"{min(max(_next(float(value[:-1]), sign), 0.0), 100.0):.12g}%"
        if end is not None and value * sign >= end * sign:
            return word or value
        default = 0.0 if isinstance(declared.default, str) else declared.default
        stepped = value + sign if declared.type is int else _next(value, sign, default)
        return stepped if end is None else min(stepped * sign, end * sign) * sign

    def stepEnabled(self) -> QAbstractSpinBox.StepEnabledFlag:
        """Return the enabled arrows."""
        flags = QAbstractSpinBox.StepEnabledFlag.StepNone
        if self._stepped(self._value, 1) != self._value:
            flags |= QAbstractSpinBox.StepEnabledFlag.StepUpEnabled
        if self._stepped(self._value, -1) != self._value:
            flags |= QAbstractSpinBox.StepEnabledFlag.StepDownEnabled
        return flags

    def _text_of(self, value: float | int | str) -> str:
        """Return the text of a value; that of 0 may be a word."""
        if isinstance(value, str):
            return value
        return self._zero if self._zero and value == 0 else short_number(value)

    def _commit(self) -> None:
        """Write a valid value in its shortest form after editing."""
        if not self.problem:
            self.set_value(self._value)


def _next(value: float, sign: int, default: float = 0.0) -> float:
    """Return a number one more (sign 1) or less (-1) in its leading digit, for 0 in that of a default."""
    exponent = math.floor(math.log10(abs(value) or abs(default) or 0.1) + 1e-9)
    if value * sign < 0 and math.isclose(abs(value), 10.0**exponent):
        exponent -= 1  # the value below 1 is 0.9, not 0
    return round(value + sign * 10.0**exponent, 12 - exponent)
