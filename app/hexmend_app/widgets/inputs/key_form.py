"""Form built from the keys of a table."""

from __future__ import annotations

import inspect
import re
from collections.abc import Sequence
from dataclasses import replace
from enum import StrEnum
from functools import cache
from typing import Any

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFormLayout, QWidget

from hexmend.errors import ParameterError
from hexmend.parameters import Parameter
from hexmend_app.codec.config_table import ConfigTable
from hexmend_app.codec.option import Option, options_of
from hexmend_app.codec.value_text import parse_value
from hexmend_app.theme.palette import WORSE
from hexmend_app.theme.spacing import on_grid
from hexmend_app.theme.style import labelled, note, set_help, show_text
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.editors import Text, editor_for
from hexmend_app.widgets.wording import name_in_words


class KeyForm(QWidget):
    """Form that edits some keys of a table, one row each; an empty text stands for the default.

    Parameters
    ----------
    table : ConfigTable
        Initial values.
    names : sequence of str
        Fields to edit.

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
        self._keys = {option.field: option for option in options_of(type(table)) if option.field in names}  # type: ignore[arg-type]
        self.editors: dict[str, Any] = {}
        layout = on_grid(QFormLayout(self))
        layout.setContentsMargins(0, 0, 0, 0)
        for name in names:
            option = self._keys[name]
            editor = self.editors[name] = _editor(option)
            editor.changed.connect(self._on_changed)
            title = tr(name_in_words(option.name)) + (f" ({tr(option.unit)})" if option.unit else "")
            set_help(editor, title, tr(helps(self._kind)[name]))  # type: ignore[arg-type]
            layout.addRow(labelled(title, editor), editor)
        self._problem = note("", WORSE)
        self._problem.hide()
        layout.addRow(self._problem)
        self.show_table(table)

    def show_table(self, table: ConfigTable) -> None:
        """Show the values of a table, without a signal."""
        for name, editor in self.editors.items():
            value = getattr(table, name)
            editor.set_value(_text(value) if isinstance(editor, Text) else value)
        show_text(self._problem, "")

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

    def _on_changed(self) -> None:
        try:
            self.table(self._kind())
            show_text(self._problem, "")
        except ParameterError as error:
            show_text(self._problem, str(error))
        self.changed.emit()


def _editor(option: Option) -> Any:
    kind, name = option.kind, option.name
    if kind is bool or kind in (int, float):
        return editor_for(Parameter(name, kind, option.default, option.low, option.high, None, "", ""))
    if option.offered:
        return editor_for(Parameter(name, str, option.default, None, None, None, "", "", suggestions=option.offered))
    if isinstance(kind, type) and issubclass(kind, StrEnum):
        return editor_for(Parameter(name, str, option.default.value, None, None, tuple(kind), "", ""))
    editor: Any = editor_for(Parameter(name, str, "", None, None, None, "", ""))
    editor.setPlaceholderText(tr("automatic") if option.default in (None, "") else _text(option.default))
    return editor


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
    return texts
