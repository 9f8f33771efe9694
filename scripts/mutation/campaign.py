"""Many faults tried by workers, with results that are kept as they come."""

from __future__ import annotations

import json
import os
import threading
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from pathlib import Path

from mutation.operators import Mutant
from mutation.project import Copy, Project
from mutation.reach import Reach
from mutation.trial import EQUIVALENT, ERROR, Result, tried
from mutation.workers import Processes, in_copies


@dataclass(frozen=True)
class Row:
    """A fault with what became of it, as the results hold it."""

    id: str
    path: str
    function: str
    operator: str
    line: int
    diff: str
    outcome: str
    by: str
    seconds: float
    tests: str


class Results:
    """Rows of a campaign in a file, written after each."""

    def __init__(self, path: Path):
        self._path, self._lock = path, threading.Lock()
        self.rows: dict[str, Row] = {}
        if path.exists():
            self.rows = {one["id"]: Row(**one) for one in json.loads(path.read_text(encoding="utf-8"))}

    def add(self, row: Row) -> None:
        with self._lock:
            self.rows[row.id] = row
            beside = self._path.with_suffix(".new")
            beside.write_text(json.dumps([asdict(one) for one in self.rows.values()], indent=1), encoding="utf-8")
            os.replace(beside, self._path)

    def has(self, mutant: Mutant, tests: str) -> bool:
        """Return True if the outcome of this fault is known for the tests with the digest `tests`."""
        row = self.rows.get(mutant.id)
        same = row is not None and row.diff == mutant.diff and row.tests == tests
        return same and row.outcome not in (EQUIVALENT, ERROR)


def try_all(
    project: Project,
    reach: Reach,
    mutants: Iterable[Mutant],
    reasons: Callable[[Mutant], str | None],
    results: Results,
    jobs: int,
) -> None:
    """Try mutants whose result is not known.

    Parameters
    ----------
    project : Project
    reach : Reach
        Measured.
    mutants : iterable of Mutant
    reasons : callable
        Why a mutant does the same as the original; None where it does not.
    results : Results
        Rows are added to it.
    jobs : int
        Processes at a time.
    """
    waiting = []
    for mutant in mutants:
        reason = reasons(mutant)
        if reason is not None:
            results.add(row_of(mutant, Result(EQUIVALENT, reason, 0.0), ""))
        elif not results.has(mutant, reach.digest(reach.tests(mutant))):
            waiting.append(mutant)

    def work(mutant: Mutant, copy: Copy, processes: Processes) -> None:
        tests = reach.tests(mutant)
        copy.write(mutant.path, mutant.mutated)
        try:
            result = tried(copy, processes, tests)
        finally:
            copy.write(mutant.path, mutant.source)
        row = row_of(mutant, result, reach.digest(tests))
        results.add(row)
        say(row)

    in_copies(project, jobs, waiting, work)


def say(row: Row) -> None:
    """Print a line of a result."""
    print(f"{row.outcome:10} {row.seconds:6.1f} s  {row.id}  {row.path}:{row.line}  {row.by}", flush=True)


def row_of(mutant: Mutant, result: Result, tests: str) -> Row:
    """A row of the results; `tests` is the digest of the tests that were chosen."""
    return Row(
        mutant.id,
        mutant.path,
        mutant.function,
        mutant.operator,
        mutant.first,
        mutant.diff,
        result.outcome,
        result.by,
        result.seconds,
        tests,
    )
