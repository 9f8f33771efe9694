"""Figures of a study, drawn by matplotlib: SVG for print, PNG for the screen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from hexmend.errors import HexmendError
from hexmend.io.atomic import replacing
from hexmend.io.suffixes import suffix_for

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Okabe and Ito's colours, which colour-blind readers can tell apart too.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
_MARKERS = "osD^vPX"


#: Inches that a figure is wide where nobody says, and its height by its width.
WIDTH, _HEIGHT = 7.5, 0.6

#: Where a broken bar ends, of the height of the tallest bin.
_BROKEN = 1.08

#: Kinds of figure that can be written.
FIGURE_SUFFIXES = (".svg", ".pdf", ".png")


def scaling(
    stem: Path,
    ours: Mapping[str, Sequence[tuple[int, float]]],
    thesis: Mapping[str, Sequence[tuple[int, float]]],
) -> list[Path]:
    """Figure 4.4: seconds per iteration against free nodes.

    Parameters
    ----------
    stem : Path
        Of the files, without suffix.
    ours, thesis : mapping
        (free nodes, seconds) by method; the thesis's are drawn pale and dashed.

    Raises
    ------
    HexmendError
        Where matplotlib is missing.
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
    return _saved(figure, stem)


def distributions(stem: Path, counts: Mapping[str, Sequence[int]], title: str) -> list[Path]:
    """Figure 4.9: how q(H) is distributed.

    Parameters
    ----------
    stem : Path
        Of the files, without suffix.
    counts : mapping
        Numbers of hexes in bins of equal width from 0 to 1, by what the curve is called.
    title : str

    Raises
    ------
    HexmendError
        Where matplotlib is missing.
    """
    figure, axes = _figure()
    for k, (label, numbers) in enumerate(counts.items()):
        edges = [bin / len(numbers) for bin in range(len(numbers) + 1)]
        axes.stairs(numbers, edges, color=COLOURS[k % len(COLOURS)], linewidth=1.6, label=label)
    axes.set(xlim=(0, 1), xlabel="q(H)", ylabel="hexes", title=title)
    axes.grid(alpha=0.3)
    axes.legend(loc="upper left", frameon=False)
    return _saved(figure, stem)


@dataclass(frozen=True)
class Outline:
    """A distribution as it is drawn.

    Parameters
    ----------
    label, colour : str
    heights : sequence of float
        Of the bins, which share the places from 0 to 1.
    bars : sequence of (left, right, height)
        What stands beside the bins; one that is taller than all bins is broken, and carries its number.
    filled : bool
    """

    label: str
    colour: str
    heights: Sequence[float]
    bars: Sequence[tuple[float, float, float]] = ()
    filled: bool = False


def write_histogram_figure(
    path: Path,
    outlines: Sequence[Outline],
    *,
    title: str,
    xlabel: str,
    ylabel: str,
    ticks: Sequence[tuple[float, str]],
    extent: tuple[float, float],
    log: bool = False,
    width: float = WIDTH,
) -> None:
    """Write one figure of distributions, as SVG, PDF or PNG by the path's suffix.

    Parameters
    ----------
    path : Path
    outlines : sequence of Outline
        The first is drawn at the bottom.
    title, xlabel, ylabel : str
    ticks : sequence of (place, text)
        Below the bins, which lie from 0 to 1, and below the bars beside them.
    extent : (left, right)
        Of the figure, in the same places.
    log : bool
        Heights by powers of ten.
    width : float
        Of the figure, in inches.

    Raises
    ------
    HexmendError
        For another suffix, and where matplotlib is missing or the file cannot be written.
    """
    check_figure(path)
    figure, axes = _figure(width)
    top = max((height for outline in outlines for height in outline.heights), default=0) or 1.0
    for outline in outlines:
        edges = [bin / len(outline.heights) for bin in range(len(outline.heights) + 1)]
        width = 1.0 if outline.filled else 1.6
        if outline.filled:
            axes.stairs(outline.heights, edges, color=outline.colour, fill=True, alpha=0.35)
        axes.stairs(outline.heights, edges, color=outline.colour, linewidth=width, label=outline.label)
        for left, right, height in outline.bars:
            fill = {"facecolor": (outline.colour, 0.35 if outline.filled else 0.0)}
            end = _BROKEN * top if height > top else height
            axes.bar(left, end, right - left, align="edge", edgecolor=outline.colour, linewidth=width, **fill)
            if height > top:
                _break(axes, left, right, top, f"{height:,.0f}", outline.colour)
    if log:
        drawn = [h for one in outlines for h in (*one.heights, *(bar[2] for bar in one.bars)) if h > 0]
        axes.set(yscale="log", ylim=(0.8 * min(drawn, default=1.0), None))
    axes.set(xlim=extent, xlabel=xlabel, ylabel=ylabel, title=title)
    axes.set_xticks([place for place, _ in ticks], [text for _, text in ticks])
    axes.grid(alpha=0.3)
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize="small")
    save_figure(figure, path)


def _break(axes: Axes, left: float, right: float, top: float, number: str, colour: str) -> None:
    """Break a bar that is too tall for the axis by a band of teeth, and write its number on it."""
    places = [left + (right - left) * k / 8 for k in range(9)]
    for wide, of in ((5.0, colour), (3.4, "white")):
        axes.plot(
            places,
            [top * (0.90 if k % 2 else 0.93) for k in range(9)],
            color=of,
            linewidth=wide,
            zorder=5,
            solid_capstyle="butt",
        )
    axes.annotate(
        number,
        ((left + right) / 2, _BROKEN * top),
        xytext=(0, 3),
        textcoords="offset points",
        ha="center",
        fontsize="small",
        color=colour,
    )


def check_figure(path: Path) -> None:
    """Raise `FileError` for a suffix that no figure has."""
    suffix_for(path, "a figure", FIGURE_SUFFIXES)


def new_figure(width: float, height: float) -> Figure:
    """An empty figure of so many inches.

    Raises
    ------
    HexmendError
        Where matplotlib is missing.
    """
    check_matplotlib()
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def check_matplotlib() -> None:
    """Raise `HexmendError` where matplotlib is missing."""
    try:
        import_module("matplotlib.figure")
    except ImportError:
        raise HexmendError(
            "figures need matplotlib, which is not installed: run  pip install 'hexmend[report]'"
        ) from None


def _figure(width: float = WIDTH) -> tuple[Figure, Axes]:
    figure = new_figure(width, _HEIGHT * width)
    return figure, figure.subplots()


def _saved(figure: Figure, stem: Path) -> list[Path]:
    paths = [stem.with_name(f"{stem.name}{suffix}") for suffix in (".svg", ".png")]
    for path in paths:
        save_figure(figure, path)
    return paths


def save_figure(figure: Figure, path: Path) -> None:
    """Write a figure as a whole or not at all, as its path's suffix says; equal figures make equal files."""
    from matplotlib import rc_context

    kind = path.suffix.lower()[1:]
    dates = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
    # Names that are not drawn by lot, no date, and texts that stay texts.
    with replacing(path) as temporary, rc_context({"svg.hashsalt": "hexmend", "svg.fonttype": "none"}):
        figure.savefig(temporary, dpi=160, format=kind, metadata=dates.get(kind))
