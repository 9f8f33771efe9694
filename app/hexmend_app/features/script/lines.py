"""Entries of a script and the imports that they need."""

from __future__ import annotations

import sys
from collections.abc import Callable, Collection
from dataclasses import fields
from pathlib import Path
from typing import Any

import hexmend
from hexmend import __version__
from hexmend.mesh.rules import MotionRules
from hexmend.parameters import Parametrised
from hexmend.report.charts import ChartStyle
from hexmend.run.recipe import Recipe, Stage
from hexmend_app.features.script.source_code import (
    WIDTH,
    comment_text,
    integers_source,
    multiline_source,
    rules_source,
    source_of,
)
from hexmend_app.picture import Scene, from_toml, to_toml

#: Appended to the comment of an entry that reads an overwritten file.
_OVERWRITTEN = ": the file was overwritten since, restore the original file first"


class ScriptLines:
    """Entries of a script, each a comment with Python source.

    Attributes
    ----------
    entries : list of str

    Parameters
    ----------
    on_change : callable
        Called after an entry was added and after the script was cleared.
    """

    def __init__(self, on_change: Callable[[], None]):
        self._on_change = on_change
        self.entries: list[str] = []
        self._imports: dict[str, set[str]] = {}  # imported names by module

    def put(self, title: str, source: str = "") -> None:
        """Add an entry; without source, only a comment."""
        text = comment_text(title)
        comment = f"# {text[:1].upper()}{text[1:]}"
        self.entries.append(f"{comment}\n{source}" if source else comment)
        self._on_change()

    def change(self, old: str, new: str) -> bool:
        """Replace a line; return True if it was found."""
        for at, entry in enumerate(self.entries):
            lines = entry.split("\n")
            if old in lines:
                self.entries[at] = "\n".join(new if line == old else line for line in lines)
                return True
        return False

    def mark_overwritten(self, path: Path, valid: Collection[str] = ()) -> None:
        """Mark the entries that read an overwritten file, except the lines `valid`, which match its new contents."""
        read = f"({str(path.absolute())!r})"
        for at, entry in enumerate(self.entries):
            comment, _, source = entry.partition("\n")
            if read in source and source not in valid and not comment.endswith(_OVERWRITTEN):
                self.entries[at] = f"{comment}{_OVERWRITTEN}\n{source}"

    def clear(self) -> None:
        """Remove all entries and imports."""
        self.entries.clear()
        self._imports.clear()
        self._on_change()

    def use(self, target: Callable[..., Any]) -> str:
        """Import a function or class in the script and return its name."""
        name, parts = target.__name__, target.__module__.split(".")
        if getattr(hexmend, name, None) is target:
            return f"hx.{name}"
        modules = (".".join(parts[:count]) for count in range(2, len(parts) + 1))
        module = next(one for one in modules if getattr(sys.modules[one], name, None) is target)
        self._imports.setdefault(module, set()).add(name)
        return name

    def source(self, value: Any) -> str:
        """Return the source of a value that is neither a mesh nor a run."""
        if isinstance(value, Path):
            return repr(str(value.absolute()))
        if isinstance(value, Scene):
            return f"{self.use(from_toml)}({multiline_source(to_toml(value))})"
        if isinstance(value, ChartStyle):
            default = ChartStyle()
            values = [(field.name, getattr(value, field.name)) for field in fields(value)]
            arguments = [f"{name}={it!r}" for name, it in values if it != getattr(default, name)]
            return f"{self.use(ChartStyle)}({', '.join(arguments)})"
        if isinstance(value, MotionRules):
            return rules_source(value)
        if isinstance(value, Recipe | Stage | Parametrised):
            return source_of(value)
        return integers_source(value) if getattr(value, "ndim", 0) else repr(value)

    def text(self, view: str = "") -> str:
        """Return the whole script, which `python FILE` runs, with the source of the view at its end."""
        body = "\n\n".join([*self.entries, *([view] if view else [])])
        head = [f'"""Script of a session of Hexmend {__version__}. To repeat it, run: python THIS-FILE."""', ""]
        if any("np.r_[" in one for one in self.entries):
            head += ["import numpy as np", ""]
        head.append("import hexmend as hx")
        for module in sorted(self._imports):
            head.append(f"from {module} import {', '.join(sorted(self._imports[module]))}")
        return "\n".join([*head, "", body, ""]) if body else "\n".join([*head, ""])


def call(function: str, arguments: list[str]) -> str:
    """Return the source of a call, with one argument per line if it does not fit into one line.

    >>> call("f", ["1", "b=2"])
    'f(1, b=2)'
    """
    one_line = f"{function}({', '.join(arguments)})"
    if len(one_line) <= WIDTH and "\n" not in one_line:
        return one_line
    lines = [text if '"""' in text else text.replace("\n", "\n    ") for text in arguments]  # strings are not indented
    return "\n".join([f"{function}(", *(f"    {line}," for line in lines), ")"])
