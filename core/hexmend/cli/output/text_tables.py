"""Small tables of the command line, drawn without a library: tabulate takes 0.04 s to load and removes indents.

The declaration of a method or of a generated mesh, as text.
"""

from __future__ import annotations

import shutil
import sys
from collections.abc import Mapping, Sequence
from textwrap import fill

from hexmend.parameters import declared
from hexmend.quality import METRICS, REGRESSION_KEYS, SUMMARY_QUANTITIES, MetricStatistics, Summary, regressions
from hexmend.quantity import format_count, format_quality
from hexmend.report.tables import Table
from hexmend.terminal_text import WorsenedText, printable, shows_colours

#: Characters of a line where standard output is no terminal, and has no width of its own.
_PIPE_WIDTH = 100

#: Characters between two columns.
_GAP = 3


def print_summaries(
    title: str, heads: Sequence[str], summaries: Sequence[Summary], target_q: tuple[float, float] | None = None
) -> None:
    """Print one or several summaries side by side; values worse than in the first are red on a terminal.

    Parameters
    ----------
    title : str
    heads : sequence of str
        Heads of the columns, one for each summary.
    summaries : sequence of Summary
    target_q : (float, float), optional
        Least q of the target before and after a run with one, which gets a row: with a target q(H) may well fall.
    """
    print(printable(title))
    columns = [
        (summary.to_dict(), {REGRESSION_KEYS.get(name) for name in regressions(summaries[0], summary, target_q)})
        for summary in summaries
    ]
    rows = [
        [
            f"  {figure.label}" if figure.part_of else figure.title,
            *((WorsenedText if figure.key in fallen else str)(figure.of(record)) for record, fallen in columns),
        ]
        for figure in SUMMARY_QUANTITIES.values()
    ]
    if target_q is not None:
        rows.append(["q of target min", *(format_quality(q) for q in target_q)])
    print_columns(["", *heads] if len(heads) > 1 else None, rows)


def print_kinds(cells: Mapping[str, Mapping[str, float | int]]) -> None:
    """Print a row for each kind of cells of `Summary.cells`; nothing for a mesh of hexes alone."""
    if set(cells) == {"hexahedron"}:
        return
    rows = [
        [
            kind,
            *(format_count(one[key]) for key in ("count", "inverted", "invalid")),
            *(format_quality(one[key]) for key in ("q_min", "q_mean", "scaled_jacobian_min")),
        ]
        for kind, one in cells.items()
    ]
    print_columns(["Cells", "Number", "Inverted", "Invalid", "q min", "q mean", "Scaled Jacobian min"], rows)


def print_spreads(spreads: Mapping[str, MetricStatistics]) -> None:
    """Print the range of every metric, and how many hexes have values outside the acceptable ones."""
    rows = []
    for name, spread in spreads.items():
        low, high = METRICS[name].acceptable
        values = ("–" if value is None else f"{value:.3g}" for value in (spread.min, spread.mean, spread.max))
        acceptable = f"{low:g} to {high:g}".replace("inf", "∞")
        rows.append([name, *values, acceptable, format_count(spread.unacceptable), format_count(spread.infinite)])
    print_columns(["Metric", "Min", "Mean", "Max", "Acceptable", "Outside", "Infinite"], rows)


def print_table(table: Table) -> None:
    """Print a table with its title and notes, split into parts one below the other on a narrow terminal."""
    width = shutil.get_terminal_size().columns if sys.stdout.isatty() else _PIPE_WIDTH
    print(table.title)
    for part in table.parts(width, _GAP):
        print_columns(part.head, part.rows)
    for note in table.notes:
        print(fill(note, width, break_long_words=False, break_on_hyphens=False))


def print_columns(head: Sequence[str] | None, rows: Sequence[Sequence[str]]) -> None:
    """Print rows in columns, the first aligned left and the others right, with a line below the head.

    On a terminal with colours a cell that is a `WorsenedText` is red.
    """
    red, reset = ("\x1b[31m", "\x1b[0m") if shows_colours() else ("", "")
    every = [*([head] if head else []), *rows]
    widths = [max(map(len, column)) for column in zip(*every, strict=True)]

    def painted(cell: str, width: int) -> str:
        return f"{red}{cell:>{width}}{reset}" if isinstance(cell, WorsenedText) else cell.rjust(width)

    def line(row: Sequence[str]) -> str:
        return "  " + (" " * _GAP).join([row[0].ljust(widths[0]), *map(painted, row[1:], widths[1:])])

    print()
    if head:
        print(line(head))
        print(" " + "─" * (len(line(head)) - 1))
    print("\n".join(map(line, rows)))
    print()


def print_parameters(name: str, kind: type) -> None:
    """Print title, source and help of a class, and a line for each parameter that it declares.

    Parameters
    ----------
    name : str
        Its name on the command line.
    kind : type
        A smoother or a generator of the gallery.
    """
    print(f"{name}: {kind.title} ({kind.source})\n    {kind.help}")
    for one in declared(kind):
        unit = f" {one.unit}" if one.unit else ""
        print(f"      {one.name} = {one.default}{unit}  ({one.range})  {one.help}")
    print()
