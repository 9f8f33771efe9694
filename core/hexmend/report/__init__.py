"""Reports: records for programs; tables and figures for people."""

from hexmend.report.records import HISTORY, record, to_json, write_history, write_json

__all__ = ["HISTORY", "record", "to_json", "write_history", "write_json"]
