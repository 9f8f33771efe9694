"""Tables of results on the terminal, drawn by rich."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hexmend.cli.process.terminal import shows_colours
from hexmend.terminal_text import WorsenedText

if TYPE_CHECKING:
    from hexmend.report import Table


#: How what is worse than it was stands out.
_WORSE = "red"

#: Letters that rich puts around a cell's text.
_GAP = 3

#: A pipe has no width.
_PIPE = 240


def print_table(table: Table) -> None:
    """Print a table to standard output, in parts one below the other where the terminal is narrow."""
    from rich import box
    from rich.console import Console
    from rich.table import Table as Drawn
    from rich.text import Text

    console = Console(highlight=False, color_system="standard" if shows_colours() else None)
    if not console.is_terminal:
        console.width = _PIPE
    print(table.title)
    for part in table.parts(console.width, _GAP):
        drawn = Drawn(box=box.SIMPLE_HEAD)
        for column, head in enumerate(part.head):
            drawn.add_column(Text(head), justify="right" if column else "left", no_wrap=True)
        for row in part.rows:
            drawn.add_row(*(Text(cell, _WORSE if isinstance(cell, WorsenedText) else "") for cell in row))
        console.print(drawn)
    for note in table.notes:
        print(note)
