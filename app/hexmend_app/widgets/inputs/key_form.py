"""Form built from the keys of a table."""

from __future__ import annotations

import inspect
import re
from collections.abc import Sequence
from dataclasses import is_dataclass, replace
from enum import StrEnum
from functools import cache
from typing import Any

from PySide6.QtWidgets import QWidget

from hexmend.errors import ParameterError
from hexmend.parameters import Parameter
from hexmend_app.codec.conversion import ConfigTable, parse_value
from hexmend_app.codec.option import Option, options_of
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.editors import Text
from hexmend_app.widgets.inputs.parameter_form import ParameterForm


class KeyForm(ParameterForm):
    """Form that edits some keys of a table, one row each; an empty text stands for the default.

    Parameters
    ----------
    table : ConfigTable
        Initial values.
    names : sequence of str
        Fields to edit.
    """

    def __init__(self, table: ConfigTable, names: Sequence[str], parent: QWidget | None = None):
        self._kind = type(table)
        kind: Any = self._kind  # as a value, which mypy takes to be hashable
        options = {option.field: option for option in options_of(kind)}
        self._keys = {name: options[name] for name in names}
        texts = helps(kind)
        super().__init__([_declaration(self._keys[name], texts[name]) for name in names], has_buttons=False)
        for name, editor in self.editors.items():
            if isinstance(editor, Text):
                default = self._keys[name].default
                editor.setPlaceholderText(tr("automatic") if default in (None, "") else _text(default))
        self.show_table(table)

    def show_table(self, table: ConfigTable) -> None:
        """Show the values of a table, without a signal."""
        values = {name: getattr(table, name) for name in self.editors}
        texts = {name for name, editor in self.editors.items() if isinstance(editor, Text)}
        self.set_values({name: _text(value) if name in texts else value for name, value in values.items()})

    def table(self, base: ConfigTable) -> ConfigTable:
        """Return a copy of `base` with the values of the form.

        Raises
        ------
        ParameterError
            If a value is invalid.
        """
        values = {}
        for name, editor in self.editors.items():
            if editor.problem:
                raise ParameterError(editor.problem)
            values[name] = _read(self._keys[name], editor.value()) if isinstance(editor, Text) else editor.value()
        return replace(base, **values)

    def problem_text(self) -> str:
        """Return the problem of the values, each and together; "" if there is none."""
        try:
            self.table(self._kind())
            return ""
        except ParameterError as error:
            return str(error)


def _declaration(option: Option, help: str) -> Parameter:
    """Return a key as a declared parameter; a list, or a number that may be left out, is edited as text."""
    kind, name = option.kind, option.name
    if kind in (bool, int, float):
        return Parameter(name, kind, option.default, option.low, option.high, unit=option.unit, help=help)
    if option.offered:
        return Parameter(name, str, option.default, help=help, suggestions=option.offered)
    if isinstance(kind, type) and issubclass(kind, StrEnum):
        return Parameter(name, str, option.default.value, choices=tuple(kind), titles=option.titles, help=help)
    return Parameter(name, str, "", unit=option.unit, help=help)


def _read(option: Option, text: str) -> Any:
    """Return the value of a text; the default of an empty text."""
    text = text.strip()
    return text or option.default if not text or option.kind is str else parse_value(text)


def _text(value: Any) -> str:
    if isinstance(value, tuple):
        return ", ".join(map(_text, value))
    return f"{value:.10g}" if isinstance(value, float) else "" if value is None else str(value)


@cache
def helps(kind: type) -> dict[str, str]:
    """Return the descriptions of the parameters of a class by name, from its NumPy docstring.

    >>> from hexmend_app.picture import WipeLayout
    >>> helps(WipeLayout)["mesh"]
    'Number of the mesh on the command line, from 1.'
    """
    inherited = helps(kind.__base__) if is_dataclass(kind.__base__) else {}
    lines = inspect.getdoc(kind).splitlines()
    texts: dict[str, str] = {}
    names: list[str] = []
    for line in lines[lines.index("Parameters") + 2 :] if "Parameters" in lines else ():
        head = re.fullmatch(r"(\w[\w,\s]*?)(?:\s:\s.*)?", line)
        if head and not line.startswith(" "):
            names = head[1].split(", ")
        elif line.startswith("    "):
            for name in names:
                texts[name] = f"{texts.get(name, '')} {line.strip()}".strip()
    return inherited | texts
