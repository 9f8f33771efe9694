"""A slider and a box for one whole number."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QSlider, QSpinBox, QWidget

from hexmend_app.theme.style import set_help, tabular


class SliderBox(QWidget):
    """Chooses a whole number from 0 upwards, roughly by the slider or exactly in the box.

    Parameters
    ----------
    name, help : str
        See `explain`.
    most : int
        The largest number.
    suffix : str
        Stands behind the number.

    Signals
    -------
    changed(int)
        The user chose.
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
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self._slider, 1)
        layout.addWidget(self._box)
        self.setFocusProxy(self._slider)
        for part in (self._slider, self._box):
            part.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
            part.installEventFilter(self)
            part.valueChanged.connect(self._choose)
        self.set_most(most)
        self.set_help(help)

    def value(self) -> int:
        """The number."""
        return self._value

    def set_value(self, value: int) -> None:
        """Show a number, without a signal."""
        self._value = value
        for part in (self._slider, self._box):
            if part.value() != value:  # or what is being typed would be written anew
                with QSignalBlocker(part):
                    part.setValue(value)

    def set_most(self, most: int) -> None:
        """Take another largest number, without a signal."""
        for part in (self._slider, self._box):
            with QSignalBlocker(part):
                part.setRange(0, most)
        self._value = min(self._value, most)
        self._slider.setPageStep(max(1, most // 10))

    def set_help(self, help: str) -> None:
        """Explain it otherwise, for example why it is disabled."""
        for part in (self, self._slider, self._box):
            set_help(part, self._name, help)

    def set_box_width(self, width: int) -> None:
        """Make the box as wide as others that stand above and below it."""
        self._box.setFixedWidth(width)

    def box_width(self) -> int:
        """Preferred width of the box."""
        return self._box.sizeHint().width()

    def eventFilter(self, part: QObject, event: QEvent) -> bool:
        """Turn only while focused: scrolling the panel must not change what lies under the pointer."""
        if event.type() == QEvent.Type.Wheel and not part.hasFocus():
            event.ignore()
            return True
        return super().eventFilter(part, event)

    def _choose(self, value: int) -> None:
        if value != self._value:  # a box tells again what was typed as it is left
            self.set_value(value)
            self.changed.emit(value)
