"""What the process of a task does: read a mesh, run a method on it, and answer with a row."""

from __future__ import annotations

import json
import os
import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from hexmend import kernels
from hexmend.errors import FileError, HexmendError
from hexmend.io import read, read_surface, write
from hexmend.iteration import Result
from hexmend.mesh.mesh import Mesh
from hexmend.quality import summarise
from hexmend.run import smooth
from hexmend.study.batch.case import case_of
from hexmend.study.batch.process_group import end_group
from hexmend.study.batch.table_columns import CHANGING, Status, answer
from hexmend.study.batch.task import Task, content_hash
from hexmend.study.bench.section import peak_mb


def main(version: str) -> None:
    """Read a line from standard input, the task and its memory in MB; do it; print the answer as JSON.

    Standard input stays open while who has asked is alive: its end is that of this process and of all that it started.
    """
    said = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what libraries print is no answer
    with open(0, encoding="utf-8", closefd=False) as lines:
        asked = json.loads(lines.readline())
    threading.Thread(target=_end_with_who_asked, daemon=True).start()
    hold_memory(asked["memory_mb"])
    said.write(json.dumps(do(Task(**asked["task"]), version), allow_nan=False))
    said.flush()


def do(task: Task, version: str) -> dict[str, Any]:
    """The answer to a task, whatever happens in it; `version` is that of Hexmend here."""
    known = {"threads": kernels.threads()}
    try:
        _check_here(task, version)
        case = case_of(task.case)
        mesh = _mesh(task)
        known |= _sizes(mesh)
        result = smooth(mesh, case.what, case.stop)
        known |= _figures(result)
        if task.output:
            write(task.output, result.mesh)
            known["output"] = task.output
        status, reason = Status.DONE, ""
    except _Elsewhere as error:
        status, reason = Status.LOST, str(error)
    except FileError as error:
        status, reason = _of_file(task, error), str(error)
    except MemoryError:
        status, reason = Status.MEMORY, "It needed more memory than it may have."
    except HexmendError as error:
        status, reason = Status.FAILED, str(error)
    except Exception as error:  # of whatever kind: it is this task's, and the others go on
        status, reason = Status.FAILED, f"{type(error).__name__}: {error}".rstrip(": ")
    return answer(status, reason, **known, peak_mb=round(peak_mb(), 1))


def hold_memory(megabytes: int) -> None:
    """Have the system refuse this process more memory of its own than so much; 0 sets no limit.

    What counts is what it may write to and shares with no other process (RLIMIT_DATA), as Linux does since 4.7.
    """
    try:
        import resource
    except ImportError:  # Windows has none
        return
    if megabytes:
        hard = resource.getrlimit(resource.RLIMIT_DATA)[1]
        limit = megabytes << 20 if hard == resource.RLIM_INFINITY else min(megabytes << 20, hard)
        resource.setrlimit(resource.RLIMIT_DATA, (limit, hard))


class _Elsewhere(Exception):
    """What is here is not what the study was planned with."""


def _check_here(task: Task, version: str) -> None:
    if task.version != version:
        raise _Elsewhere(f"Hexmend is {version} where the task ran, and {task.version} where it was planned.")
    for path, planned in ((task.mesh, task.mesh_hash), (task.surface, task.surface_hash)):
        try:
            if path and content_hash(Path(path)) != planned:
                raise _Elsewhere(f"{Path(path).name} is another file where the task ran than where it was planned.")
        except FileError as error:
            raise _Elsewhere(f"Where the task ran: {error}") from None


def _mesh(task: Task) -> Mesh:
    mesh = read(task.mesh)
    return mesh.sliding_on(read_surface(task.surface)) if task.surface else mesh


def _of_file(task: Task, error: FileError) -> Status:
    if isinstance(error.__context__, MemoryError):
        return Status.MEMORY
    return Status.LOST if task.output and error.path == Path(task.output) else Status.UNREADABLE


def _sizes(mesh: Mesh) -> dict[str, Any]:
    figures = summarise(mesh).to_dict()
    return {key: figures[key] for key in ("hexes", "nodes", "free_nodes")} | {
        f"{key}_before": figures[key] for key in CHANGING
    }


def _figures(result: Result) -> Mapping[str, Any]:
    after = result.after.to_dict()
    return {
        **{f"{key}_after": after[key] for key in CHANGING},
        "worse": " ".join(result.worse),
        "outcome": result.outcome.key,
        "message": result.message,
        "iterations": result.iterations,
        "kept": result.kept,
        "seconds": result.seconds,
        "setup_seconds": result.setup_seconds,
    }


def _end_with_who_asked() -> None:
    while os.read(0, 1):
        pass
    end_group(os.getpid())
