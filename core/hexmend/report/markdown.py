"""Tables as Markdown. tabulate is not used: a pipe in a cell, such as in a file's name, breaks its tables."""

from __future__ import annotations

import re

from hexmend.report.tables import Table


def markdown(table: Table) -> str:
    """The table in pipes, labels to the left and figures to the right, its title bold above it.

    >>> print(markdown(Table("Cube", ["", "a|b"], [["q min", "1.0000"]])), end="")
    **Cube**
    <BLANKLINE>
    |  | a\\|b |
    |:---|---:|
    | q min | 1.0000 |
    """
    lines = [table.head, *table.rows]
    drawn = ["| " + " | ".join(escape(cell) for cell in line) + " |" for line in lines]
    drawn.insert(1, "|:---" + "|---:" * (len(table.head) - 1) + "|")
    notes = "".join(f"\n{escape(note)}\n" for note in table.notes)
    title = f"**{escape(table.title)}**\n\n" if table.title else ""
    return title + "\n".join(drawn) + "\n" + notes


def escape(text: str) -> str:
    """Text in which nothing is markup: file names and messages may hold anything."""
    return re.sub(r"([\\`*_{}\[\]<>#|])", r"\\\1", " ".join(text.split()))
