"""Figures of what methods made of a mesh, for a page of a given width: distributions of quality, convergence."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from hexmend.figures import printable
from hexmend.optimise.figures import HISTORY
from hexmend.report.convergence import DrawnChart, DrawnCurve, write_convergence_figure
from hexmend.report.plots import COLOURS, Outline, check_matplotlib, write_histogram_figure

MM_PER_INCH = 25.4

#: Widths in mm that a figure can have: from less than a column to a poster.
WIDTHS = (40.0, 1000.0)

#: The size of what is written, in pt, and colour of the mesh as it was given.
_LETTERS, _FIRST = 8.0, "#5b6573"

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
    with _letters():
        write_histogram_figure(
            path,
            outlines,
            title=_plain(title),
            xlabel="q(H)",
            ylabel="hexes",
            ticks=ticks,
            extent=(0.0, 1.0),
            width=width_mm / MM_PER_INCH,
        )


def write_convergence(
    path: Path, histories: Mapping[str, Sequence[Mapping[str, Any]]], *, title: str, width_mm: float
) -> None:
    """Write how runs went, as SVG, PDF or PNG by the path's suffix.

    Parameters
    ----------
    path : Path
    histories : mapping
        Rows of iterations (`hexmend.optimise.Result.history`), by what the curve is called.
    title : str
    width_mm : float

    Raises
    ------
    HexmendError
        For another suffix, and where matplotlib is missing or the file cannot be written.
    """
    charts = [DrawnChart(HISTORY[key].label, _curves(histories, key), key == "objective", key == "inverted")
              for key in _FOLLOWED if _has(histories, key)]  # fmt: skip
    with _letters():
        write_convergence_figure(path, charts, title=_plain(title), xlabel="iteration", width=width_mm / MM_PER_INCH)


@contextmanager
def _letters() -> Iterator[None]:
    """Letters of one size, whatever the figure's width."""
    check_matplotlib()
    from matplotlib import rc_context

    with rc_context({"font.size": _LETTERS}):
        yield


def _plain(text: str) -> str:
    """A text in which matplotlib finds no formula, and nothing that it or SVG cannot hold: names come from files."""
    return printable(text).replace("$", r"\$")


def _label(name: str) -> str:
    """A name that leaves room for what it names: a longer one has its beginning and its end."""
    return _plain(name if len(name) <= _LONGEST else f"{name[: _LONGEST // 2]}…{name[-(_LONGEST // 2) :]}")


def _curves(histories: Mapping[str, Sequence[Mapping[str, Any]]], key: str) -> list[DrawnCurve]:
    return [
        DrawnCurve(
            _label(name),
            COLOURS[k % len(COLOURS)],
            [row["iteration"] for row in rows],
            [float("nan") if row[key] is None else row[key] for row in rows],
            strong=True,
        )
        for k, (name, rows) in enumerate(histories.items())
    ]


def _has(histories: Mapping[str, Sequence[Mapping[str, Any]]], key: str) -> bool:
    """Whether a figure tells something: an objective that is always infinite does not, nor does a count that is 0."""
    values = [row[key] for rows in histories.values() for row in rows]
    return any(values) if key == "inverted" else any(value is not None for value in values)
