"""Tasks on this machine: one for each core at a time, with equal shares of cores and memory."""

from __future__ import annotations

import threading
from collections.abc import Generator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import Any

from hexmend.kernels import cores, cores_for
from hexmend.run.memory import available
from hexmend.study.batch.process import run_task
from hexmend.study.batch.task import Task


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
