"""One fault tried: the tests that reach it run in a copy of the project until the first fails."""

from __future__ import annotations

import signal
import time
from collections.abc import Mapping
from dataclasses import dataclass

from mutation.project import Copy
from mutation.workers import Processes

FOUND, SURVIVED, TIMED_OUT, EQUIVALENT = "found", "survived", "timed out", "equivalent"

#: Exit statuses of pytest: all passed, no test was collected.
_PASSED, _NONE = 0, 5


@dataclass(frozen=True)
class Result:
    """What became of a fault: an outcome, the test that found it or a remark, and seconds."""

    outcome: str
    by: str
    seconds: float


def tried(copy: Copy, processes: Processes, tests: Mapping[str, float], **variables: str) -> Result:
    """Run `tests` in a copy that holds a fault, until one fails.

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
        if code not in (_PASSED, _NONE):
            failed = (name for name, entry in report.items() if entry.get("outcome") == "failed")
            return result(FOUND, next(failed, f"exit status {code}"))
    return result(SURVIVED, f"{len(tests)} tests pass" if tests else "there are no tests")
