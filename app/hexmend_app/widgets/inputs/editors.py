"""One editor per kind of declared parameter, all with `value`, `set_value`, `problem` and the signal `changed`."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QCheckBox, QComboBox, QLineEdit, QWidget

from hexmend.parameters import Parameter
from hexmend_app.widgets.inputs.number_box import NumberBox
from hexmend_app.widgets.wording import name_in_words


class Switch(QCheckBox):
    """Editor of a bool."""

    changed = Signal()
    problem = ""

    def __init__(self, declaration: Parameter, parent: QWidget | None = None):
        super().__init__(parent)
        self.set_value(declaration.default)
        self.clicked.connect(self.changed)

    def value(self) -> bool:
        """The state of the box."""
        return self.isChecked()

    def set_value(self, value: bool) -> None:
        """Show a value, without a signal."""
        self.setChecked(value)


class ChoiceEditor(QComboBox):
    """Editor of one word out of several."""

    changed = Signal()
    problem = ""

    def __init__(self, declaration: Parameter, parent: QWidget | None = None):
        super().__init__(parent)
        self._declaration = declaration
        for choice in declaration.choices or ():
            self.addItem(name_in_words(choice), choice)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.set_value(declaration.default)
        self.activated.connect(self.changed)

    def value(self) -> str:
        """The word chosen, as declared."""
        return self.currentData()

    def set_value(self, value: str) -> None:
        """Show a value, without a signal; ParameterError where it is none of the choices."""
        self.setCurrentIndex(self.findData(self._declaration.check(value)))

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Turn only while focused: scrolling the panel must not change what lies under the pointer."""
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()


class Text(QLineEdit):
    """Editor of free text."""

    changed = Signal()
    problem = ""

    def __init__(self, declaration: Parameter, parent: QWidget | None = None):
        super().__init__(parent)
        self.set_value(declaration.default)
        self.textEdited.connect(lambda _: self.changed.emit())

    def value(self) -> str:
        """The text as typed."""
        return self.text()

    def set_value(self, value: str) -> None:
        """Show a value, without a signal."""
        self.setText(str(value))


Editor = Switch | ChoiceEditor | Text | NumberBox


def editor_for(declaration: Parameter) -> Editor:
    """The editor that fits a declaration."""
    if declaration.choices is not None:
        return ChoiceEditor(declaration)
    return {bool: Switch, str: Text}.get(declaration.type, NumberBox)(declaration)
