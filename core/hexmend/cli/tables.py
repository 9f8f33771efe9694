"""Tables of the command line, drawn by rich."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hexmend.quality import Spread, Summary

#: Rows of a summary: field, label.
ROWS = (
    ("hexes", "Hexes"),
    ("nodes", "Nodes"),
    ("free_nodes", "Free nodes"),
    ("inverted", "Inverted hexes"),
    ("locked_inverted", "  locked by fixed nodes"),
    ("q_min", "q min"),
    ("q_mean", "q mean"),
    ("q_max", "q max"),
    ("q_std", "q std"),
    ("q_norm", "q norm"),
    ("scaled_jacobian_min", "Scaled Jacobian min"),
    ("objective", "Objective Σ η²"),
)


def figure(value: float | int | None) -> str:
    """A figure as people read it: thousands in commas, four places, a dash for what is infinite."""
    if value is None:
        return "–"
    if isinstance(value, int):
        return f"{value:,}"
    return f"{value:.4f}" if abs(value) < 1e4 else f"{value:.6g}"


def print_summaries(title: str, heads: Sequence[str], summaries: Sequence[Summary]) -> None:
    """Print one or several summaries side by side."""
    from rich import box
    from rich.console import Console
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD, show_header=len(heads) > 1)
    table.add_column("")
    for head in heads:
        table.add_column(head, justify="right")
    for field, label in ROWS:
        table.add_row(label, *(figure(getattr(summary, field)) for summary in summaries))
    print(title)
    Console(highlight=False).print(table)


def print_spreads(spreads: Mapping[str, Spread]) -> None:
    """Print what every metric's values are, and how many hexes have one that is not acceptable."""
    from rich import box
    from rich.console import Console
    from rich.table import Table

    from hexmend.quality import METRICS

    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False)
    table.add_column("Metric", no_wrap=True)
    for head in ("Min", "Mean", "Max", "Acceptable", "Outside", "Infinite"):
        table.add_column(head, justify="right", no_wrap=True)
    for name, spread in spreads.items():
        low, high = METRICS[name].acceptable
        values = ("–" if value is None else f"{value:.3g}" for value in (spread.min, spread.mean, spread.max))
        acceptable = f"{low:g} to {high:g}".replace("inf", "∞")
        table.add_row(name, *values, acceptable, figure(spread.unacceptable), figure(spread.infinite))
    Console(highlight=False).print(table)
