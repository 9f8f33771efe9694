"""Charts of the convergence of runs, one below the other with a common axis of iterations or seconds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from hexmend_app.report.charts import ChartStyle, add_legend

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Heights over the width of the figure: of title and axis, and of each chart.
_HEAD, _CHART = 0.16, 0.227

#: Dashes of the quantities of one chart, as matplotlib names them.
DASHES = ("-", "--", ":")


@dataclass(frozen=True)
class DrawnCurve:
    """One quantity of one run.

    Parameters
    ----------
    label, colour : str
    x, y : sequence of float
        NaN in y is a gap.
    dash : str
        One of `DASHES`.
    strong : bool
    part : str
        Text after the label, if a run has several curves.
    """

    label: str
    colour: str
    x: Sequence[float]
    y: Sequence[float]
    dash: str = "-"
    strong: bool = False
    part: str = ""


@dataclass(frozen=True)
class DrawnChart:
    """Curves with a common axis.

    Parameters
    ----------
    title : str
    curves : sequence of DrawnCurve
    log : bool
        Logarithmic axis, with zero below the powers of ten, unless all values lie within one power.
    whole : bool
        The values are counts.
    """

    title: str
    curves: Sequence[DrawnCurve]
    log: bool = False
    whole: bool = False


@dataclass(frozen=True)
class Convergence:
    """Charts one below the other.

    Parameters
    ----------
    charts : sequence of DrawnChart
        Charts without curves are left out, unless all are.
    title, xlabel : str
    whole : bool
        The values of the axis are counts.
    """

    charts: Sequence[DrawnChart]
    title: str
    xlabel: str
    whole: bool = True

    @property
    def names(self) -> list[str]:
        """Labels of the runs, each once."""
        return list(dict.fromkeys(curve.label for chart in self.charts for curve in chart.curves))

    def draw(self, style: ChartStyle) -> Figure:
        """Draw the figure.

        Raises
        ------
        HexmendError
            If matplotlib is not installed.
        """
        charts = [chart for chart in self.charts if chart.curves] or self.charts[:1]
        count = max(1, len(charts))
        figure = style.figure(_HEAD + _CHART * count)
        all_axes = figure.subplots(count, 1, sharex=True, squeeze=False)[:, 0]
        for axes, chart in zip(all_axes, charts, strict=False):
            _draw(axes, chart, style)
        all_axes[-1].xaxis.get_major_locator().set_params(integer=self.whole)
        all_axes[-1].set_xlabel(self.xlabel)
        figure.suptitle(style.heading(self.title))
        return figure


def _draw(axes: Axes, chart: DrawnChart, style: ChartStyle) -> None:
    named = []
    for curve in chart.curves:
        line: dict[str, Any] = {"linestyle": curve.dash, "linewidth": 1.8 if curve.strong else 1.0}
        name = style.name(curve.label) + (f" {curve.part}" if curve.part else "")
        named.append((axes.plot(curve.x, curve.y, color=curve.colour, **line)[0], name))
    known = [y for curve in chart.curves for y in curve.y if math.isfinite(y)]
    least = min((y for y in known if y > 0), default=math.inf)
    if chart.log and max(known, default=0) >= 10 * least:
        if min(known) > 0:
            axes.set_yscale("log")
        else:
            axes.set_yscale("symlog", linthresh=10 ** math.floor(math.log10(least)))
    elif chart.whole:
        axes.locator_params(axis="y", integer=True)
    axes.set_ylabel(chart.title)
    axes.grid(alpha=0.3)
    add_legend(axes, named)
