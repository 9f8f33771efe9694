"""Tables of results on the terminal, drawn by rich."""

from __future__ import annotations

from textwrap import fill
from typing import TYPE_CHECKING

from hexmend.cli.process.terminal import shows_colours
from hexmend.terminal_text import WorsenedText

if TYPE_CHECKING:
    from hexmend.report.tables import Table


#: Style of values that are worse than before.
_WORSE_STYLE = "red"

#: Characters that rich puts around a cell's text.
_PADDING = 3

#: Characters of a line where standard output is no terminal, and has no width of its own.
_PIPE_WIDTH = 100


def print_table(table: Table) -> None:
    """Print a table to standard output, split into parts one below the other on a narrow terminal."""
    from rich import box
    from rich.console import Console
    from rich.table import Table as RichTable
    from rich.text import Text

    console = Console(highlight=False, color_system="standard" if shows_colours() else None)
    if not console.is_terminal:
        console.width = _PIPE_WIDTH
    print(table.title)
    for part in table.parts(console.width, _PADDING):
        rich_table = RichTable(box=box.SIMPLE_HEAD)
        for column, head in enumerate(part.head):
            rich_table.add_column(Text(head), justify="right" if column else "left", no_wrap=True)
        for row in part.rows:
            rich_table.add_row(*(Text(cell, _WORSE_STYLE if isinstance(cell, WorsenedText) else "") for cell in row))
        console.print(rich_table)
    for note in table.notes:
        print(fill(note, console.width, break_long_words=False, break_on_hyphens=False))
