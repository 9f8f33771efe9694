"""Editors of declared parameters, one per type, with `value`, `set_value`, `problem` and the signal `changed`."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QCheckBox, QComboBox, QLineEdit, QWidget

from hexmend.parameters import Parameter
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.combo import ComboBox, FocusedWheel, let_shrink
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
        """Return True if the box is checked."""
        return self.isChecked()

    def set_value(self, value: bool) -> None:
        """Show a value, without a signal."""
        self.setChecked(value)


class ChoiceEditor(FocusedWheel, ComboBox):
    """Editor of a choice."""

    changed = Signal()
    problem = ""

    def __init__(self, declaration: Parameter, parent: QWidget | None = None):
        super().__init__(parent)
        self._declaration = declaration
        choices = declaration.choices or ()
        for choice, title in zip(choices, declaration.titles or map(name_in_words, choices), strict=True):
            self.addItem(tr(title), choice)
        let_shrink(self, 8)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.set_value(declaration.default)
        self.activated.connect(self.changed)

    def value(self) -> str:
        """Return the choice as declared."""
        return self.currentData()

    def set_value(self, value: str) -> None:
        """Show a value, without a signal; raise `ParameterError` if it is not among the choices."""
        self.setCurrentIndex(self.findData(self._declaration.check(value)))


class Text(QLineEdit):
    """Editor of free text."""

    changed = Signal()
    problem = ""

    def __init__(self, declaration: Parameter, parent: QWidget | None = None):
        super().__init__(parent)
        self.set_value(declaration.default)
        self.textEdited.connect(lambda _: self.changed.emit())

    def value(self) -> str:
        """Return the text."""
        return self.text()

    def set_value(self, value: str) -> None:
        """Show a value, without a signal."""
        self.setText(str(value))


class SuggestedText(FocusedWheel, QComboBox):
    """Editor of free text that offers values."""

    changed = Signal()
    problem = ""

    def __init__(self, declaration: Parameter, parent: QWidget | None = None):
        super().__init__(parent)
        self.setEditable(True)
        self.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
        self.addItems(list(declaration.suggestions))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.set_value(declaration.default)
        self.activated.connect(self.changed)
        self.lineEdit().textEdited.connect(lambda _: self.changed.emit())

    def value(self) -> str:
        """Return the text."""
        return self.currentText()

    def set_value(self, value: str) -> None:
        """Show a value, without a signal."""
        self.setEditText(str(value))


Editor = Switch | ChoiceEditor | Text | SuggestedText | NumberBox


def editor_for(declaration: Parameter) -> Editor:
    """Return an editor for a declared parameter."""
    if declaration.choices is not None:
        return ChoiceEditor(declaration)
    if declaration.suggestions:
        return SuggestedText(declaration)
    return {bool: Switch, str: Text}.get(declaration.type, NumberBox)(declaration)  # type: ignore[return-value]
