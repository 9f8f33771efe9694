"""Figures 4.4 and 4.9 of the thesis with our measurements, by matplotlib."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from hexmend_app.report.charts import COLOURS, new_figure, save_figure

_MARKERS = "osD^vPX"

#: Width and height of a figure in inches.
_SIZE = 7.5, 4.5


def scaling(
    path: Path, ours: Mapping[str, Sequence[tuple[int, float]]], thesis: Mapping[str, Sequence[tuple[int, float]]]
) -> None:
    """Draw Figure 4.4: seconds per iteration against free nodes.

    Parameters
    ----------
    path : Path
    ours, thesis : mapping
        (free nodes, seconds) by method; those of the thesis are drawn pale and dashed.
    """
    figure = new_figure(*_SIZE)
    axes = figure.subplots()
    for k, (method, points) in enumerate(ours.items()):
        colour, marker = COLOURS[k % len(COLOURS)], _MARKERS[k % len(_MARKERS)]
        axes.plot(*zip(*sorted(points), strict=True), color=colour, marker=marker, markersize=5, label=method)
        if thesis.get(method):
            x, y = zip(*sorted(thesis[method]), strict=True)
            axes.plot(x, y, color=colour, marker=marker, markersize=3, linestyle="--", alpha=0.45)
    axes.set(xscale="log", yscale="log", xlabel="free nodes", ylabel="seconds per iteration")
    axes.set_title("five-side: ours solid, the thesis's program dashed")
    axes.grid(which="major", alpha=0.3)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    save_figure(figure, path)


def distributions(path: Path, counts: Mapping[str, Sequence[int]], title: str) -> None:
    """Draw Figure 4.9: distributions of q(H).

    Parameters
    ----------
    path : Path
    counts : mapping
        Numbers of hexes in bins of equal width from 0 to 1, by the name of the curve.
    title : str
    """
    figure = new_figure(*_SIZE)
    axes = figure.subplots()
    for k, (label, numbers) in enumerate(counts.items()):
        edges = [bin / len(numbers) for bin in range(len(numbers) + 1)]
        axes.stairs(numbers, edges, color=COLOURS[k % len(COLOURS)], linewidth=1.6, label=label)
    axes.set(xlim=(0, 1), xlabel="q(H)", ylabel="hexes", title=title)
    axes.grid(alpha=0.3)
    axes.legend(loc="upper left", frameon=False)
    save_figure(figure, path)
