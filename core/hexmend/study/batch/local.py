"""Tasks on this machine: as many at a time as there are cores, each with its share of cores and memory."""

from __future__ import annotations

import os
import threading
from collections.abc import Generator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import Any

from hexmend.run.memory import available
from hexmend.study.batch.process import run_task
from hexmend.study.batch.task import Task


class Local:
    """Does tasks in processes of this machine.

    Parameters
    ----------
    jobs : int
        Most tasks at a time; 0 for as many as this process may use cores.
    """

    def __init__(self, jobs: int = 0):
        self._jobs = jobs

    def answers(self, tasks: Sequence[Task]) -> Generator[tuple[Task, dict[str, Any]]]:
        """Each task with its answer, as it is done. Leaving it ends what is at work.

        Cores that are left over are the tasks' threads: with one task it has all of them.
        """
        here = cores()
        jobs = max(1, min(self._jobs or here, len(tasks)))
        memory_mb, threads, ending = (available() or 0) // jobs >> 20, max(1, here // jobs), threading.Event()
        with ThreadPoolExecutor(jobs) as pool:
            try:
                done = {
                    pool.submit(run_task, task, memory_mb=memory_mb, threads=threads, unwanted=ending.is_set): task
                    for task in tasks
                }
                for future in as_completed(done):
                    yield done[future], future.result()
            finally:
                ending.set()
                pool.shutdown(cancel_futures=True)


def cores() -> int:
    """How many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
