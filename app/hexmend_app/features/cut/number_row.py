"""Rows of number boxes that show coordinates which are also dragged in the view."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QWidget

from hexmend.parameters import Parameter
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import set_help
from hexmend_app.widgets.inputs.number_box import NumberBox

#: Significant digits of numbers that were dragged.
_DIGITS = 4
_MIN_WIDTH = 48  # of three boxes in the narrowest panel


class NumberRow(QWidget):
    """Row of boxes for a few numbers.

    A number that was not typed is shown rounded; `changed` gives the number typed and leaves the others as they are.

    Parameters
    ----------
    names : sequence of str
        Accessible name of each box.
    help : str
    low : float, optional
        Lower bound.

    Attributes
    ----------
    values : tuple of float
        The numbers, not rounded.

    Signals
    -------
    changed(tuple of float)
        The user typed a number.
    """

    changed = Signal(object)

    def __init__(self, names: Sequence[str], help: str, low: float | None = None, parent: QWidget | None = None):
        super().__init__(parent)
        self.values = tuple(1.0 for _ in names)
        self._boxes = [NumberBox(Parameter(name, float, 1.0, low, None, None, "", "")) for name in names]
        for at, (name, box) in enumerate(zip(names, self._boxes, strict=True)):
            set_help(box, name, help)
            box.setMinimumWidth(_MIN_WIDTH)
            if len(names) > 1:  # there is no room for the arrows
                box.setButtonSymbols(NumberBox.ButtonSymbols.NoButtons)
            box.changed.connect(lambda at=at: self._on_changed(at))
        fill(QHBoxLayout(self), *((box, 1) for box in self._boxes), margins=(0, 0, 0, 0), spacing=4)
        self.setFocusProxy(self._boxes[0])

    def set_values(self, values: Sequence[float]) -> None:
        """Show numbers; emits no signal, and leaves text that is being typed."""
        self.values = tuple(values)
        for box, value in zip(self._boxes, self.values, strict=True):
            if _rounded(box.value()) != _rounded(value):
                box.set_value(_rounded(value))

    def set_range(self, low: float, high: float) -> None:
        """Show two numbers, of which the first digits of the greater one, being typed, may be less than the other."""
        if sorted(self.values) != [low, high]:
            self.set_values((low, high))

    def _on_changed(self, at: int) -> None:
        typed = self._boxes[at].value()
        if typed != _rounded(self.values[at]):
            self.values = (*self.values[:at], typed, *self.values[at + 1 :])
            self.changed.emit(self.values)


def _rounded(value: float) -> float:
    return float(f"{value:.{_DIGITS}g}")
