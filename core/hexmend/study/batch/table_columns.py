"""Columns of the table of a study: one declaration for CSV, Parquet and the check of stored rows."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from math import isfinite
from typing import Any

from hexmend.quality.summary import SUMMARY_QUANTITIES, Summary

#: Figures of `Summary` that a run changes; the table has them before and after.
CHANGED_FIGURES = tuple(key for key in SUMMARY_QUANTITIES if key not in ("hexes", "nodes", "free_nodes"))

_TYPES = {key: int if field.type == "int" else float for key, field in Summary.__dataclass_fields__.items()}


class Status(StrEnum):
    """End of a task; all but the first have a reason."""

    DONE = "done"
    UNREADABLE = "unreadable"
    FAILED = "failed"
    MEMORY = "out of memory"
    TIME = "out of time"
    #: The process or the machine failed, not the task; it may succeed another time.
    LOST = "lost"


def _figures(when: str) -> dict[str, type]:
    return {f"{key}_{when}": _TYPES[key] for key in CHANGED_FIGURES} | {f"objective_p1_{when}": float}


#: Columns that the client fills: mesh and case of the row, SHA-256 of the mesh file, key of the task.
PLACE = dict.fromkeys(("mesh", "case", "method", "parameters", "mesh_hash", "key"), str)

#: Columns that the process of a task fills.
ANSWER: dict[str, type] = {
    **dict.fromkeys(("status", "reason"), str),
    **dict.fromkeys(("hexes", "nodes", "free_nodes"), int),
    **_figures("before"),
    **_figures("after"),
    "boundary_distance": float,
    **dict.fromkeys(("worse", "outcome", "message"), str),
    **dict.fromkeys(("iterations", "kept"), int),
    **dict.fromkeys(("seconds", "setup_seconds", "task_seconds"), float),
    "threads": int,
    "peak_mb": float,
    "output": str,
}

#: All columns of the table, with their types; study-many.md describes them.
COLUMNS: dict[str, type] = PLACE | ANSWER


def answer(status: Status, reason: str = "", **figures: Any) -> dict[str, Any]:
    """Make the answer of a task; missing values and numbers that are not finite are None."""
    known = {
        name: None if isinstance(value, float) and not isfinite(value) else value for name, value in figures.items()
    }
    return dict.fromkeys(ANSWER) | known | {"status": str(status), "reason": reason}


def is_answer(row: object) -> bool:
    """Return True if data from a file is an answer: exactly these columns, each None or of its type."""
    return (
        isinstance(row, Mapping)
        and row.keys() == ANSWER.keys()
        and row["status"] in set(Status)
        and all(row[name] is None or _fits(row[name], type_) for name, type_ in ANSWER.items())
    )


def _fits(value: object, type_: type) -> bool:
    return type(value) is type_ or (type_ is float and type(value) is int)
