"""Files of a collection: CSV, Markdown, an HTML page, and the part of a page of docs between two marks."""

from __future__ import annotations

from pathlib import Path

from hexmend.errors import FileError
from hexmend.report.batch import machine_words
from hexmend.report.collection.page import write_page
from hexmend.report.collection.record import CollectionRecord
from hexmend.report.collection.tables import collection_tables, figures_table
from hexmend.report.documents import write_csv, write_text
from hexmend.report.markdown import escape, markdown, wrapped

#: Marks in a page of Markdown between which the tables are written.
BEGIN, END = "<!-- collection -->", "<!-- end -->"

_TITLE = "Meshes of a collection, smoothed"


def write_collection(folder: Path, record: CollectionRecord) -> list[Path]:
    """Write `collection.md`, `collection.csv` and `collection.html`.

    Parameters
    ----------
    folder : Path
        Exists already.
    record : CollectionRecord

    Returns
    -------
    list of Path
    """
    paths = [folder / f"collection{suffix}" for suffix in (".md", ".csv", ".html")]
    tables = [*collection_tables(record), figures_table(record)]
    count = f"{len(record.rows):,} of {record.tasks:,} results."
    write_text(paths[0], "\n\n".join([f"# {_TITLE}", count, _conditions(record), *map(markdown, tables)]))
    write_csv(paths[1], record.rows)
    write_page(paths[2], record, _TITLE)
    return paths


def replace_tables(page: Path, record: CollectionRecord) -> None:
    """Write the tables of programs, meshes and objectives into a page of Markdown, between `BEGIN` and `END`.

    Parameters
    ----------
    page : Path
    record : CollectionRecord

    Raises
    ------
    FileError
        If it cannot be read or has no such marks.
    """
    text = read_page(page)
    begin = text.index(BEGIN) + len(BEGIN)
    tables = "\n\n".join([_conditions(record), *map(markdown, collection_tables(record))])
    write_text(page, f"{text[:begin]}\n{wrapped(tables.rstrip())}\n{text[text.index(END, begin) :]}")


def read_page(page: Path) -> str:
    """Read a page of Markdown with the marks `BEGIN` and `END`.

    Raises
    ------
    FileError
        If it cannot be read or has no such marks.
    """
    try:
        text = page.read_text(encoding="utf-8")
    except (OSError, UnicodeError) as error:
        problem = error.strerror if isinstance(error, OSError) else error
        raise FileError(page, f"cannot be read: {problem}") from None
    if END not in text.partition(BEGIN)[2]:
        raise FileError(page, f"has no place for the tables: expected a line {BEGIN} and below it a line {END}")
    return text


def _conditions(record: CollectionRecord) -> str:
    """Describe the computer, the limit and the versions of other programs."""
    versions = [program.version for program in record.run if program.version and not program.own]
    others = f" Other programs: {escape(', '.join(versions))}." if versions else ""
    return f"{machine_words(record.machine)} A program has {record.limit:g} s for a mesh, on one thread.{others}"
