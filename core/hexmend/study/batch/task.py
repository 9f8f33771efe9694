"""Task of a study: one case on one mesh, with the key of its result.

Store of answers: a small file each, named by the key of the task, written as a whole or not at all.

Columns of the table of a study: one declaration for CSV, Parquet and the check of stored rows.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from math import isfinite
from pathlib import Path
from typing import Any

from hexmend.errors import FileError
from hexmend.io.files import check_readable
from hexmend.io.format_lookup import format_by_place
from hexmend.io.formats.vtk.pvtu import piece_paths
from hexmend.io.storage.atomic import atomic_write
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


@dataclass(frozen=True)
class Task:
    """Case on one mesh, as data for another process or machine.

    Parameters
    ----------
    mesh : str
        Absolute path.
    mesh_hash : str
        SHA-256 of its content, `content_hash`.
    case : mapping
        `Case.values`.
    version : str
        Version of Hexmend.
    max_seconds : float
        0 for no limit.
    max_memory_mb : int
        0 for a share of the memory of the machine.
    surface, surface_hash : str
        Path and hash of the surface on which the boundary slides; "" if there is none.
    output : str
        Absolute path of the mesh to be written; "" for none.
    """

    mesh: str
    mesh_hash: str
    case: Mapping[str, Any]
    version: str
    max_seconds: float = 0.0
    max_memory_mb: int = 0
    surface: str = ""
    surface_hash: str = ""
    output: str = ""

    @property
    def key(self) -> str:
        """Hash, 32 hexadecimal digits, of all that the result depends on, which paths are not."""
        suffix = Path(self.mesh).suffix.lower()  # selects the format
        content = [self.version, self.mesh_hash, suffix, self.surface_hash, self.case]
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:32]


def content_hash(path: Path) -> str:
    """Return the SHA-256 of a file, in hexadecimal digits; of a PVTU file with its pieces, of a case its mesh.

    Parameters
    ----------
    path : Path

    Returns
    -------
    str

    Raises
    ------
    FileError
        If it cannot be read.
    """
    placed = format_by_place(path)
    if placed is None:
        check_readable(path, "a mesh file")
    try:
        parts = [path] if placed is None else list(placed.place.parts(path))
        if placed is None and path.suffix.lower() == ".pvtu":
            parts += [piece for piece in piece_paths(path) if piece.is_file()]
        digests = [_digest(part) for part in parts]
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}") from None
    return digests[0] if len(digests) == 1 else hashlib.sha256("".join(digests).encode()).hexdigest()


def _digest(path: Path) -> str:
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


#: Most bytes of a file; only the message of a run varies in length.
_MOST = 1_000_000

#: Failures that another limit may turn into a result, with the name of the limit.
_LIMITED = {Status.TIME: "max_seconds", Status.MEMORY: "max_memory_mb"}


class Store:
    """Answers in a folder.

    Parameters
    ----------
    folder : Path
        Exists already.
    """

    def __init__(self, folder: Path):
        self._folder = folder

    def load(self, task: Task) -> dict[str, Any] | None:
        """Return the stored answer, None if the task is to be run.

        It is run again if the process was lost, if it failed by a limit that has changed, or if the mesh that it wrote
        is missing. Files without a valid answer are ignored.
        """
        path = self._path(task)
        try:
            if path.stat().st_size > _MOST:
                return None
            stored = json.loads(path.read_bytes())
        except (OSError, ValueError, RecursionError):
            return None
        if not isinstance(stored, dict) or stored.get("key") != task.key or not is_answer(stored.get("answer")):
            return None
        row = stored["answer"]
        if row["status"] == Status.LOST or not _same_limit(task, row["status"], stored.get("limits")):
            return None
        if row["status"] == Status.DONE and task.output and not Path(task.output).is_file():
            return None
        return row

    def save(self, task: Task, row: Mapping[str, Any]) -> None:
        """Store an answer; it replaces an older one."""
        stored = {
            "key": task.key,
            "hexmend": task.version,
            **{key: getattr(task, key) for key in ("mesh", "mesh_hash", "surface_hash", "case")},
            "limits": {"max_seconds": task.max_seconds, "max_memory_mb": task.max_memory_mb},
            "answer": dict(row),
        }
        with atomic_write(self._path(task)) as temporary:
            temporary.write_text(json.dumps(stored, indent=1, allow_nan=False) + "\n", encoding="utf-8")

    def _path(self, task: Task) -> Path:
        return self._folder / f"{task.key}.json"


def _same_limit(task: Task, status: str, limits: object) -> bool:
    name = _LIMITED.get(Status(status))
    if name is None:
        return True
    limit = getattr(task, name)  # 0: a share of the memory that was free then
    return isinstance(limits, dict) and limits.get(name) == limit != 0
