"""A task in a process of its own: what ends the process is a row with its reason, and ends nothing else."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import asdict
from time import monotonic
from typing import IO, Any

from hexmend.study.batch.process_group import end_group
from hexmend.study.batch.table_columns import Status, answer, is_answer
from hexmend.study.batch.task import Task

#: Seconds between looks at whether a task is still wanted.
LOOK = 0.25

_PROGRAM = """
import sys
sys.path[:] = sys.argv[1:]
from hexmend import __version__
from hexmend.study.batch.worker import main
main(__version__)
"""
_THREADS = ("HEXMEND_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")
#: What a process says last that may have no more memory.
_NO_MEMORY = ("MemoryError", "bad_alloc", "Cannot allocate memory", "Resource temporarily unavailable")


def run_task(
    task: Task, *, memory_mb: int, threads: int | None = None, unwanted: Callable[[], bool] = lambda: False
) -> dict[str, Any] | None:
    """Do a task in another process and wait for its answer.

    Parameters
    ----------
    task : Task
    memory_mb : int
        What it may use, where the task has no limit of its own.
    threads : int, optional
        It computes with; as the environment says if None.
    unwanted : callable
        Asked again and again; True ends the process.

    Returns
    -------
    dict or None
        As `hexmend.study.batch.table_columns.answer`; None where it became unwanted.
    """
    began = monotonic()
    own = dict.fromkeys(_THREADS, str(threads)) if threads else {}
    with tempfile.TemporaryFile() as said, tempfile.TemporaryFile() as errors:
        try:
            process = subprocess.Popen(
                [sys.executable, "-c", _PROGRAM, *sys.path],
                stdin=subprocess.PIPE,
                stdout=said,
                stderr=errors,
                env=os.environ | own,
                start_new_session=True,
            )
        except OSError as error:
            return answer(Status.LOST, f"No process could be started for it: {error.strerror or error}.")
        try:
            asked = {"task": asdict(task), "memory_mb": task.max_memory_mb or memory_mb}
            late = _wait(process, json.dumps(asked), task.max_seconds, unwanted)
        finally:
            if process.poll() is None:
                end_group(process.pid)
                process.wait()
            process.stdin.close()
        if late is None:
            return None
        row = _late(task) if late else _answer(process.returncode, said, errors)
    return row | {"task_seconds": round(monotonic() - began, 3)}


def _wait(process: subprocess.Popen, asked: str, seconds: float, unwanted: Callable[[], bool]) -> bool | None:
    """Wait for the process's end; True where it is out of time, None where it is unwanted."""
    end = monotonic() + seconds if seconds else float("inf")
    try:
        process.stdin.write(asked.encode() + b"\n")
        process.stdin.flush()
    except OSError:  # it has ended already, and has said why
        pass
    while True:
        try:
            process.wait(min(LOOK, max(0.0, end - monotonic())))
            return False
        except subprocess.TimeoutExpired:
            if unwanted():
                return None
            if monotonic() >= end:
                return True


def _late(task: Task) -> dict[str, Any]:
    return answer(Status.TIME, f"It was not done within {task.max_seconds:g} s, and was ended.")


def _answer(status: int, said: IO[bytes], errors: IO[bytes]) -> dict[str, Any]:
    said.seek(0)
    try:
        row = json.loads(said.read())
        if status == 0 and is_answer(row):
            return row
    except ValueError:
        pass
    last = _last_line(errors)
    if any(word in last for word in _NO_MEMORY):
        return answer(Status.MEMORY, f"It needed more memory than it may have: {last}")
    return answer(Status.LOST, f"Its process ended {_ending(status)}: {last}")


def _ending(status: int) -> str:
    if status >= 0:
        return f"with status {status}"
    name = signal.Signals(-status).name if -status in set(signal.Signals) else f"signal {-status}"
    return f"by {name}" + (", as the system ends what takes all memory" if name == "SIGKILL" else "")


def _last_line(errors: IO[bytes]) -> str:
    """The last line of what a process has said, short and printable."""
    errors.seek(max(0, errors.seek(0, os.SEEK_END) - 2000))
    lines = errors.read().decode(errors="replace").split("\n")
    last = next((line for line in reversed(lines) if line.strip()), "it did not say why.")
    return "".join(letter if letter.isprintable() else "?" for letter in last)[:300]
