"""Process of a task: reads a mesh, runs a method on it, and answers with a row."""

from __future__ import annotations

import json
import os
import threading
from pathlib import Path
from typing import Any

from hexmend import kernels
from hexmend.errors import FileError, HexmendError
from hexmend.io import read, read_surface, write
from hexmend.io.storage.subprocess_reader import limit_memory
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.resolution import with_rules
from hexmend.quality import SUMMARY_QUANTITIES, measure, objective, summarise
from hexmend.run import smooth
from hexmend.run.memory import peak_mb
from hexmend.study.batch.case import read_case
from hexmend.study.batch.process import end_group
from hexmend.study.batch.task import Status, Task, answer, content_hash


def main(version: str) -> None:
    """Read the task and its memory limit (MiB) from a line of standard input, run it, and print the answer as JSON.

    The client keeps standard input open while it is alive: when it closes, this process and all that it started end.
    """
    output = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # output of libraries goes to standard error
    with open(0, encoding="utf-8", closefd=False) as lines:
        request = json.loads(lines.readline())
    threading.Thread(target=_exit_with_client, daemon=True).start()
    if request["memory_mb"]:
        limit_memory("RLIMIT_DATA", request["memory_mb"] << 20)  # private, writable memory; Linux since 4.7
    output.write(json.dumps(run(Task(**request["task"]), version), allow_nan=False))
    output.flush()


def run(task: Task, version: str) -> dict[str, Any]:
    """Run a task and return its answer, also if it fails; `version` is that of Hexmend in this process."""
    row = {"threads": kernels.threads()}
    try:
        _check_environment(task, version)
        case = read_case(task.case)
        mesh = read(task.mesh)
        mesh = mesh.sliding_on(read_surface(task.surface)) if task.surface else mesh
        figures = _figures(mesh)
        row |= {key: figures.pop(key) for key in ("hexes", "nodes", "free_nodes")}
        row |= {f"{key}_before": value for key, value in figures.items()}
        result = smooth(with_rules(mesh, case.rules) if case.rules else mesh, case.smoother, case.stop, progress=False)
        more = {key: getattr(result, key) for key in ("message", "iterations", "kept", "seconds", "setup_seconds")}
        more |= {"worse": " ".join(result.worse), "outcome": result.outcome.key}
        more["boundary_distance"] = result.surface.max_percent_of_diagonal if result.surface else 0.0
        row |= {f"{key}_after": value for key, value in _figures(result.mesh).items() if key in figures}
        row |= more
        if task.output:
            write(task.output, result.mesh)
            row["output"] = task.output
        status, reason = Status.DONE, ""
    except _Mismatch as error:
        status, reason = Status.LOST, str(error)
    except FileError as error:
        status, reason = _status_of(task, error), str(error)
    except MemoryError:
        status, reason = Status.MEMORY, "It needed more memory than it may have."
    except HexmendError as error:
        status, reason = Status.FAILED, str(error)
    except Exception as error:  # fails this task only
        status, reason = Status.FAILED, f"{type(error).__name__}: {error}".rstrip(": ")
    return answer(status, reason, **row, peak_mb=round(peak_mb(), 1))


class _Mismatch(Exception):
    """Hexmend or a file differs from the client's."""


def _check_environment(task: Task, version: str) -> None:
    if task.version != version:
        raise _Mismatch(f"Hexmend is {version} where the task ran, and {task.version} where it was planned.")
    for path, planned in ((task.mesh, task.mesh_hash), (task.surface, task.surface_hash)):
        try:
            if path and content_hash(Path(path)) != planned:
                raise _Mismatch(f"{Path(path).name} is another file where the task ran than where it was planned.")
        except FileError as error:
            raise _Mismatch(f"Where the task ran: {error}") from None


def _status_of(task: Task, error: FileError) -> Status:
    if isinstance(error.__context__, MemoryError):
        return Status.MEMORY
    return Status.LOST if task.output and error.path == Path(task.output) else Status.UNREADABLE


def _figures(mesh: Mesh) -> dict[str, Any]:
    """Return the figures of `Summary`, and the objective with p = 1."""
    quality = measure(mesh.points, mesh.elements, mesh.mid_nodes)
    figures = summarise(mesh, quality).to_dict()
    return {key: figures[key] for key in SUMMARY_QUANTITIES} | {"objective_p1": objective(quality, p=1.0)}


def _exit_with_client() -> None:
    while os.read(0, 1):
        pass
    end_group(os.getpid())
