"""One table as four files: CSV, Markdown, LaTeX and JSON.

The report of a study of many meshes: the table of all tasks, and summaries by case and by mesh.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from statistics import median
from typing import Any

from hexmend.errors import FileError, HexmendError
from hexmend.io.storage.atomic import atomic_write
from hexmend.io.storage.suffixes import suffix_for
from hexmend.io.storage.temporary_files import make_folder
from hexmend.quantity import format_count, format_quality, format_significant
from hexmend.report.latex import latex
from hexmend.report.markdown import escape, markdown
from hexmend.report.records import write_csv, write_json
from hexmend.report.tables import Table
from hexmend.terminal_text import install_hint

#: Suffixes of tables: for spreadsheets, readers, LaTeX and programs.
SUFFIXES = (".csv", ".md", ".tex", ".json")


def output_folder(path: str | Path) -> Path:
    """Return the path of a folder, which is made with its parents if it does not exist.

    Raises
    ------
    FileError
        If it cannot be made or is a file.
    """
    folder = Path(path)
    try:
        make_folder(folder)
    except OSError as error:
        problem = "is a file" if isinstance(error, FileExistsError) else f"cannot be made: {error.strerror or error}"
        raise FileError(folder, problem, "Choose another folder.") from None
    return folder


def write_documents(
    folder: Path, stem: str, table: Table, rows: Sequence[Mapping[str, Any]], data: Mapping[str, Any]
) -> list[Path]:
    """Write a table as CSV, Markdown, LaTeX and JSON.

    Parameters
    ----------
    folder : Path
    stem : str
        Name of the four files without suffix.
    table : Table
    rows : sequence of mapping
        Rows of the CSV; its columns are the keys of all rows, without those of lists.
    data : mapping
        Content of the JSON.

    Returns
    -------
    list of Path
        CSV, Markdown, LaTeX, JSON.
    """
    paths = [folder / f"{stem}{suffix}" for suffix in SUFFIXES]
    for path in paths:
        write_document(path, table, rows, data)
    return paths


def write_document(path: Path, table: Table, rows: Sequence[Mapping[str, Any]], data: Mapping[str, Any]) -> None:
    """Write one of the four files, by the path's suffix; see `write_documents`.

    Raises
    ------
    FileError
        For another suffix, or if the file cannot be written.
    """
    suffix = suffix_for(path, "a table", SUFFIXES)
    if suffix == ".csv":
        write_csv(path, rows)
    elif suffix == ".md":
        write_text(path, markdown(table))
    elif suffix == ".tex":
        write_text(path, latex(table))
    else:
        write_json(path, data)


def write_text(path: Path, text: str) -> None:
    """Write a text file as a whole or not at all; names of files that are not Unicode keep their bytes."""
    with atomic_write(path) as temporary:
        temporary.write_text(text, encoding="utf-8", errors="surrogateescape")


#: Failures that are listed at most; the CSV has all of them.
_MAX_FAILURES = 200

Rows = Sequence[Mapping[str, Any]]


def write_batch_study(folder: Path, study: Mapping[str, Any], machine: Mapping[str, Any]) -> list[Path]:
    """Write `study.csv` with all rows, and `study.md` and `study.tex` with summaries by case and by mesh.

    Parameters
    ----------
    folder : Path
    study : mapping
        `hexmend.study.batch.runner.StudyResult.record`.
    machine : mapping
        The computer, from `hexmend.study.machine.machine`.
    """
    rows = study["rows"]
    tables = [cases_table(study), meshes_table(rows)]
    paths = [folder / f"study{suffix}" for suffix in (".csv", ".md", ".tex")]
    write_csv(paths[0], rows)
    lines = [
        f"# {escape(study['title'])}",
        f"{len(rows):,} of {study['tasks']:,} tasks are done. {machine_words(machine)}",
    ]
    if study["interrupted"]:
        lines.append("The study was interrupted: run the same command again to continue.")
    failures = failures_table(rows)
    write_text(paths[1], "\n\n".join([*lines, *map(markdown, [*tables, *([failures] if failures else [])])]))
    write_text(paths[2], "\n".join(map(latex, tables)))
    return paths


def write_parquet(path: Path, rows: Rows, types: Mapping[str, type]) -> None:
    """Write the rows as Parquet.

    Parameters
    ----------
    path : Path
    rows : sequence of mapping
    types : mapping
        Type of each column.

    Raises
    ------
    HexmendError
        If pyarrow is not installed.
    """
    try:
        import pyarrow as pa
        from pyarrow import parquet
    except ImportError:
        raise HexmendError(f"{path.name} needs pyarrow: {install_hint('study')}") from None
    known = {str: pa.string(), int: pa.int64(), float: pa.float64()}
    schema = pa.schema([(name, known[type_]) for name, type_ in types.items()])
    with atomic_write(path) as temporary:
        parquet.write_table(pa.Table.from_pylist([dict(row) for row in rows], schema), temporary)


def cases_table(study: Mapping[str, Any]) -> Table:
    """Make the table with a row for each case, over all meshes."""
    gains = (f"{figure}: median gain" for figure in ("q min", "q mean", "sc. Jacobian"))
    quality = (head for gain in gains for head in (gain, "least"))
    head = ("", "results", "valid", "untangled", "worse", *quality, "s: median", "s in all", "peak MB")
    lines = [[case, *_line([row for row in study["rows"] if row["case"] == case])] for case in study["cases"]]
    notes = (
        "Results: of how many tasks. Valid: results without an invalid hex. Untangled: of the results of meshes "
        "that had invalid hexes. Worse: results with more inverted or invalid hexes, a lower q min or a lower minimum "
        "scaled Jacobian than the mesh as given. A gain is after minus before.",
    )
    return Table(study["title"], head, lines, notes)


def meshes_table(rows: Rows) -> Table:
    """Make the table with a row for each mesh and its best case: fewest invalid hexes, then highest q min."""
    head = (
        *("", "hexes", "inverted", "invalid", "q min", "valid"),
        *("best by", "inverted then", "invalid then", "q min then", "sc. Jacobian then"),
    )
    lines, names = [], mesh_names(rows)
    for mesh in dict.fromkeys(row["mesh"] for row in rows):
        mine = [row for row in rows if row["mesh"] == mesh]
        done = [row for row in mine if row["status"] == "done"]
        known = next((row for row in mine if row["hexes"] is not None), None)
        best = min(done, key=lambda row: (row["invalid_after"], -row["q_min_after"]), default=None)
        given = _figures(known, "hexes", "inverted_before", "invalid_before", "q_min_before")
        then = _figures(
            best, "case", *(f"{key}_after" for key in ("inverted", "invalid", "q_min", "scaled_jacobian_min"))
        )
        valid = sum(not row["invalid_after"] for row in done)
        lines.append([names[mesh], *given, f"{valid} of {len(mine)}", *then])
    return Table("The meshes", head, lines)


def _figures(row: Mapping[str, Any] | None, *keys: str) -> list[str]:
    """Format counts and qualities of a row; a dash for each without a row."""
    counts = ("hexes", *(f"{key}_{when}" for key in ("inverted", "invalid") for when in ("before", "after")))
    formats = {"case": str, **dict.fromkeys(counts, format_count)}
    return ["–" if row is None else formats.get(key, format_quality)(row[key]) for key in keys]


def failures(rows: Rows) -> list[tuple[str, str, str, str]]:
    """Return mesh, cases, status and reason of failed tasks, in groups of equal mesh, status and reason."""
    groups: dict[tuple[str, str, str], list[str]] = {}
    for row in rows:
        if row["status"] != "done":
            groups.setdefault((row["mesh"], row["status"], row["reason"]), []).append(row["case"])
    cases, files = len({row["case"] for row in rows}), mesh_names(rows)
    return [
        (files[mesh], f"all {cases}" if len(names) == cases > 1 else "; ".join(names), status, reason)
        for (mesh, status, reason), names in groups.items()
    ]


def failures_table(rows: Rows) -> Table | None:
    """Make the table of the failed tasks; None if there are none."""
    failed = failures(rows)
    if not failed:
        return None
    left = len(failed) - _MAX_FAILURES
    notes = [f"And {left:,} more: see the column reason of study.csv."] if left > 0 else []
    return Table("Without a result", ("", "case", "status", "reason"), failed[:_MAX_FAILURES], notes)


def mesh_names(rows: Rows) -> dict[str, str]:
    """Return a name for each mesh: the file's name, or the whole path if two files have the same name."""
    meshes = dict.fromkeys(row["mesh"] for row in rows)
    counts = Counter(Path(mesh).name for mesh in meshes)
    return {mesh: name if counts[name := Path(mesh).name] == 1 else mesh for mesh in meshes}


