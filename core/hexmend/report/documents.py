"""One table as four files: CSV, Markdown, LaTeX and JSON."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from hexmend.errors import FileError
from hexmend.io.storage.atomic import atomic_write
from hexmend.io.storage.suffixes import suffix_for
from hexmend.io.storage.temporary_files import make_folder
from hexmend.report.latex import latex
from hexmend.report.markdown import markdown
from hexmend.report.records import write_csv, write_json
from hexmend.report.tables import Table

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
