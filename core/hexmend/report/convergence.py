"""Figures of how runs converge: charts below one another with one axis of iterations or seconds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from hexmend.report.plots import WIDTH, check_figure, new_figure, save_figure


@dataclass(frozen=True)
class DrawnCurve:
    """A figure of one run.

    Parameters
    ----------
    label, colour : str
    x, y : sequence of float
        nan in y is a gap.
    dashed, strong : bool
    """

    label: str
    colour: str
    x: Sequence[float]
    y: Sequence[float]
    dashed: bool = False
    strong: bool = False


@dataclass(frozen=True)
class DrawnChart:
    """Curves with one axis.

    Parameters
    ----------
    title : str
    curves : sequence of DrawnCurve
    log : bool
        The axis goes by powers of ten, with zero below them.
    whole : bool
        The figures are counts.
    """

    title: str
    curves: Sequence[DrawnCurve]
    log: bool = False
    whole: bool = False


def write_convergence_figure(
    path: Path, charts: Sequence[DrawnChart], *, title: str, xlabel: str, width: float = WIDTH
) -> None:
    """Write charts below one another, as SVG, PDF or PNG by the path's suffix; `width` in inches.

    Raises
    ------
    HexmendError
        For another suffix, and where matplotlib is missing or the file cannot be written.
    """
    check_figure(path)
    figure = new_figure(width, width / WIDTH * (1.2 + 1.7 * max(1, len(charts))))
    all_axes = figure.subplots(max(1, len(charts)), 1, sharex=True, squeeze=False)[:, 0]
    for axes, chart in zip(all_axes, charts, strict=False):
        for curve in chart.curves:
            style = {"linestyle": "--" if curve.dashed else "-", "linewidth": 1.8 if curve.strong else 1.0}
            axes.plot(curve.x, curve.y, color=curve.colour, label=curve.label, **style)
        known = [y for curve in chart.curves for y in curve.y if math.isfinite(y)]
        if chart.log and any(y > 0 for y in known):
            least = min(y for y in known if y > 0)
            if min(known) > 0:
                axes.set_yscale("log")
            else:
                axes.set_yscale("symlog", linthresh=10 ** math.floor(math.log10(least)))
        elif chart.whole:
            axes.yaxis.get_major_locator().set_params(integer=True)
        axes.set_ylabel(chart.title)
        axes.grid(alpha=0.3)
        if chart.curves:
            axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize="small")
    all_axes[-1].set_xlabel(xlabel)
    figure.suptitle(title)
    save_figure(figure, path)
