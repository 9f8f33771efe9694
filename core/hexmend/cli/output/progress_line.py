"""Line on standard error that changes in place: a spinner, a time or a bar, and a text."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import rich.progress

#: Characters of a bar.
_BAR_WIDTH = 24


def progress_line(template: str, *, bar: bool = False) -> rich.progress.Progress:
    """Make a line with a spinner, the elapsed time and a text; it is removed when it is stopped.

    Parameters
    ----------
    template : str
        The text, with fields of rich's task, such as `{task.description}`.
    bar : bool
        Show the share that is done as a bar in place of the elapsed time.
    """
    from rich.console import Console
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn
    from rich.table import Column

    text = Column(no_wrap=True, ratio=1)  # shortened on a narrow terminal
    return Progress(
        SpinnerColumn(table_column=Column(no_wrap=True)),
        BarColumn(_BAR_WIDTH) if bar else TimeElapsedColumn(table_column=Column(no_wrap=True)),
        TextColumn(template, markup=False, table_column=text),
        console=Console(stderr=True, highlight=False),
        expand=True,
        transient=True,
        redirect_stdout=sys.stdout.isatty(),  # else what is printed meanwhile would be written to stderr
    )
