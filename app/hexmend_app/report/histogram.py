"""Chart of distributions: numbers of hexes by quality."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from hexmend_app.report.charts import ChartStyle, add_legend

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Height of the figure over its width.
_SHAPE = 0.6

#: Height of a broken bar over that of the tallest bin.
_BROKEN = 1.08


@dataclass(frozen=True)
class Outline:
    """One distribution.

    Parameters
    ----------
    label, colour : str
    heights : sequence of float
        Heights of the bins, which divide the interval from 0 to 1.
    bars : sequence of (left, right, height)
        Bars outside the bins; one that is taller than all bins is broken, with its number above.
    filled : bool
    note : str
        Text after the label, in brackets.
    """

    label: str
    colour: str
    heights: Sequence[float]
    bars: Sequence[tuple[float, float, float]] = ()
    filled: bool = False
    note: str = ""


@dataclass(frozen=True)
class Histogram:
    """Distributions with a common axis.

    Parameters
    ----------
    outlines : sequence of Outline
        The first is drawn at the bottom.
    title, xlabel, ylabel : str
    ticks : sequence of (place, text)
        Labels below the bins, which lie from 0 to 1, and below the bars.
    extent : (left, right)
        Range of the axis.
    log : bool
        Logarithmic heights.
    """

    outlines: Sequence[Outline]
    title: str
    xlabel: str
    ylabel: str
    ticks: Sequence[tuple[float, str]]
    extent: tuple[float, float]
    log: bool = False

    @property
    def names(self) -> list[str]:
        """Labels of the distributions, each once."""
        return list(dict.fromkeys(one.label for one in self.outlines))

    def draw(self, style: ChartStyle) -> Figure:
        """Draw the figure.

        Raises
        ------
        HexmendError
            If matplotlib is not installed.
        """
        figure = style.figure(_SHAPE)
        axes = figure.subplots()
        top = max((height for outline in self.outlines for height in outline.heights), default=0) or 1.0
        named = [_draw(axes, outline, top, style) for outline in self.outlines]
        drawn = [h for one in self.outlines for h in (*one.heights, *(bar[2] for bar in one.bars)) if h > 0]
        if self.log and drawn:
            axes.set(yscale="log", ylim=(0.8 * min(drawn), None))
        axes.set(xlim=self.extent, xlabel=self.xlabel, ylabel=self.ylabel, title=style.heading(self.title))
        axes.set_xticks([place for place, _ in self.ticks], [text for _, text in self.ticks])
        axes.grid(alpha=0.3)
        add_legend(axes, named)
        return figure


def _draw(axes: Axes, outline: Outline, top: float, style: ChartStyle) -> tuple[Artist, str]:
    """Draw one distribution; return its line and its name for the legend."""
    edges = [bin / len(outline.heights) for bin in range(len(outline.heights) + 1)]
    width = 1.0 if outline.filled else 1.6
    name = style.name(outline.label) + (f" ({outline.note})" if outline.note else "")
    if outline.filled:
        axes.stairs(outline.heights, edges, color=outline.colour, fill=True, alpha=0.35)
    line = axes.stairs(outline.heights, edges, color=outline.colour, linewidth=width)
    for left, right, height in outline.bars:
        fill: dict[str, Any] = {"facecolor": (outline.colour, 0.35 if outline.filled else 0.0)}
        end = _BROKEN * top if height > top else height
        axes.bar(left, end, right - left, align="edge", edgecolor=outline.colour, linewidth=width, **fill)
        if height > top:
            _break(axes, left, right, top, f"{height:,.0f}", outline.colour)
    return line, name


def _break(axes: Axes, left: float, right: float, top: float, number: str, colour: str) -> None:
    """Draw a zigzag across a bar that is too tall for the axis, and its number above it."""
    places = [left + (right - left) * k / 8 for k in range(9)]
    for wide, of in ((5.0, colour), (3.4, "white")):
        heights = [top * (0.90 if k % 2 else 0.93) for k in range(9)]
        axes.plot(places, heights, color=of, linewidth=wide, zorder=5, solid_capstyle="butt")
    above: dict[str, Any] = {"xytext": (0, 3), "textcoords": "offset points", "ha": "center", "fontsize": "small"}
    axes.annotate(number, ((left + right) / 2, _BROKEN * top), color=colour, **above)
