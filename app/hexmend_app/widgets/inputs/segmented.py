"""Row of joined buttons with exactly one checked."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QAbstractButton, QButtonGroup, QHBoxLayout, QPushButton, QSizePolicy, QWidget

from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import bold, set_help, set_variant, smaller


def _stop_at_checked(button: QAbstractButton, checked: bool) -> None:
    """Let Tab reach the checked button only; Qt would stop at the first button from either side."""
    button.setFocusPolicy(Qt.FocusPolicy.StrongFocus if checked else Qt.FocusPolicy.ClickFocus)


class Segmented(QWidget):
    """Control that chooses one of a few visible options; arrow keys move between them.

    Parameters
    ----------
    name : str
        Accessible name of the control.
    options : iterable of (key, text, help)

    Signals
    -------
    chosen(key)
        The user chose an option.
    """

    chosen = Signal(str)

    def __init__(self, name: str, options: Iterable[tuple[str, str, str]], parent: QWidget | None = None):
        super().__init__(parent)
        self.setAccessibleName(name)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        self._group = QButtonGroup(self)
        self._buttons: dict[str, QPushButton] = {}
        options = list(options)
        for at, (key, text, help) in enumerate(options):
            button = QPushButton(text)
            button.setCheckable(True)
            set_variant(button, "segment")
            button.setProperty("place", "first" if at == 0 else "last" if at == len(options) - 1 else "")
            set_help(button, f"{name}: {text}", help)
            button.clicked.connect(lambda _=False, key=key: self.chosen.emit(key))
            # The checked button is bold; its width must not depend on that.
            button.setFont(smaller(button.font()))
            button.setMinimumWidth(QFontMetrics(bold(button.font())).horizontalAdvance(text) + 12)
            self._group.addButton(button)
            self._buttons[key] = button
        fill(QHBoxLayout(self), *self._buttons.values(), margins=(0, 0, 0, 0), spacing=0)
        self._group.buttonToggled.connect(_stop_at_checked)
        for button in self._buttons.values():
            _stop_at_checked(button, False)
        self.set_value(options[0][0])

    def value(self) -> str:
        """Return the key of the chosen option."""
        return next(key for key, button in self._buttons.items() if button.isChecked())

    def set_value(self, key: str) -> None:
        """Choose an option, without a signal."""
        self._buttons[key].setChecked(True)

    def button(self, key: str) -> QPushButton:
        """Return the button of an option."""
        return self._buttons[key]
