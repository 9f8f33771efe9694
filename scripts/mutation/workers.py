"""Workers that take one thing after another, each with a copy of the project, in child processes."""

from __future__ import annotations

import json
import os
import queue
import signal
import subprocess
import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TypeVar

from mutation.project import Copy, Project

T = TypeVar("T")


class Processes:
    """Runs tests in child processes, all of which can be ended together."""

    def __init__(self) -> None:
        self._running: set[subprocess.Popen] = set()
        self._lock = threading.Lock()
        self._ended = False

    def pytest(
        self,
        copy: Copy,
        files: Sequence[str],
        tests: Mapping[str, float] | None = None,
        sources: Sequence[str] | None = None,
        variables: Mapping[str, str] | None = None,
    ) -> tuple[int, dict[str, dict]]:
        """Run pytest in a copy.

        Parameters
        ----------
        copy : Copy
        files : sequence of str
            Files of tests.
        tests : mapping, optional
            Names of tests of these files to run, in their order, and their seconds, until one fails; all, if None.
        sources : sequence of str, optional
            Record the lines that tests run of these.
        variables : mapping, optional
            Of the environment.

        Returns
        -------
        code : int
            The exit status; minus a signal's number where that ended it.
        report : dict
            Of each test that was run: `outcome` where it did not pass, `seconds`, `lines`; empty where it was ended.
        """
        order, report = Path(f"{copy.folder}-order.json"), Path(f"{copy.folder}-report.json")
        what = {"folder": str(copy.folder), "sources": sources, "tests": tests, "report": str(report)}
        order.write_text(json.dumps(what), encoding="utf-8")
        report.unlink(missing_ok=True)
        first_ends = [] if tests is None else ["--exitfirst"]
        environment = copy.environment(MUTATION=str(order), **(variables or {}))
        code = self._run(copy.pytest(*first_ends, *files), copy.folder, environment)
        return code, json.loads(report.read_text(encoding="utf-8")) if report.exists() else {}

    def end(self) -> None:
        """End every child process and start none any more."""
        with self._lock:
            self._ended = True
            for process in self._running:
                _kill_group(process)

    def _run(self, command: list[str], folder: Path, environment: dict[str, str]) -> int:
        with self._lock:
            if self._ended:
                raise KeyboardInterrupt
            log = folder.with_name(f"{folder.name}.log").open("w")
            process = subprocess.Popen(
                command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                start_new_session=True,
            )  # fmt: skip
            self._running.add(process)
        with log:
            code = process.wait()
        with self._lock:
            self._running.discard(process)
            if self._ended:
                raise KeyboardInterrupt
        _kill_group(process)  # what a test has started and not ended
        return code


def in_copies(
    project: Project, jobs: int, items: Iterable[T], work: Callable[[T, Copy, Processes], None], name: str = "copy"
) -> None:
    """Call `work` for each item, in so many threads, each with a copy of the project; Ctrl-C ends them all."""
    waiting: queue.SimpleQueue[T] = queue.SimpleQueue()
    for item in items:
        waiting.put(item)
    processes, failures = Processes(), []

    def take(folder: str) -> None:
        try:
            copy = None
            while not failures:
                item = waiting.get_nowait()
                copy = copy or project.copy(folder)
                work(item, copy, processes)
        except (queue.Empty, KeyboardInterrupt):
            pass
        except BaseException as error:
            failures.append(error)

    threads = [threading.Thread(target=take, args=(f"{name}-{number}",)) for number in range(jobs)]
    for thread in threads:
        thread.start()
    try:
        for thread in threads:
            thread.join()
    except KeyboardInterrupt:
        processes.end()
        raise
    if failures:
        raise failures[0]


def _kill_group(process: subprocess.Popen) -> None:
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGKILL)
