"""The lines of a script as they come, with the imports that they need."""

from __future__ import annotations

import sys
from collections.abc import Callable, Collection
from dataclasses import fields
from pathlib import Path
from typing import Any

import hexmend
from hexmend import __version__
from hexmend.parameters import Parametrised
from hexmend.report.charts import ChartStyle
from hexmend.run.recipe import Recipe, Stage
from hexmend_app.features.script.source_code import WIDTH, comment_of, lines_of, made, numbers
from hexmend_app.picture import Scene, from_toml, to_toml

#: Said of what reads a file that was written to since.
_OVERWRITTEN = ": the file was overwritten since, put it back as it was first"


class ScriptLines:
    """Entries of the script, each a comment with Python source.

    Attributes
    ----------
    entries : list of str

    Parameters
    ----------
    told : callable
        Called as there is another entry.
    """

    def __init__(self, reported: Callable[[], None]):
        self._report = reported
        self.entries: list[str] = []
        self._imports: dict[str, set[str]] = {}  # names by the module that has them

    def put(self, title: str, source: str = "") -> None:
        """Add an entry; without source, a comment alone."""
        words = comment_of(title)
        comment = f"# {words[:1].upper()}{words[1:]}"
        self.entries.append(f"{comment}\n{source}" if source else comment)
        self._report()

    def change(self, old: str, new: str) -> bool:
        """Let a line be another; whether it was there."""
        for at, entry in enumerate(self.entries):
            lines = entry.split("\n")
            if old in lines:
                self.entries[at] = "\n".join(new if line == old else line for line in lines)
                return True
        return False

    def overwritten(self, path: Path, kept: Collection[str] = ()) -> None:
        """Say of what reads a file that it is another now, but for some lines that read it as it is."""
        read = f"({str(path.absolute())!r})"
        for at, entry in enumerate(self.entries):
            comment, _, source = entry.partition("\n")
            if read in source and source not in kept and not comment.endswith(_OVERWRITTEN):
                self.entries[at] = f"{comment}{_OVERWRITTEN}\n{source}"

    def clear(self) -> None:
        """Forget all."""
        self.entries.clear()
        self._imports.clear()
        self._report()

    def use(self, subject: Callable[..., Any]) -> str:
        """Import a function or class in the script and return its name."""
        name, parts = subject.__name__, subject.__module__.split(".")
        if getattr(hexmend, name, None) is subject:
            return f"hx.{name}"
        homes = (".".join(parts[:count]) for count in range(2, len(parts) + 1))
        home = next(one for one in homes if getattr(sys.modules[one], name, None) is subject)
        self._imports.setdefault(home, set()).add(name)
        return name

    def source(self, value: Any) -> str:
        """Return the source of a value that is neither a mesh nor a run."""
        if isinstance(value, Path):
            return repr(str(value.absolute()))
        if isinstance(value, Scene):
            return f"{self.use(from_toml)}({lines_of(to_toml(value))})"
        if isinstance(value, ChartStyle):
            usual = ChartStyle()
            own = [(one.name, getattr(value, one.name)) for one in fields(value)]
            words = [f"{name}={it!r}" for name, it in own if it != getattr(usual, name)]
            return f"{self.use(ChartStyle)}({', '.join(words)})"
        if isinstance(value, Recipe | Stage | Parametrised):
            return made(value)
        return numbers(value) if getattr(value, "ndim", 0) else repr(value)

    def text(self, seen: str = "") -> str:
        """All of it, to be run by `python FILE`, with what is `seen` at its end."""
        body = "\n\n".join([*self.entries, *([seen] if seen else [])])
        head = [f'"""What was done in the window of Hexmend {__version__}, to be done again: python THIS-FILE."""', ""]
        if any("np.r_[" in one for one in self.entries):
            head += ["import numpy as np", ""]
        head.append("import hexmend as hx")
        for home in sorted(self._imports):
            head.append(f"from {home} import {', '.join(sorted(self._imports[home]))}")
        return "\n".join([*head, "", body, ""]) if body else "\n".join([*head, ""])


def call(function: str, arguments: list[str]) -> str:
    """A call, an argument a line where they do not fit into one.

    >>> call("f", ["1", "b=2"])
    'f(1, b=2)'
    """
    short = f"{function}({', '.join(arguments)})"
    if len(short) <= WIDTH and "\n" not in short:
        return short
    lines = [one if '"""' in one else one.replace("\n", "\n    ") for one in arguments]  # texts stay as they are
    return "\n".join([f"{function}(", *(f"    {one}," for one in lines), ")"])
