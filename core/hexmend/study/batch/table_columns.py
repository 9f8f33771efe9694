"""Columns of the table of a study: one declaration for CSV, Parquet, the check of stored rows, and docs."""

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
    """Column with name, type and a sentence of help."""

    name: str
    type: type
    help: str


def _figures(when: str, description: str) -> tuple[Column, ...]:
    return tuple(
        Column(f"{key}_{when}", _TYPES[key], f"{label[:1].upper()}{label[1:]}, {description}.")
        for key, label in ((key, SUMMARY_QUANTITIES[key].label) for key in CHANGED_FIGURES)
    ) + (Column(f"objective_p1_{when}", float, f"Objective with p = 1, Σ η, {description}."),)


#: Columns that the client fills: mesh and case of the row.
PLACE = (
    Column("mesh", str, "The mesh file, as given on the command line."),
    Column("case", str, "Name of the case: the method with its values from the lists."),
    Column("method", str, "The method's name, or a recipe's title."),
    Column("parameters", str, "All values of the method, as `name=value` words; empty for a recipe."),
    Column("mesh_hash", str, "SHA-256 of the mesh file."),
    Column("key", str, "Key of the task; its result is `tasks/KEY.json`."),
)

#: Columns that the process of a task fills.
ANSWER = (
    Column("status", str, f"End of the task: {', '.join(Status)}."),
    Column("reason", str, "Reason if there is no result, as a sentence."),
    Column("hexes", int, "Number of hexes."),
    Column("nodes", int, "Number of nodes of hexes."),
    Column("free_nodes", int, "Number of nodes that are not fixed."),
    *_figures("before", "of the initial mesh"),
    *_figures("after", "of the result"),
    Column(
        "boundary_distance",
        float,
        "Largest distance between the boundaries of the initial mesh and the result, in per cent of the diagonal of "
        "its bounding box; with a surface, between that and the result.",
    ),
    Column(
        "worse", str, "Quantities that became worse: inverted, invalid, q_min, scaled_jacobian, q_of_target, layers."
    ),
    Column("outcome", str, "Reason for the end of the run, as in `smooth --json`."),
    Column("message", str, "The reason with its figures, in sentences."),
    Column("iterations", int, "Iterations until the run ended."),
    Column("kept", int, "Number of the iteration that is the result."),
    Column("seconds", float, "Seconds in the method, without its preparation."),
    Column("setup_seconds", float, "Seconds of the preparation of the method."),
    Column("task_seconds", float, "Seconds of the whole process, including start, reading and writing."),
    Column("threads", int, "Number of threads of the task."),
    Column("peak_mb", float, "Peak memory of the process in MiB."),
    Column("output", str, "The mesh file that was written, with `--write-meshes`."),
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
