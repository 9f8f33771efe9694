"""Report as one self-contained HTML page."""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from markupsafe import Markup

from hexmend import __version__
from hexmend.io.storage.atomic import atomic_write, check_writable
from hexmend.io.storage.suffixes import suffix_for
from hexmend.mesh.solid_cells import count_cells
from hexmend.quality.regressions import describe_regressions
from hexmend.quantity import format_count, format_quality, format_significant
from hexmend.report.tables import Table
from hexmend.solver_checks import SOLVERS, Report, check_mesh
from hexmend.study.compare import Row
from hexmend.study.machine import machine
from hexmend.terminal_text import count_phrase, printable
from hexmend_app.report.case import Case, Version
from hexmend_app.report.charts import check_matplotlib
from hexmend_app.report.figure_set import PARTS, Figure, Style, table_of, write_figures
from hexmend_app.report.pdf import check_pdf, write_pdf
from hexmend_app.report.templates import ENVIRONMENT, html, read
from hexmend_app.report.viewer import script, viewer
from hexmend_app.report.worst_hexes import Locked, worst_table
from hexmend_app.state.mesh.hex_groups import invalid_counts

#: Figures that are drawn as SVG.
_PLOTS = ("distributions", "convergence")

#: Width of a plot in mm, at which its text has the size of the page's text.
_PLOT = 120.0

#: Pixels per inch of the pictures.
REPORT_DPI = 220.0


@dataclass(frozen=True)
class Chapter:
    """Chapter on one mesh.

    Parameters
    ----------
    name : str
    place : str
        Id of its heading.
    row : sequence of str
        Row of the summary table.
    preface : str
    sections : mapping of str to sequence of str
        Parts of each section as HTML, by its heading.
    """

    name: str
    place: str
    row: Sequence[str]
    preface: str
    sections: Mapping[str, Sequence[str]]


def figures_of(case: Case) -> list[str]:
    """Return the names of the figures of a chapter in the order in which they are drawn; convergence needs a run."""
    has_run = any(version.history for version in case.versions)
    return [part for part in PARTS if part != "table" and (part != "convergence" or has_run)]


def draw_chapter(
    case: Case, style: Style, *, interactive: bool, place: str = "mesh-1"
) -> Generator[Figure, None, Chapter]:
    """Draw the figures of the chapter on a mesh one by one, and return the chapter.

    Parameters
    ----------
    case : Case
    style : Style
        Style of the figures.
    interactive : bool
        True for a mesh that can be rotated, which needs a browser.
    place : str
        Id of the chapter's heading.

    Yields
    ------
    Figure
    """
    view = yield from _quality(case, style, interactive)
    locked = [Locked.of(one.mesh, one.quality) for one in case.versions]
    sections = {
        "The mesh": view,
        "Quality": [html.tables(table_of(case)), *map(_failed, case.failed)],
        "Checks of solvers": _checks(case),
        "The worst hexes": _worst(case, locked),
        "Locked hexes and suggestions": _locked(case, locked),
        "Runs": _runs(case),
        "Source": [_origin(case)],
    }
    if not interactive:  # on paper the table is on the first page
        sections = {"Quality": sections.pop("Quality"), **sections}
    first, last = case.initial.summary, case.versions[-1].summary
    cells = count_cells(case.initial.mesh.elements).removesuffix(" hexes").removesuffix(" hex")
    row = [case.name, cells, _change(first.invalid, last.invalid, format_count)]
    row += [_change(one, other, format_quality) for one, other in (
        (first.q_min, last.q_min), (first.q_mean, last.q_mean), (first.scaled_jacobian_min, last.scaled_jacobian_min)
    )]  # fmt: skip
    return Chapter(case.name, place, row, _preface(case), sections)


def page(title: str, chapters: Sequence[Chapter], command: str, *, interactive: bool) -> str:
    """Return the page as HTML.

    Parameters
    ----------
    title : str
    chapters : sequence of Chapter
    command : str
        The command that writes the page; "" for a report of the window.
    interactive : bool
        True for a page with scripts, which need a browser.
    """
    head = ["mesh", "hexes", "invalid", "q min", "q mean", "scaled Jacobian min"]
    text = ENVIRONMENT.get_template("page.html").render(
        title=title,
        style=read("page.css"),
        version=__version__,
        time=datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC"),
        summary=Table("", head, [one.row for one in chapters]),
        chapters=chapters,
        command=command,
        script=script() if interactive else "",
    )
    return text.encode("utf-8", "replace").decode("utf-8")  # file names can have undecodable bytes


def check_report(path: Path) -> bool:
    """Return True if a report is an interactive HTML page, False if it is a PDF.

    Raises
    ------
    HexmendError
        If a library is missing, or the report cannot be written.
    """
    interactive = suffix_for(path, "a report", (".html", ".pdf")) == ".html"
    if not interactive:
        check_pdf()
    check_writable(path)
    check_matplotlib()
    return interactive


