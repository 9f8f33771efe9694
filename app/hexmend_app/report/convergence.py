"""Description of line charts, and their drawing for print: one below the other with a common axis."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from hexmend_app.report.charts import ChartStyle, add_legend

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Heights over the width of the figure: of title and axis, and of each chart.
_HEAD, _CHART = 0.16, 0.227

#: Dashes of the quantities of one chart, as matplotlib names them.
DASHES = ("-", "--", ":")


@dataclass(frozen=True, eq=False)
class Line:
    """One quantity of one run.

    Parameters
    ----------
    label, colour : str
    x, y : sequence of float
        NaN is a gap.
    dash : str
        One of `DASHES`.
    strong : bool
    part : str
        Text after the label, if a run has several lines.
    """

    label: str
    colour: str
    x: Sequence[float] | np.ndarray
    y: Sequence[float] | np.ndarray
    dash: str = "-"
    strong: bool = False
    part: str = ""


@dataclass(frozen=True, eq=False)
class LineChart:
    """Lines with a common axis.

    Parameters
    ----------
    title : str
    lines : sequence of Line
    log : bool
        Logarithmic axis, with zero below the powers of ten.
    whole : bool
        The values are counts.
    """

    title: str
    lines: Sequence[Line]
    log: bool = False
    whole: bool = False

    @property
    def values(self) -> np.ndarray:
        """All finite values, (k,) float64."""
        values = np.concatenate([np.asarray(line.y, dtype=float) for line in self.lines] or [np.empty(0)])
        return values[np.isfinite(values)]


@dataclass(frozen=True, eq=False)
class Convergence:
    """Charts one below the other.

    Parameters
    ----------
    charts : sequence of LineChart
        Charts without lines are left out, unless all are.
    title, xlabel : str
    whole : bool
        The values of the axis are counts.
    """

    charts: Sequence[LineChart]
    title: str
    xlabel: str
    whole: bool = True

    @property
    def names(self) -> list[str]:
        """Labels of the runs, each once."""
        return list(dict.fromkeys(line.label for chart in self.charts for line in chart.lines))

    def draw(self, style: ChartStyle) -> Figure:
        """Draw the figure.

        Raises
        ------
        HexmendError
            If matplotlib is not installed.
        """
        charts = [chart for chart in self.charts if chart.lines] or self.charts[:1]
        count = max(1, len(charts))
        figure = style.figure(_HEAD + _CHART * count)
        all_axes = figure.subplots(count, 1, sharex=True, squeeze=False)[:, 0]
        for axes, chart in zip(all_axes, charts, strict=False):
            _draw(axes, chart, style)
        all_axes[-1].xaxis.get_major_locator().set_params(integer=self.whole)
        all_axes[-1].set_xlabel(self.xlabel)
        figure.suptitle(style.heading(self.title))
        return figure


def _draw(axes: Axes, chart: LineChart, style: ChartStyle) -> None:
    """Draw a chart; it has a logarithmic axis only if its values span a power of ten."""
    named = []
    for line in chart.lines:
        name = style.name(line.label) + (f" {line.part}" if line.part else "")
        width = 1.8 if line.strong else 1.0
        named.append((axes.plot(line.x, line.y, color=line.colour, linestyle=line.dash, linewidth=width)[0], name))
    values = chart.values
    least = float(values[values > 0].min(initial=math.inf))
    if chart.log and values.max(initial=0) >= 10 * least:
        if values.min() > 0:
            axes.set_yscale("log")
        else:
            axes.set_yscale("symlog", linthresh=10 ** math.floor(math.log10(least)))
    elif chart.whole:
        axes.locator_params(axis="y", integer=True)
    axes.set_ylabel(chart.title)
    axes.grid(alpha=0.3)
    add_legend(axes, named)
