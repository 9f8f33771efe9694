"""Small tables of the command line, drawn without a library: loading one takes longer than most commands do."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hexmend.quality import Spread, Summary


def print_summaries(title: str, heads: Sequence[str], summaries: Sequence[Summary]) -> None:
    """Print one or several summaries side by side."""
    from hexmend.quality import FIGURES

    print(title)
    records = [summary.to_dict() for summary in summaries]
    rows = [
        [f"  {figure.label}" if figure.part_of else figure.title, *(figure.of(record) for record in records)]
        for figure in FIGURES.values()
    ]
    print_columns(["", *heads] if len(heads) > 1 else None, rows)


def print_spreads(spreads: Mapping[str, Spread]) -> None:
    """Print what every metric's values are, and how many hexes have one that is not acceptable."""
    from hexmend.figures import count
    from hexmend.quality import METRICS

    rows = []
    for name, spread in spreads.items():
        low, high = METRICS[name].acceptable
        values = ("–" if value is None else f"{value:.3g}" for value in (spread.min, spread.mean, spread.max))
        acceptable = f"{low:g} to {high:g}".replace("inf", "∞")
        rows.append([name, *values, acceptable, count(spread.unacceptable), count(spread.infinite)])
    print_columns(["Metric", "Min", "Mean", "Max", "Acceptable", "Outside", "Infinite"], rows)


def print_columns(head: Sequence[str] | None, rows: Sequence[Sequence[str]]) -> None:
    """Print rows in columns, the first from the left and the others from the right, with a line below the head."""
    every = [*([head] if head else []), *rows]
    widths = [max(map(len, column)) for column in zip(*every, strict=True)]

    def line(row: Sequence[str]) -> str:
        cells = (cell.rjust(width) for cell, width in zip(row[1:], widths[1:], strict=True))
        return "  " + "   ".join([row[0].ljust(widths[0]), *cells])

    print()
    if head:
        print(line(head))
        print(" " + "─" * (len(line(head)) - 1))
    print("\n".join(map(line, rows)))
    print()
