"""One fault tried: the tests that reach it run in a copy of the project until the first fails."""

from __future__ import annotations

import signal
import time
from collections.abc import Mapping
from dataclasses import dataclass

from mutation.project import Copy
from mutation.workers import Processes

FOUND, SURVIVED, TIMED_OUT, EQUIVALENT, ERROR = "found", "survived", "timed out", "equivalent", "error"

#: Exit statuses of pytest: all passed, no test was collected.
_PASSED, _NONE = 0, 5
#: Signals that end a process with invalid memory accesses or an abort, caused by a fault.
_CRASHES = signal.SIGSEGV, signal.SIGBUS, signal.SIGABRT, signal.SIGFPE, signal.SIGILL


@dataclass(frozen=True)
class Result:
    """Result of a fault: an outcome, the test that found it or a remark, and seconds."""

    outcome: str
    by: str
    seconds: float


def tried(copy: Copy, processes: Processes, tests: Mapping[str, float], **variables: str) -> Result:
    """Run `tests` in a copy that holds a fault, until one fails.

    A fault is found where a test fails or cannot be collected, or where the process crashes. Where pytest ends in
    another way (it cannot run, or the system kills it), nothing is known of the fault: the outcome is an error.

    Parameters
    ----------
    copy : Copy
    processes : Processes
    tests : mapping
        Names of tests, in the order in which they are run, and their seconds without a fault.
    **variables
        Of the environment.
    """
    began = time.perf_counter()

    def result(outcome: str, by: str) -> Result:
        return Result(outcome, by, round(time.perf_counter() - began, 1))

    for group in copy.project.sessions(tests):
        files = list(dict.fromkeys(name.split("::")[0] for name in group))
        code, report = processes.pytest(copy, files, {name: tests[name] for name in group}, variables=variables)
        if -code in (signal.SIGPROF, signal.SIGALRM):
            return result(TIMED_OUT, "")
        if -code in _CRASHES:
            return result(FOUND, f"{signal.Signals(-code).name} ended the tests")
        failed = next((name for name, entry in report.items() if entry.get("outcome") == "failed"), None)
        if failed is not None:
            return result(FOUND, failed)
        if code not in (_PASSED, _NONE):
            return result(ERROR, f"pytest ended with status {code}: see {copy.folder}.log")
    return result(SURVIVED, f"{len(tests)} tests pass" if tests else "there are no tests")
