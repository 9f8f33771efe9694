"""Columns of the table of a study: one declaration for CSV, Parquet and the check of stored rows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
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


@dataclass(frozen=True)
class Column:
    """Column with name and type; study-many.md describes them."""

    name: str
    type: type


def _columns(type_: type, names: str) -> tuple[Column, ...]:
    return tuple(Column(name, type_) for name in names.split())


def _figures(when: str) -> tuple[Column, ...]:
    return (*(Column(f"{key}_{when}", _TYPES[key]) for key in CHANGED_FIGURES), Column(f"objective_p1_{when}", float))


#: Columns that the client fills: mesh and case of the row, SHA-256 of the mesh file, key of the task.
PLACE = _columns(str, "mesh case method parameters mesh_hash key")

#: Columns that the process of a task fills.
ANSWER = (
    *_columns(str, "status reason"),
    *_columns(int, "hexes nodes free_nodes"),
    *_figures("before"),
    *_figures("after"),
    Column("boundary_distance", float),
    *_columns(str, "worse outcome message"),
    *_columns(int, "iterations kept"),
    *_columns(float, "seconds setup_seconds task_seconds"),
    Column("threads", int),
    Column("peak_mb", float),
    Column("output", str),
)

COLUMNS = PLACE + ANSWER


def answer(status: Status, reason: str = "", **figures: Any) -> dict[str, Any]:
    """Make the answer of a task; missing values and numbers that are not finite are None."""
    known = {
        name: None if isinstance(value, float) and not isfinite(value) else value for name, value in figures.items()
    }
    return {column.name: None for column in ANSWER} | known | {"status": str(status), "reason": reason}


def is_answer(row: object) -> bool:
    """Return True if data from a file is an answer: exactly these columns, each None or of its type."""
    return (
        isinstance(row, Mapping)
        and set(row) == {column.name for column in ANSWER}
        and row["status"] in set(Status)
        and all(row[column.name] is None or _fits(row[column.name], column.type) for column in ANSWER)
    )


def _fits(value: object, type_: type) -> bool:
    return type(value) is type_ or (type_ is float and type(value) is int)
