"""Description of a histogram, and its drawing for print."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from hexmend_app.report.charts import ChartStyle, add_legend
from hexmend_app.theme.palette import INVERTED
from hexmend_app.translation import tr

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Height of the figure over its width.
_SHAPE = 0.6

#: Height of the axis over the tallest bin.
_HEADROOM = 1.15


@dataclass(frozen=True, eq=False)
class Series:
    """One distribution.

    Parameters
    ----------
    name, colour : str
        The colour is #rrggbb.
    counts : sequence of float
        Heights of the bins; bin k spans k to k + 1.
    inverted : float
        Height of the column of inverted hexes.
    filled : bool
        True for bars, False for an outline.
    colours : sequence of str
        Colours of the bars, #rrggbb; by default `colour`.
    note : str
        Text after the name in a printed legend.
    """

    name: str
    colour: str
    counts: Sequence[float]
    inverted: float = 0
    filled: bool = False
    colours: Sequence[str] = ()
    note: str = ""


@dataclass(frozen=True, eq=False)
class Histogram:
    """Distributions with a common axis, and a column of inverted hexes left of the bins if there are any.

    The heights fit the bins; a taller column of inverted hexes is cut off at their upper end.

    Parameters
    ----------
    series : sequence of Series
        The first is drawn at the bottom.
    title, xlabel, ylabel : str
    ticks : sequence of (position, text)
        Positions are counted in bins.
    log : bool
        Logarithmic heights.
    """

    series: Sequence[Series]
    title: str
    xlabel: str
    ylabel: str
    ticks: Sequence[tuple[float, str]]
    log: bool = False

    @property
    def names(self) -> list[str]:
        """Names of the distributions, each once."""
        return list(dict.fromkeys(one.name for one in self.series))

    @property
    def bins(self) -> int:
        """Number of bins."""
        return max((len(one.counts) for one in self.series), default=1)

    @property
    def column(self) -> tuple[float, float] | None:
        """Left and right end of the column of inverted hexes; None without inverted hexes."""
        return (-0.11 * self.bins, -0.05 * self.bins) if any(one.inverted for one in self.series) else None

    @property
    def extent(self) -> tuple[float, float]:
        """Left and right end of the plot."""
        return (self.column or (0.0, 0.0))[0] - 0.02 * self.bins, 1.02 * self.bins

    @property
    def heights(self) -> tuple[float, float]:
        """Lower and upper end of the heights."""
        bins = [height for one in self.series for height in one.counts if height > 0]
        columns = [one.inverted for one in self.series if one.inverted]
        top = max(bins or columns, default=1.0)
        if not self.log:
            return 0.0, _HEADROOM * top
        floor = 0.5 * min([1.0, *bins, *columns])
        return floor, floor * (top / floor) ** _HEADROOM

    def steps(self, series: Series) -> tuple[np.ndarray, np.ndarray]:
        """Return the ends of the steps of a series, (k + 1,) float64, and their heights, (k,) float64.

        They are the bins, and left of them the column of inverted hexes and a step of height 0.
        """
        edges, heights = np.arange(len(series.counts) + 1.0), np.asarray(series.counts, dtype=float)
        if self.column is None:
            return edges, heights
        return np.concatenate([self.column, edges]), np.concatenate([[series.inverted, 0.0], heights])

    def step_colours(self, series: Series) -> list[str]:
        """Return the colours of the steps of a series, #rrggbb."""
        colours = list(series.colours) or [series.colour] * len(series.counts)
        return colours if self.column is None else [INVERTED, series.colour, *colours]

    def draw(self, style: ChartStyle) -> Figure:
        """Draw the figure.

        Raises
        ------
        HexmendError
            If matplotlib is not installed.
        """
        figure = style.figure(_SHAPE)
        axes = figure.subplots()
        add_legend(axes, draw_histogram(axes, self, style.name))
        axes.set_title(style.heading(self.title))
        return figure


def draw_histogram(axes: Axes, histogram: Histogram, name: Callable[[str], str] = str) -> list[tuple[Artist, str]]:
    """Draw a histogram with matplotlib, without title and legend.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    histogram : Histogram
    name : callable
        Returns the printed name of a series.

    Returns
    -------
    list of (Artist, str)
        The line of each series, and its text in a legend.
    """
    (floor, top), column = histogram.heights, histogram.column
    named: list[tuple[Artist, str]] = []
    for one in histogram.series:
        edges, heights = histogram.steps(one)
        if one.filled:
            bars: dict[str, Any] = {"align": "edge", "bottom": floor, "alpha": 1.0 if one.colours else 0.35}
            above = np.maximum(heights - floor, 0)
            axes.bar(edges[:-1], above, np.diff(edges), color=histogram.step_colours(one), **bars)
        line = axes.stairs(heights, edges, baseline=floor, color=one.colour, linewidth=1.0 if one.filled else 1.6)
        named.append((line, name(one.name) + (f" ({one.note})" if one.note else "")))
    if histogram.log:
        axes.set_yscale("log")
    ticks = [*([] if column is None else [(column[1], tr("inverted"))]), *histogram.ticks]
    axes.set_xticks([position for position, _ in ticks], [text for _, text in ticks])
    if column is not None:
        axes.get_xticklabels()[0].set_horizontalalignment("right")  # clear of the next text
    axes.set(xlim=histogram.extent, ylim=(floor, top), xlabel=histogram.xlabel, ylabel=histogram.ylabel)
    axes.grid(alpha=0.3)
    return named
