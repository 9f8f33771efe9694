"""Slider and spin box for a whole number."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QSlider, QSpinBox, QWidget

from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import set_help, tabular


class SliderBox(QWidget):
    """Editor of a whole number from 0: roughly with a slider or exactly in a spin box.

    Parameters
    ----------
    name, help : str
        See `hexmend_app.theme.style.set_help`.
    most : int
        Maximum.
    suffix : str
        Text after the number.

    Signals
    -------
    changed(int)
        The user chose a number.
    """

    changed = Signal(int)

    def __init__(self, name: str, help: str, most: int, suffix: str = "", parent: QWidget | None = None):
        super().__init__(parent)
        self._name = name
        self._value = 0
        self._slider = QSlider(Qt.Orientation.Horizontal)
        self._box = QSpinBox()
        self._box.setSuffix(suffix)
        self._box.setFont(tabular(self._box.font()))
        self._box.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        fill(QHBoxLayout(self), (self._slider, 1), self._box, margins=(0, 0, 0, 0))
        self.setFocusProxy(self._slider)
        for part in (self._slider, self._box):
            part.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
            part.installEventFilter(self)
            part.valueChanged.connect(self._choose)
        self.set_most(most)
        self.set_help(help)

    def value(self) -> int:
        """Return the number."""
        return self._value

    def set_value(self, value: int) -> None:
        """Show a number, without a signal."""
        self._value = value
        for part in (self._slider, self._box):
            if part.value() != value:  # otherwise the text would be replaced during typing
                with QSignalBlocker(part):
                    part.setValue(value)

    def set_most(self, most: int) -> None:
        """Set the maximum, without a signal."""
        for part in (self._slider, self._box):
            with QSignalBlocker(part):
                part.setRange(0, most)
        self._value = min(self._value, most)
        self._slider.setPageStep(max(1, most // 10))

    def set_help(self, help: str) -> None:
        """Set the help text, for example the reason for which the control is disabled."""
        for part in (self, self._slider, self._box):
            set_help(part, self._name, help)

    def set_box_width(self, width: int) -> None:
        """Set the width of the box, to align it with others."""
        self._box.setFixedWidth(width)

    def box_width(self) -> int:
        """Return the preferred width of the box."""
        return self._box.sizeHint().width()

    def eventFilter(self, part: QObject, event: QEvent) -> bool:
        """Ignore the wheel unless focused, so that scrolling a panel does not change the value."""
        if event.type() == QEvent.Type.Wheel and not part.hasFocus():  # type: ignore[attr-defined]
            event.ignore()
            return True
        return super().eventFilter(part, event)

    def _choose(self, value: int) -> None:
        if value != self._value:  # a box emits its value again when it loses the focus
            self.set_value(value)
            self.changed.emit(value)
