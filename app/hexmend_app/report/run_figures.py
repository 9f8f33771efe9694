"""Figures of runs on a mesh for a page of a given width: distributions of quality, convergence."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from hexmend.iteration.figures import HISTORY, objective_changes
from hexmend_app.report.charts import COLOURS, ChartStyle, write_chart
from hexmend_app.report.convergence import Convergence, Line, LineChart
from hexmend_app.report.distribution import Axis
from hexmend_app.report.histogram import Histogram, Series

#: Colour of the initial mesh.
_INITIAL_COLOUR = "#5b6573"

#: Pixels per inch of a PNG.
_DPI = 160.0

#: Characters of the longest name in a legend.
_MAX_LABEL = 24

#: Figures that are drawn over the iterations, the counts from 0 on.
_COUNTS = ("inverted", "invalid")
_DRAWN = ("q_min", "objective", *_COUNTS)


def write_distributions(path: Path, counts: Mapping[str, Sequence[int]], *, title: str, width_mm: float) -> None:
    """Write the distributions of q(H) as SVG, PDF or PNG, by the path's suffix.

    Parameters
    ----------
    path : Path
    counts : mapping
        Numbers of hexes in bins of equal width from 0 to 1, by the name of the curve; the first is filled.
    title : str
    width_mm : float

    Raises
    ------
    HexmendError
        For another suffix, and if matplotlib is not installed or the file cannot be written.
    """
    series = [
        Series(_label(name), COLOURS[(k - 1) % len(COLOURS)] if k else _INITIAL_COLOUR, numbers, filled=k == 0)
        for k, (name, numbers) in enumerate(counts.items())
    ]
    axis = Axis("q", bins=len(series[0].counts))
    histogram = Histogram(series, title, axis.title, "hexes", axis.ticks())
    write_chart(path, histogram.draw, ChartStyle(width=width_mm, resolution=_DPI))


def write_convergence(
    path: Path, histories: Mapping[str, Sequence[Mapping[str, Any]]], *, title: str, width_mm: float
) -> None:
    """Write the convergence of runs as SVG, PDF or PNG, by the path's suffix.

    Parameters
    ----------
    path : Path
    histories : mapping
        Rows of iterations (`hexmend.iteration.Result.history`), by the name of the curve.
    title : str
    width_mm : float

    Raises
    ------
    HexmendError
        For another suffix, and if matplotlib is not installed or the file cannot be written.
    """
    charts = [
        LineChart(HISTORY[key].label, _curves(histories, key), key == "objective", key in _COUNTS)
        for key in _DRAWN
        if _has(histories, key)
    ]
    write_chart(path, Convergence(charts, title, "iteration").draw, ChartStyle(width=width_mm, resolution=_DPI))


def _label(name: str) -> str:
    """Shorten a long name to its beginning and its end."""
    return name if len(name) <= _MAX_LABEL else f"{name[: _MAX_LABEL // 2]}…{name[-(_MAX_LABEL // 2) :]}"


def _curves(histories: Mapping[str, Sequence[Mapping[str, Any]]], key: str) -> list[Line]:
    curves = []
    for k, (name, rows) in enumerate(histories.items()):
        x = [float(row["iteration"]) for row in rows]
        y = [math.nan if row[key] is None else row[key] for row in rows]
        for at in reversed(objective_changes(rows) if key == "objective" else ()):
            x.insert(at, math.nan)
            y.insert(at, math.nan)
        curves.append(Line(_label(name), COLOURS[k % len(COLOURS)], x, y, strong=True))
    return curves


def _has(histories: Mapping[str, Sequence[Mapping[str, Any]]], key: str) -> bool:
    """Return False for a figure without information: an objective that is always infinite, a count always 0."""
    values = [row[key] for rows in histories.values() for row in rows]
    return any(values) if key in _COUNTS else any(value is not None for value in values)
