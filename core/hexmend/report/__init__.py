"""Reports: records for programs, tables and charts for readers.

Names are imported at their first use, so that a command that writes a record loads no tables and charts.
"""

import importlib as _importlib
from typing import TYPE_CHECKING as _TYPE_CHECKING

from hexmend.report.latex import latex  # functions named like their modules, which would hide them if imported later
from hexmend.report.markdown import markdown

if _TYPE_CHECKING:
    from hexmend.report.comparison import comparison_rows, comparison_table, record_table, write_comparison
    from hexmend.report.documents import output_folder, write_csv, write_documents, write_text
    from hexmend.report.records import record, to_json, write_history, write_json
    from hexmend.report.tables import Table

_HOMES = {
    "comparison": ("comparison_rows", "comparison_table", "record_table", "write_comparison"),
    "documents": ("output_folder", "write_csv", "write_documents", "write_text"),
    "records": ("record", "to_json", "write_history", "write_json"),
    "tables": ("Table",),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [
    "Table",
    "comparison_rows",
    "comparison_table",
    "latex",
    "markdown",
    "output_folder",
    "record",
    "record_table",
    "to_json",
    "write_comparison",
    "write_csv",
    "write_documents",
    "write_history",
    "write_json",
    "write_text",
]


def __getattr__(name: str) -> object:
    if name in _HOME_OF:
        return getattr(_importlib.import_module(f"{__name__}.{_HOME_OF[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
