"""The report of the thesis's experiments: our figures and the published ones, and the claims."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from benchmarks.thesis import plots
from benchmarks.thesis.differences import differences_table, same_counts
from benchmarks.thesis.outlook.report import outlook_stem, outlook_table
from hexmend.report.comparison import LINES, explanations, label
from hexmend.report.documents import write_documents, write_text
from hexmend.report.markdown import escape, markdown
from hexmend.report.records import write_json
from hexmend.report.tables import Table
from hexmend.terminal_text import FailedText, ShortestText

#: Words for a claim that was reproduced, not reproduced, or not judged.
REPRODUCTION = {True: "Reproduced.", False: "Not reproduced.", None: "Not judged."}

#: Sentence on the meshes of the full study and of the quick one.
_OUR_MESHES = {
    "full": "The meshes are ours: the thesis's are not published, and these have their structure and size, so that "
    "qualities are to be compared in kind and not in digits.",
    "quick": "The meshes are ours, of the structure of the thesis's, which are not published, and in this quick study "
    "mostly much smaller: qualities and times are to be compared in kind and not in digits.",
}

#: Notes on the notation, which is the thesis's (4.1.1) but for its shading.
_FAILED = "In italics: the run did not converge to the optimum (shaded in the thesis)."
_SHORTEST = "In bold face: the shortest time of the optimisers that did."

#: Note below every table.
OURS = "The mesh is ours, of the structure of the thesis's, whose file is not published."


def write_experiment(folder: Path, experiment: Mapping[str, Any]) -> list[Path]:
    """Write one table of the thesis with our figures as CSV, Markdown, LaTeX and JSON.

    Parameters
    ----------
    folder : Path
    experiment : mapping
        `benchmarks.thesis.experiment_result.ExperimentResult.record`.
    """
    published = experiment["published"]
    rows = [
        {"method": name, **record, **{f"thesis_{key}": value for key, value in published.get(name, {}).items()}}
        for name, record in experiment["columns"].items()
    ]
    return write_documents(folder, stem(experiment), experiment_table(experiment), rows, experiment)


def write_study(folder: Path, study: Mapping[str, Any]) -> None:
    """Write `study.md`, the index of all tables, figures and claims, and `study.json`.

    Parameters
    ----------
    folder : Path
        Folder of the tables.
    study : mapping
        `benchmarks.thesis.runner.Study.record`; where meshes were drawn, with "figures".
    """
    figures = write_plots(folder, study)
    write_json(folder / "study.json", study)
    write_text(folder / "study.md", index(study, [*study.get("figures", ()), *figures]))


def experiment_table(experiment: Mapping[str, Any]) -> Table:
    """Make a table of the thesis with the published figures below ours."""
    thesis, notes = experiment["thesis"], [OURS]
    if not same_counts(experiment):
        notes.append(f"The thesis's has {thesis['hexes']:,} hexes and {thesis['free_nodes']:,} free nodes.")
    notes.append(f"Inverted at the start: {experiment['inverted']:,}, in the thesis {thesis['inverted']:,}.")
    delta = f", δ = {experiment['delta']:g}" if experiment["delta"] is not None else ""
    size = "{hexes:,} hexes, {free_nodes:,} free nodes of {nodes:,}".format(**experiment)
    title = f"Table {experiment['table']}, {experiment['thesis_mesh']}{delta}: {size}"
    failed, shortest = _notation(experiment["columns"])
    notes += [_FAILED] if failed else []
    notes += [_SHORTEST] if shortest else []
    columns = experiment["columns"]
    rows = table_rows(columns, experiment["published"], failed, shortest)
    return Table(title, ["", *columns], rows, [*notes, *explanations(columns)])


def table_rows(
    columns: Mapping[str, Mapping[str, Any]],
    published: Mapping[str, Mapping[str, Any]],
    failed: Sequence[str] = (),
    shortest: str = "",
) -> list[list[str]]:
    """Make the rows of a table: figures of all columns, and below them those of the thesis by column.

    Figures of the columns `failed`, and the time of the column `shortest`, are marked.
    """
    rows = []
    for figure in LINES:
        cells = {head: figure.of(record) for head, record in columns.items()}
        cells |= {head: FailedText(cells[head]) for head in failed}
        if shortest and figure.key == "seconds":
            cells[shortest] = ShortestText(cells[shortest])
        rows.append([label(figure, columns.values()), *cells.values()])
        theirs = [published.get(head, {}) for head in columns]
        if any(record.get(figure.key) is not None for record in theirs):
            rows.append(["– thesis", *(figure.of(record) for record in theirs)])
    return rows


def _notation(columns: Mapping[str, Mapping[str, Any]]) -> tuple[list[str], str]:
    """Return the optimisers that did not arrive at the optimum, and the fastest of the others (thesis 4.1.1)."""
    arrived = {name: one["arrived"] for name, one in columns.items() if one.get("arrived") is not None}
    seconds = {name: columns[name]["seconds"] for name, there in arrived.items() if there}
    return [name for name, there in arrived.items() if not there], min(seconds, key=seconds.__getitem__, default="")


def stem(experiment: Mapping[str, Any]) -> str:
    """Return the name of an experiment's files.

    >>> stem({"table": "4.15", "thesis_mesh": "Plane, GETMe smoothed"})
    'table-4.15-plane-getme-smoothed'
    """
    words = re.sub(r"[^a-z0-9]+", "-", experiment["thesis_mesh"].lower()).strip("-")
    return f"table-{experiment['table']}-{words}"


def index(study: Mapping[str, Any], figures: Sequence[Mapping[str, str]]) -> str:
    """Return the text of `study.md`; `figures` have number, caption and file."""
    parts = ["# The thesis's Chapter 4, measured again", _preface(study), "## Claims", _claims(study["claims"])]
    differences = differences_table(study["experiments"])
    parts += ["## Compared with the thesis, cell by cell", markdown(differences)] if differences else []
    if figures:
        parts += ["## Figures", *map(_figure, sorted(figures, key=_number))]
    for head, tables in (
        ("## Tables", [(stem(one), experiment_table(one)) for one in study["experiments"]]),
        ("## Sections 3.2.2 and 5.2, tried", [(outlook_stem(one), outlook_table(one)) for one in study["outlooks"]]),
    ):
        parts += [head] if tables else []
        for name, table in tables:
            files = ", ".join(f"[{suffix}]({name}.{suffix})" for suffix in ("csv", "tex", "json"))
            parts.append(f"{markdown(table)}\n{files}")
    return "\n\n".join(parts) + "\n"


def _preface(study: Mapping[str, Any]) -> str:
    limits = f"{study['max_seconds']:g} s"
    limits += "".join(f", of {method} {seconds:g} s" for method, seconds in study["max_seconds_of"].items())
    sentences = [
        "T. J. Wilson, *Simultaneous Untangling and Smoothing of Hexahedral Meshes*.",
        _OUR_MESHES["quick" if study["quick"] else "full"],
        f"A run ends with the iteration in which it passes {limits}; the tables say where one did.",
    ]
    machine = study.get("machine", {})
    measured_on = "; ".join(f"{key} {value}" for key, value in machine.items())
    return " ".join(sentences) + (f"\n\nMeasured on: {escape(measured_on)}." if machine else "")


def _claims(claims: Sequence[Mapping[str, Any]]) -> str:
    return "\n".join(
        f"- {escape(one['claim'])} ({one['section']}) **{REPRODUCTION[one['reproduced']]}** {escape(one['figures'])}"
        for one in claims
    )


def _figure(figure: Mapping[str, str]) -> str:
    title = f"Figure {figure['number']}"
    return f"![{title}]({figure['file']})\n\n**{title}**, {escape(figure['caption'])}."


def _number(figure: Mapping[str, str]) -> list[int]:
    return [int(part) for part in figure["number"].split(".")]


def write_plots(folder: Path, study: Mapping[str, Any]) -> list[dict[str, str]]:
    """Draw figures 4.4 and 4.9, as far as their tables were measured.

    Parameters
    ----------
    folder : Path
    study : mapping
        `benchmarks.thesis.runner.Study.record`.

    Returns
    -------
    list of dict
        Number, caption and file of each figure.
    """
    figures = []
    ours, theirs = defaultdict[str, list](list), defaultdict[str, list](list)
    for experiment in (one for one in study["experiments"] if one["mesh"] == "five-side"):
        columns, published = experiment["columns"], experiment["published"]
        measured = {name: record for name, record in columns.items() if name in published}
        for points, nodes, records in (
            (ours, experiment["free_nodes"], measured),
            (theirs, experiment["thesis"]["free_nodes"], published),
        ):
            for name, record in records.items():
                if record.get("seconds_per_iteration"):
                    points[name].append((nodes, record["seconds_per_iteration"]))
    if ours:
        file = "figure-4.4-scaling.png"
        plots.scaling(folder / file, ours, theirs)
        caption = "Scaling of smoothing algorithms with number of free nodes in FiveSide geometry"
        figures.append({"number": "4.4", "caption": f"{caption}: ours and the thesis's", "file": file})
    for experiment in (one for one in study["experiments"] if one["table"] == "4.14"):
        counts = {name: one["distribution"] for name, one in experiment["columns"].items() if one["distribution"]}
        file, size = "figure-4.9-distributions.png", f"{experiment['hexes']:,} hexes"
        plots.distributions(folder / file, counts, f"{experiment['mesh']}, {size}")
        figures.append(
            {"number": "4.9", "caption": f"Quality distributions for Plane mesh: ours, {size}", "file": file}
        )
    return figures