def _line(rows: Rows) -> list[str]:
    done = [row for row in rows if row["status"] == "done"]
    valid = [row for row in done if not row["invalid_after"]]
    invalid = [row for row in done if row["invalid_before"]]
    seconds = [row["seconds"] for row in done]
    peaks = [row["peak_mb"] for row in rows if row["peak_mb"] is not None]
    untangled = f"{sum(bool(row['invalid_before']) for row in valid)} of {len(invalid)}"
    worse = sum(bool(row["worse"]) for row in done)
    cells = [f"{len(done)} of {len(rows)}", str(len(valid)), untangled, str(worse)]
    for key in ("q_min", "q_mean", "scaled_jacobian_min"):
        gains = [row[f"{key}_after"] - row[f"{key}_before"] for row in done]
        cells += [f"{median(gains):+.4f}", f"{min(gains):+.4f}"] if gains else ["–", "–"]
    cells += [format_significant(median(seconds), 3), format_significant(sum(seconds), 3)] if seconds else ["–", "–"]
    return [*cells, f"{max(peaks):,.0f}" if peaks else "–"]


def machine_words(machine: Mapping[str, Any]) -> str:
    """Describe the computer on which a study was started as a sentence, from `hexmend.study.machine.machine`."""
    return f"Started on: {'; '.join(f'{key} {escape(str(value))}' for key, value in machine.items())}."
