"""A form made from the keys of a table."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from enum import StrEnum
from typing import Any, get_args, get_origin

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QFormLayout, QLabel, QWidget

from hexmend.errors import ParameterError
from hexmend.parameters import Parameter
from hexmend_app.codec.config_table import ConfigTable, Option, options_of
from hexmend_app.codec.docstring_help import helps
from hexmend_app.theme.style import WORSE, note, set_help
from hexmend_app.widgets.inputs.editors import Editor, Text, editor_for
from hexmend_app.widgets.wording import name_in_words


class KeyForm(QWidget):
    """Edits some keys of a table, a row each; what nothing is said about is left to the program.

    Parameters
    ----------
    table : Table
        Its values are shown first.
    names : sequence of str
        The fields that are edited.

    Attributes
    ----------
    editors : dict of QWidget
        By field.

    Signals
    -------
    changed
        The user changed a value.
    """

    changed = Signal()

    def __init__(self, table: ConfigTable, names: Sequence[str], parent: QWidget | None = None):
        super().__init__(parent)
        self._kind = type(table)
        self._keys = {one.field: one for one in options_of(self._kind) if one.field in names}
        self.editors: dict[str, Editor | Suggested] = {}
        layout = QFormLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        for name in names:
            one = self._keys[name]
            editor = self.editors[name] = _editor(one)
            editor.changed.connect(self._on_changed)
            title = name_in_words(one.name) + (f" ({one.unit})" if one.unit else "")
            set_help(editor, title, helps(self._kind)[name])
            label = QLabel(title)
            label.setBuddy(editor)
            layout.addRow(label, editor)
        self._problem = note("", WORSE)
        self._problem.hide()
        layout.addRow(self._problem)
        self.show_table(table)

    def show_table(self, table: ConfigTable) -> None:
        """Show the values of a table, without a signal."""
        for name, editor in self.editors.items():
            value = getattr(table, name)
            editor.set_value(_text(value) if isinstance(editor, Text) else value)
        self._say("")

    def table(self, base: ConfigTable) -> ConfigTable:
        """A table with the values of the form.

        Raises
        ------
        ParameterError
            Where one cannot be used.
        """
        values = {}
        for name, editor in self.editors.items():
            if editor.problem:
                raise ParameterError(editor.problem)
            values[name] = _read(self._keys[name], editor.value()) if isinstance(editor, Text) else editor.value()
        return replace(base, **values)

    def _on_changed(self) -> None:
        try:
            self.table(self._kind())
            self._say("")
        except ParameterError as error:
            self._say(str(error))
        self.changed.emit()

    def _say(self, problem: str) -> None:
        self._problem.setText(problem)
        self._problem.setVisible(bool(problem))


class Suggested(QComboBox):
    """Editor of a text of which some are offered."""

    changed = Signal()
    problem = ""

    def __init__(self, offered: Sequence[str], parent: QWidget | None = None):
        super().__init__(parent)
        self.setEditable(True)
        self.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
        self.addItems(offered)
        self.activated.connect(self.changed)
        self.lineEdit().textEdited.connect(lambda _: self.changed.emit())

    def value(self) -> str:
        """The text as chosen or typed."""
        return self.currentText().strip()

    def set_value(self, value: str) -> None:
        """Show a text, without a signal."""
        self.setCurrentText(value)


def _editor(one: Option) -> Editor | Suggested:
    kind = one.kind
    if kind is bool or kind in (int, float):
        return editor_for(Parameter(one.name, kind, one.default, one.low, one.high, None, "", ""))
    if one.offered:
        return Suggested(one.offered)
    if isinstance(kind, type) and issubclass(kind, StrEnum):
        return editor_for(Parameter(one.name, str, one.default.value, None, None, tuple(kind), "", ""))
    editor = editor_for(Parameter(one.name, str, "", None, None, None, "", ""))
    editor.setPlaceholderText("as suits" if one.default in (None, "") else _text(one.default))
    return editor


def _read(one: Option, text: str) -> Any:
    """The value that a text stands for."""
    text = text.strip()
    if not text or one.kind is str:
        return text or one.default
    try:
        numbers = [float(word) for word in re.split(r"[,;\s×]+", text.strip(" ,;"))]
    except ValueError:
        raise ParameterError(f"{name_in_words(one.name)}: {text!r} is no number") from None
    whole = [int(number) if number.is_integer() else number for number in numbers]
    scalar = {int, float} & set(get_args(one.kind) or (one.kind,))
    lists = any(get_origin(kind) is tuple for kind in get_args(one.kind))
    return whole[0] if len(whole) == 1 and scalar else whole if lists else text


def _text(value: Any) -> str:
    if isinstance(value, tuple):
        return ", ".join(map(_text, value))
    return f"{value:.10g}" if isinstance(value, float) else "" if value is None else str(value)
