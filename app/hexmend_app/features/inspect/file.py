"""The list of the worst as a file."""

from __future__ import annotations

from pathlib import Path

from hexmend.io.suffixes import suffix_for
from hexmend.report.documents import write_text
from hexmend_app.features.inspect.worst_list import WorstList


def write_worst(path: Path, worst_list: WorstList) -> None:
    """Write the list as it is shown, as CSV.

    Raises
    ------
    FileError
        For another suffix, or where the file cannot be written; the one that was there stays.
    """
    suffix_for(path, "a list", (".csv",))
    write_text(path, worst_list.text())
