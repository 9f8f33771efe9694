"""Tables as Markdown. tabulate is not used: a pipe in a cell, such as in a file's name, breaks its tables."""

from __future__ import annotations

import re

from hexmend.report.tables import Table
from hexmend.terminal_text import FailedText, ShortestText


def markdown(table: Table) -> str:
    """Write a table as Markdown, the labels aligned left and the figures right, with the title above.

    >>> print(markdown(Table("Cube", ["", "a|b"], [["q min", "1.0000"]])), end="")
    **Cube**
    <BLANKLINE>
    |  | a\\|b |
    |:---|---:|
    | q min | 1.0000 |
    """
    lines = [table.head, *table.rows]
    drawn = ["| " + " | ".join(_emphasised(cell) for cell in line) + " |" for line in lines]
    drawn.insert(1, "|:---" + "|---:" * (len(table.head) - 1) + "|")
    notes = "".join(f"\n{escape(note)}\n" for note in table.notes)
    title = f"**{escape(table.title)}**\n\n" if table.title else ""
    return title + "\n".join(drawn) + "\n" + notes


def _emphasised(cell: str) -> str:
    """Escape the text of a cell, with marks of what it stands for."""
    mark = "**" if isinstance(cell, ShortestText) else "*" if isinstance(cell, FailedText) else ""
    return f"{mark}{escape(cell)}{mark}"


def escape(text: str) -> str:
    """Escape a text, so that Markdown finds no markup in it."""
    return re.sub(r"([\\`*_{}\[\]<>#|])", r"\\\1", " ".join(text.split()))
