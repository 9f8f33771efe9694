"""The report of `hexmend study thesis`: our figures beside the published ones, and the claims judged."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from hexmend.errors import HexmendError
from hexmend.report import plots
from hexmend.report.comparison import comparison_table
from hexmend.report.documents import write_documents, write_text
from hexmend.report.markdown import escaped, markdown
from hexmend.report.outlook import outlook_stem, outlook_table
from hexmend.report.records import write_json
from hexmend.report.tables import Table

#: What is said of a claim, by whether it was reproduced.
VERDICTS = {True: "Reproduced.", False: "Not reproduced.", None: "Not judged."}

#: Said below every table.
OURS = "The mesh is ours, of the structure of the thesis's, whose file is not published."


def write_experiment(folder: Path, experiment: Mapping[str, Any]) -> list[Path]:
    """One table of the thesis, ours beside the published, as four files.

    Parameters
    ----------
    folder : Path
    experiment : mapping
        `hexmend.study.measured.Measured.record`.
    """
    published = experiment["published"]
    rows = [
        {"method": name, **record, **{f"thesis_{key}": value for key, value in published.get(name, {}).items()}}
        for name, record in experiment["columns"].items()
    ]
    return write_documents(folder, stem(experiment), experiment_table(experiment), rows, experiment)


def write_study(folder: Path, study: Mapping[str, Any]) -> list[Path]:
    """The index `study.md` of all tables, figures and claims, and `study.json`.

    Parameters
    ----------
    folder : Path
        Where the tables were written.
    study : mapping
        `hexmend.study.thesis.Study.record`.

    Raises
    ------
    HexmendError
        Where figures cannot be drawn; all else is written before.
    """
    problem = None
    try:
        figures = _write_figures(folder, study)
    except HexmendError as error:
        problem, figures = error, []
    write_json(folder / "study.json", study)
    write_text(folder / "study.md", index(study, [path.name for path in figures if path.suffix == ".png"]))
    if problem is not None:
        raise problem
    return [folder / "study.md", folder / "study.json", *figures]


def experiment_table(experiment: Mapping[str, Any]) -> Table:
    """A table of the thesis with a line of the published figures below each line of ours."""
    thesis, notes = experiment["thesis"], [OURS]
    if (experiment["hexes"], experiment["free_nodes"]) != (thesis["hexes"], thesis["free_nodes"]):
        notes.append(f"The thesis's has {thesis['hexes']:,} hexes and {thesis['free_nodes']:,} free nodes.")
    notes.append(f"Inverted at the start: {experiment['inverted']:,}, in the thesis {thesis['inverted']:,}.")
    delta = f", δ = {experiment['delta']:g}" if experiment["delta"] is not None else ""
    title = (
        f"Table {experiment['table']}, {experiment['thesis_mesh']}{delta}: "
        f"{experiment['hexes']:,} hexes, {experiment['free_nodes']:,} free nodes"
    )
    return comparison_table(title, experiment["columns"], experiment["published"], notes)


def stem(experiment: Mapping[str, Any]) -> str:
    """The name of an experiment's files.

    >>> stem({"table": "4.15", "thesis_mesh": "Plane, GETMe smoothed"})
    'table-4.15-plane-getme-smoothed'
    """
    words = re.sub(r"[^a-z0-9]+", "-", experiment["thesis_mesh"].lower()).strip("-")
    return f"table-{experiment['table']}-{words}"


def index(study: Mapping[str, Any], pictures: Sequence[str]) -> str:
    """`study.md`."""
    parts = ["# The thesis's Chapter 4, measured again", _preface(study), "## Claims", _claims(study["claims"])]
    if pictures:
        parts += ["## Figures", *(f"![{name}]({name})" for name in pictures)]
    for head, tables in (
        ("## Tables", [(stem(one), experiment_table(one)) for one in study["experiments"]]),
        ("## What section 5.2 hopes for", [(outlook_stem(one), outlook_table(one)) for one in study["outlooks"]]),
    ):
        parts += [head] if tables else []
        for name, table in tables:
            files = ", ".join(f"[{suffix}]({name}.{suffix})" for suffix in ("csv", "tex", "json"))
            parts.append(f"{markdown(table)}\n{files}")
    return "\n\n".join(parts) + "\n"


def _preface(study: Mapping[str, Any]) -> str:
    own = "".join(f", of {method} {seconds:g} s" for method, seconds in study["max_seconds_of"].items())
    sentences = [
        "T. J. Wilson, *Simultaneous Untangling and Smoothing of Hexahedral Meshes*.",
        "The meshes are ours: the thesis's are not published, and these have their structure and size,"
        " so that qualities are to be compared in kind and not in digits."
        if not study["quick"]
        else "The meshes are ours, of the structure of the thesis's, which are not published, and in this quick study"
        " mostly much smaller: qualities and times are to be compared in kind and not in digits.",
        f"A run ends with the iteration in which it passes {study['max_seconds']:g} s{own}; the tables say where one"
        " did.",
    ]
    if study["interrupted"]:
        sentences.append("**The study was interrupted: what is below is what was measured until then.**")
    machine = study.get("machine", {})
    measured_on = "; ".join(f"{key} {value}" for key, value in machine.items())
    return " ".join(sentences) + (f"\n\nMeasured on: {escaped(measured_on)}." if machine else "")


def _claims(claims: Sequence[Mapping[str, Any]]) -> str:
    return "\n".join(
        f"- {escaped(one['claim'])} ({one['section']}) **{VERDICTS[one['reproduced']]}** {escaped(one['figures'])}"
        for one in claims
    )


def _write_figures(folder: Path, study: Mapping[str, Any]) -> list[Path]:
    paths = []
    ours: dict[str, list[tuple[int, float]]] = {}
    theirs: dict[str, list[tuple[int, float]]] = {}
    for experiment in (one for one in study["experiments"] if one["mesh"] == "five-side"):
        for name, record in experiment["columns"].items():
            if record.get("seconds_per_iteration"):
                ours.setdefault(name, []).append((experiment["free_nodes"], record["seconds_per_iteration"]))
        for name, record in experiment["published"].items():
            if record.get("seconds_per_iteration"):
                point = (experiment["thesis"]["free_nodes"], record["seconds_per_iteration"])
                theirs.setdefault(name, []).append(point)
    if ours:
        paths += plots.scaling(folder / "figure-4.4-scaling", ours, theirs)
    for experiment in study["experiments"]:
        if experiment["table"] == "4.14":
            counts = {name: one["distribution"] for name, one in experiment["columns"].items() if one["distribution"]}
            title = f"{experiment['mesh']}, {experiment['hexes']:,} hexes"
            paths += plots.distributions(folder / "figure-4.9-distributions", counts, title)
    return paths