def write_report(path: Path, text: str) -> None:
    """Write a report atomically, as HTML or PDF by the suffix."""
    if path.suffix.lower() == ".pdf":
        write_pdf(path, text)
        return
    with atomic_write(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _preface(case: Case) -> str:
    first = case.initial.summary
    sentences = [
        *_worse(case),
        f"{count_cells(case.initial.mesh.elements)} and {format_count(first.nodes)} nodes, "
        f"{format_count(first.free_nodes)} of them free.",
        *(
            f"{version.name}: {invalid_counts(version.summary.inverted, version.summary.invalid)}, "
            f"q min {format_quality(version.summary.q_min)}."
            for version in case.versions
        ),
    ]
    if case.interrupted:
        sentences.append("The runs were interrupted: the report shows the results so far.")
    return " ".join(sentences)


def _worse(case: Case) -> list[str]:
    """Return a sentence for each method on what became worse."""
    results = case.versions[1:]
    worse = [(one.name, describe_regressions(case.initial.summary, one.summary)) for one in results]
    sentences = [f"{name}: {text}" for name, text in worse if text]
    return sentences or [
        "No method made the number of inverted or invalid hexes, q min or the minimum scaled Jacobian worse."
    ] * bool(results)


def _checks(case: Case) -> list[str]:
    """Return the verdicts of all solvers' checks on each version."""
    head = ["solver", *(version.name for version in case.versions)]
    rows = []
    for solver in SOLVERS.values():
        reports = [check_mesh(one.mesh, solver.name, one.quality) for one in case.versions]
        rows.append([solver.title, *map(_solver_verdict, reports)])
    return [html.table(Table("", head, rows))]


def _solver_verdict(report: Report) -> str:
    """Return the verdict, with the number of checks that have it unless all are passed."""
    count = sum(one.verdict == report.verdict for one in report.results)
    return report.verdict if report.verdict == "passed" else f"{report.verdict} ({count_phrase(count, 'check')})"


def _quality(case: Case, style: Style, interactive: bool) -> Generator[Figure, None, list[str]]:
    """Draw the pictures one by one, and return the interactive view of the mesh and the pictures as HTML."""
    with TemporaryDirectory(prefix="hexmend-report-") as folder:
        plots = replace(style, width=_PLOT, formats=("svg",))
        pictures = {}
        for part in figures_of(case):
            for figure in write_figures(case, Path(folder), plots if part in _PLOTS else style, [part]):
                pictures[part] = html.picture(figure.paths[0], figure.caption)
                yield figure
    view = viewer(case.versions, pictures["surface"]) if interactive else pictures["surface"]
    pair = Markup().join(pictures[part] for part in _PLOTS if part in pictures)
    return [view, pictures["behind"], pictures["cut"], Markup('<div class="pair">{}</div>').format(pair)]


def _failed(row: Row) -> str:
    return html.paragraph(f"{row.method}: {row.message}")


def _worst(case: Case, locked: Sequence[Locked]) -> list[str]:
    tables = [
        worst_table(one.name, one.mesh, one.quality, hexes) for one, hexes in zip(case.versions, locked, strict=True)
    ]
    return [
        Markup('<div data-version="{}">{}</div>').format(number, html.table(table, words=1))
        for number, table in enumerate(tables)
    ]


def _locked(case: Case, locked: Sequence[Locked]) -> list[str]:
    """Return the locked hexes of the original mesh, the state after each run, and suggestions."""
    words = locked[0].words() or "No hex is locked, i.e. inverted because of fixed nodes alone."
    parts = [html.paragraph(words)]
    for version in case.versions[1:]:
        if (advice := version.advice) is not None:
            state = " ".join(filter(None, [advice.state, advice.surface]))
            parts.append(html.paragraph(f"{version.name}: {state}"))
            parts.append(html.listed([f"{tip.title}: {tip.text}" for tip in advice.suggestions]))
    return parts


def _runs(case: Case) -> list[str]:
    """Return a table of the parameters, outcome and times of each method."""
    rows = [_run(one) for one in case.versions[1:] if one.row is not None]
    if not rows:
        return [html.paragraph("No method was run.")]
    head = ["method", "preparation, s", "run, s", "iterations", "outcome", "parameters"]
    notes = []
    if case.stop is not None:
        limits = ", ".join(f"{name} {_value(value)}" for name, value in case.stop.values().items())
        notes.append(f"Limits of each run: {limits}.")
    return [html.table(Table("", head, rows, notes), words=2)]


def _run(version: Version) -> list[str]:
    row = version.row
    if row.stages:
        parameters = "; ".join(f"{stage.method}: {_values(stage.parameters)}" for stage in row.stages)
    else:
        parameters = _values(row.parameters)
    name = version.name if version.name == row.method else f"{version.name} ({row.method})"
    return [
        name,
        format_significant(row.setup_seconds),
        format_significant(row.seconds),
        format_count(row.iterations),
        row.message,
        parameters,
    ]


def _values(values: Mapping[str, object]) -> str:
    return ", ".join(f"{name} {_value(value)}" for name, value in values.items()) or "none"


def _value(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def _origin(case: Case) -> str:
    pairs: dict[str, str] = {}
    if case.source is not None:
        pairs |= {
            "file": printable(case.source.path),
            "size": f"{format_count(case.source.size)} bytes{_reading(case.source.seconds)}",
            "SHA-256": case.source.sha256,
        }
    if case.initial.mesh.notes:
        pairs["on reading"] = " ".join(case.initial.mesh.notes)
    pairs["Hexmend"] = __version__
    return html.facts(pairs | {name: str(value) for name, value in machine().items()})


def _reading(seconds: float | None) -> str:
    return "" if seconds is None else f", read in {format_significant(seconds, 3)} s"


def _change(first: float, last: float, text: Callable[[Any], str]) -> str:
    return text(first) if first == last else f"{text(first)} → {text(last)}"
