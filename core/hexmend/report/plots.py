"""Figures of a study by matplotlib: SVG for print, PNG for the screen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from hexmend.report.charts import COLOURS, new_figure, save_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MARKERS = "osD^vPX"

#: Width of a figure in inches, and its height over its width.
_WIDTH, _HEIGHT = 7.5, 0.6

#: Formats of figures by default.
_FORMATS = ("svg", "png")


def scaling(
    stem: Path,
    ours: Mapping[str, Sequence[tuple[int, float]]],
    thesis: Mapping[str, Sequence[tuple[int, float]]],
    formats: Sequence[str] = _FORMATS,
) -> list[Path]:
    """Draw Figure 4.4: seconds per iteration against free nodes.

    Parameters
    ----------
    stem : Path
        Path of the files without suffix.
    ours, thesis : mapping
        (free nodes, seconds) by method; those of the thesis are drawn pale and dashed.
    formats : sequence of str
        Suffixes without the dot; one file is written for each.

    Raises
    ------
    HexmendError
        If matplotlib is not installed.
    """
    figure, axes = _figure()
    for k, (method, points) in enumerate(ours.items()):
        colour, marker = COLOURS[k % len(COLOURS)], _MARKERS[k % len(_MARKERS)]
        axes.plot(*zip(*sorted(points), strict=True), color=colour, marker=marker, markersize=5, label=method)
        if thesis.get(method):
            pale = {"color": colour, "marker": marker, "markersize": 3, "linestyle": "--", "alpha": 0.45}
            axes.plot(*zip(*sorted(thesis[method]), strict=True), **pale)
    axes.set(xscale="log", yscale="log", xlabel="free nodes", ylabel="seconds per iteration")
    axes.set_title("five-side: ours solid, the thesis's program dashed")
    axes.grid(which="major", alpha=0.3)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    return _saved(figure, stem, formats)


def distributions(
    stem: Path, counts: Mapping[str, Sequence[int]], title: str, formats: Sequence[str] = _FORMATS
) -> list[Path]:
    """Draw Figure 4.9: distributions of q(H).

    Parameters
    ----------
    stem : Path
        Path of the files without suffix.
    counts : mapping
        Numbers of hexes in bins of equal width from 0 to 1, by the name of the curve.
    title : str
    formats : sequence of str
        Suffixes without the dot; one file is written for each.

    Raises
    ------
    HexmendError
        If matplotlib is not installed.
    """
    figure, axes = _figure()
    for k, (label, numbers) in enumerate(counts.items()):
        edges = [bin / len(numbers) for bin in range(len(numbers) + 1)]
        axes.stairs(numbers, edges, color=COLOURS[k % len(COLOURS)], linewidth=1.6, label=label)
    axes.set(xlim=(0, 1), xlabel="q(H)", ylabel="hexes", title=title)
    axes.grid(alpha=0.3)
    axes.legend(loc="upper left", frameon=False)
    return _saved(figure, stem, formats)


def _figure() -> tuple[Figure, Axes]:
    figure = new_figure(_WIDTH, _HEIGHT * _WIDTH)
    return figure, figure.subplots()


def _saved(figure: Figure, stem: Path, formats: Sequence[str]) -> list[Path]:
    paths = [stem.with_name(f"{stem.name}.{suffix}") for suffix in formats]
    for path in paths:
        save_figure(figure, path)
    return paths
