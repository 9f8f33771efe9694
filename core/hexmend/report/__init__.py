"""Reports: records for programs; tables and figures for people."""

from hexmend.report.comparison import comparison_rows, comparison_table, table_of, write_comparison
from hexmend.report.documents import made_folder, write_csv, write_documents, write_text
from hexmend.report.latex import latex
from hexmend.report.markdown import markdown
from hexmend.report.records import HISTORY, record, to_json, write_history, write_json
from hexmend.report.tables import Table
from hexmend.report.thesis import write_experiment, write_study

__all__ = [
    "HISTORY",
    "Table",
    "comparison_rows",
    "comparison_table",
    "latex",
    "made_folder",
    "markdown",
    "record",
    "table_of",
    "to_json",
    "write_comparison",
    "write_csv",
    "write_documents",
    "write_experiment",
    "write_history",
    "write_json",
    "write_study",
    "write_text",
]
