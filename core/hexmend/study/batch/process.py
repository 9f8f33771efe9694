"""Task in its own process: if the process crashes, its row has the reason, and other tasks continue.

Groups of processes: a process with all that it started is ended at once.

Tasks on this machine: one for each core at a time, with equal shares of cores and memory.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import suppress
from dataclasses import asdict
from time import monotonic
from typing import IO, Any

from hexmend.io.storage.subprocess_reader import last_line, wait_for
from hexmend.kernels import cores, cores_for
from hexmend.run.memory import available
from hexmend.study.batch.task import Status, Task, answer, is_answer


def end_group(number: int) -> None:
    """End the leader of a process group and all of the group; does nothing if it has ended.

    Parameters
    ----------
    number : int
        Process id of the leader.
    """
    with suppress(ProcessLookupError, PermissionError):
        if hasattr(os, "killpg"):
            os.killpg(number, signal.SIGKILL)
        else:
            os.kill(number, signal.SIGTERM)


#: Seconds between checks whether a task was cancelled.
POLL_SECONDS = 0.25

_PROGRAM = """
import sys
sys.path[:] = sys.argv[1:]
from hexmend import __version__
from hexmend.study.batch.worker import main
main(__version__)
"""
_THREADS = ("HEXMEND_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")
#: Texts in the last line of a process that ran out of memory.
_NO_MEMORY = ("MemoryError", "bad_alloc", "Cannot allocate memory", "Resource temporarily unavailable")


def run_task(
    task: Task, *, memory_mb: int, threads: int | None = None, cancelled: Callable[[], bool] = lambda: False
) -> dict[str, Any] | None:
    """Run a task in another process and wait for its answer.

    Parameters
    ----------
    task : Task
    memory_mb : int
        Memory limit of a task without its own.
    threads : int, optional
        Number of threads; that of the environment if None.
    cancelled : callable
        Called repeatedly; True ends the process.

    Returns
    -------
    dict or None
        See `hexmend.study.batch.task.answer`; None if it was cancelled.
    """
    began = monotonic()
    environment = dict.fromkeys(_THREADS, str(threads)) if threads else {}
    with tempfile.TemporaryFile() as output, tempfile.TemporaryFile() as errors:
        try:
            process = subprocess.Popen(
                [sys.executable, "-c", _PROGRAM, *sys.path],
                stdin=subprocess.PIPE,
                stdout=output,
                stderr=errors,
                env=os.environ | environment,
                start_new_session=True,
            )
        except OSError as error:
            return answer(Status.LOST, f"No process could be started for it: {error.strerror or error}.")
        try:
            request = {"task": asdict(task), "memory_mb": task.max_memory_mb or memory_mb}
            late = _wait(process, json.dumps(request), task.max_seconds, cancelled)
        finally:
            if process.poll() is None:
                end_group(process.pid)
                process.wait()
            process.stdin.close()
        if late is None:
            return None
        if late:
            row = answer(Status.TIME, f"It was not done within {task.max_seconds:g} s, and was ended.")
        else:
            row = _answer(process.returncode, output, errors)
    return row | {"task_seconds": round(monotonic() - began, 3)}


def _wait(process: subprocess.Popen, request: str, seconds: float, cancelled: Callable[[], bool]) -> bool | None:
    """Wait for the end of the process. Return True if it is out of time, None if it was cancelled."""
    with suppress(OSError):  # it has ended already; its last line has the reason
        process.stdin.write(request.encode() + b"\n")
        process.stdin.flush()
    return wait_for(process, seconds or float("inf"), POLL_SECONDS, cancelled)


def _answer(status: int, output: IO[bytes], errors: IO[bytes]) -> dict[str, Any]:
    output.seek(0)
    try:
        row = json.loads(output.read())
        if status == 0 and is_answer(row):
            return row
    except ValueError:
        pass
    last = last_line(errors)
    if any(word in last for word in _NO_MEMORY):
        return answer(Status.MEMORY, f"It needed more memory than it may have: {last}")
    return answer(Status.LOST, f"Its process ended {_ending(status)}: {last}")


def _ending(status: int) -> str:
    if status >= 0:
        return f"with status {status}"
    name = signal.Signals(-status).name if -status in set(signal.Signals) else f"signal {-status}"
    return f"by {name}" + (", as the system ends what takes all memory" if name == "SIGKILL" else "")


def local_answers(tasks: Sequence[Task], jobs: int = 0) -> Generator[tuple[Task, dict[str, Any]]]:
    """Run tasks in processes of this machine, and yield each with its answer when it is done.

    Closing the generator ends running tasks. Unless their number is set, tasks share the cores as threads: a single
    task has all of them.

    Parameters
    ----------
    tasks : sequence of Task
    jobs : int
        Most tasks at a time; 0 for the number of cores that this process may use.
    """
    jobs = max(1, min(jobs or cores(), len(tasks)))
    memory_mb, threads, ending = (available() or 0) // jobs >> 20, cores_for(jobs), threading.Event()
    with ThreadPoolExecutor(jobs) as pool:
        try:
            running = {
                pool.submit(run_task, task, memory_mb=memory_mb, threads=threads, cancelled=ending.is_set): task
                for task in tasks
            }
            for future in as_completed(list(running)):
                yield running.pop(future), future.result()
        finally:
            ending.set()
            pool.shutdown(cancel_futures=True)
