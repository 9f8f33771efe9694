"""Figures of what methods made of a mesh, for a page of a given width: distributions of quality, convergence."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from hexmend.iteration.figures import HISTORY, objective_changes
from hexmend.report.charts import ChartStyle, write_chart
from hexmend.report.convergence import Convergence, DrawnChart, DrawnCurve
from hexmend.report.histogram import Histogram, Outline
from hexmend.report.plots import COLOURS

#: The colour of the mesh as it was given, and dots per inch of PNG.
_FIRST, _DPI = "#5b6573", 160.0

#: Letters of a name in a legend.
_LONGEST = 24

#: What is followed over the iterations.
_FOLLOWED = ("q_min", "objective", "inverted")


def write_distributions(path: Path, counts: Mapping[str, Sequence[int]], *, title: str, width_mm: float) -> None:
    """Write how q(H) is distributed, as SVG, PDF or PNG by the path's suffix.

    Parameters
    ----------
    path : Path
    counts : mapping
        Numbers of hexes in bins of equal width from 0 to 1, by what the curve is called; the first is filled.
    title : str
    width_mm : float

    Raises
    ------
    HexmendError
        For another suffix, and where matplotlib is missing or the file cannot be written.
    """
    outlines = [
        Outline(_label(name), COLOURS[(k - 1) % len(COLOURS)] if k else _FIRST, numbers, filled=k == 0)
        for k, (name, numbers) in enumerate(counts.items())
    ]
    ticks = [(k / 5, f"{k / 5:g}") for k in range(6)]
    histogram = Histogram(outlines, title, "q(H)", "hexes", ticks, (0.0, 1.0))
    write_chart(path, histogram.draw, ChartStyle(width=width_mm, resolution=_DPI))


def write_convergence(
    path: Path, histories: Mapping[str, Sequence[Mapping[str, Any]]], *, title: str, width_mm: float
) -> None:
    """Write how runs went, as SVG, PDF or PNG by the path's suffix.

    Parameters
    ----------
    path : Path
    histories : mapping
        Rows of iterations (`hexmend.iteration.Result.history`), by what the curve is called.
    title : str
    width_mm : float

    Raises
    ------
    HexmendError
        For another suffix, and where matplotlib is missing or the file cannot be written.
    """
    charts = [DrawnChart(HISTORY[key].label, _curves(histories, key), key == "objective", key == "inverted")
              for key in _FOLLOWED if _has(histories, key)]  # fmt: skip
    write_chart(path, Convergence(charts, title, "iteration").draw, ChartStyle(width=width_mm, resolution=_DPI))


def _label(name: str) -> str:
    """A name that leaves room for what it names: a longer one has its beginning and its end."""
    return name if len(name) <= _LONGEST else f"{name[: _LONGEST // 2]}…{name[-(_LONGEST // 2) :]}"


def _curves(histories: Mapping[str, Sequence[Mapping[str, Any]]], key: str) -> list[DrawnCurve]:
    curves = []
    for k, (name, rows) in enumerate(histories.items()):
        x = [float(row["iteration"]) for row in rows]
        y = [math.nan if row[key] is None else row[key] for row in rows]
        for at in reversed(objective_changes(rows) if key == "objective" else ()):
            x.insert(at, math.nan)
            y.insert(at, math.nan)
        curves.append(DrawnCurve(_label(name), COLOURS[k % len(COLOURS)], x, y, strong=True))
    return curves


def _has(histories: Mapping[str, Sequence[Mapping[str, Any]]], key: str) -> bool:
    """Whether a figure tells something: an objective that is always infinite does not, nor does a count that is 0."""
    values = [row[key] for rows in histories.values() for row in rows]
    return any(values) if key == "inverted" else any(value is not None for value in values)
