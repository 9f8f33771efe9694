"""Lines of the sources that each test runs, and its duration; measured once and stored."""

from __future__ import annotations

import hashlib
import json
import threading
from collections.abc import Iterable, Sequence
from pathlib import Path, PurePosixPath

from mutation.operators import Mutant
from mutation.project import Copy, Project
from mutation.workers import Processes, in_copies

#: Files of the measure: what a file of tests did, when it and the sources that it ran were as these digests say.
_KEPT = "reach.json"
#: How many files of tests a process runs: what it has measured is kept when it ends.
_TOGETHER = 15
#: The nearness of a file of tests that is named after a source.
_NAMED = 2


class Reach:
    """Lines that tests run.

    Parameters
    ----------
    project : Project
    sources : sequence of str
        Paths of the sources that are looked at.
    seconds : float
        How long the tests chosen for a mutant may take together, without a fault.
    """

    def __init__(self, project: Project, sources: Sequence[str], seconds: float):
        self._project, self._sources, self._most = project, list(sources), seconds
        self._kept = project.build / _KEPT
        self._digests: dict[str, str] = {}
        self._lock = threading.Lock()
        self.files: dict[str, dict] = json.loads(self._kept.read_text()) if self._kept.exists() else {}

    def measure(self, jobs: int) -> None:
        """Run the files of tests whose measure is missing or out of date, in so many processes at a time."""
        found = self._test_files()
        self.files = {path: entry for path, entry in self.files.items() if path in found}
        stale = [path for path in found if not self._is_fresh(path)]
        if stale:
            print(f"Recording which lines {len(stale)} files of tests run.", flush=True)
        groups = [
            group[first : first + _TOGETHER]
            for group in self._project.sessions(stale)
            for first in range(0, len(group), _TOGETHER)
        ]
        in_copies(self._project, jobs, groups, self._record)

    def _record(self, files: Sequence[str], copy: Copy, processes: Processes) -> None:
        code, report = processes.pytest(copy, files, sources=self._sources)
        if code not in (0, 1):
            raise SystemExit(f"the tests cannot be run without a fault: see {copy.folder}.log")
        with self._lock:
            for path in files:
                own = {name: entry for name, entry in report.items() if name.split("::")[0] == path}
                reached = {source for entry in own.values() for source in entry["lines"]}
                digests = {source: _digest(copy.folder / source) for source in sorted({path} | reached)}
                self.files[path] = {"digests": digests, "sources": self._sources, "tests": own}
            self._kept.write_text(json.dumps(self.files), encoding="utf-8")

    def tests(self, mutant: Mutant) -> dict[str, float]:
        """Tests that run a mutant's lines with their seconds; the likeliest to find it first.

        Where the lines run only at import, or no test is known to run them, these are the tests that run anything of
        the file or are named after it; where there are none either, any tests, those of the same folder first.
        """
        lines = frozenset(range(mutant.first, mutant.last + 1))
        chosen = {} if mutant.at_import else self._running(mutant.path, lines)
        near = sorted(self.files, key=lambda path: -_nearness(path, mutant.path))
        return chosen or self._running(mutant.path, None) or self.all_tests(near)

    def _running(self, source: str, lines: frozenset[int] | None) -> dict[str, float]:
        """Tests that run some lines of a source; without lines, that run any of it or are named after it."""
        chosen: dict[str, dict[str, float]] = {}
        for path, entry in self.files.items():
            named = _nearness(path, source) == _NAMED
            for name, test in entry["tests"].items():
                reached = test["lines"].get(source, ())
                if "outcome" not in test and (reached or named if lines is None else lines.intersection(reached)):
                    chosen.setdefault(path, {})[name] = test["seconds"]
        ranked = sorted(chosen, key=lambda path: (-_nearness(path, source), sum(chosen[path].values())))
        return self._within_limit(
            {name: chosen[path][name] for path in ranked for name in sorted(chosen[path], key=chosen[path].get)}
        )

    def _within_limit(self, tests: dict[str, float]) -> dict[str, float]:
        """The first of some tests that take no longer together than they may; those too slow for the rest left out."""
        taken, left = {}, self._most
        for name, seconds in tests.items():
            if not taken or seconds <= left:
                taken[name] = seconds
                left -= seconds
        return taken

    def digest(self, tests: Iterable[str]) -> str:
        """A digest of the names of tests and of the files that hold them."""
        words = sorted(f"{name} {self._digest(name.split('::')[0])}" for name in tests)
        return hashlib.sha256("\n".join(words).encode()).hexdigest()[:16]

    def all_tests(self, first: Iterable[str] = ()) -> dict[str, float]:
        """Tests that passed with their seconds, those of some files first, as many as the limit allows."""
        first = list(first)
        ranked = sorted(self.files, key=lambda path: first.index(path) if path in first else len(first))
        return self._within_limit(
            {
                name: test["seconds"]
                for path in ranked
                for name, test in self.files[path]["tests"].items()
                if "outcome" not in test
            }
        )

    def left_out(self) -> list[str]:
        """Tests that failed or were skipped without any fault."""
        return [name for entry in self.files.values() for name, test in entry["tests"].items() if "outcome" in test]

    def _test_files(self) -> list[str]:
        """Paths of files that hold tests: by their names, or sources with examples."""
        files = []
        for folder in self._project.tests:
            for path in sorted((self._project.root / folder).rglob("*.py")):
                if path.name.startswith("test_") or ">>> " in path.read_text(encoding="utf-8"):
                    files.append(path.relative_to(self._project.root).as_posix())
        return files

    def _is_fresh(self, path: str) -> bool:
        entry = self.files.get(path)
        return bool(
            entry
            and set(self._sources) <= set(entry["sources"])
            and all(self._digest(one) == digest for one, digest in entry["digests"].items())
        )

    def _digest(self, path: str) -> str:
        if path not in self._digests:
            self._digests[path] = _digest(self._project.root / path)
        return self._digests[path]


def _digest(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()[:16] if file.exists() else ""


def _nearness(test: str, source: str) -> int:
    """Return how closely a test file's name matches a source: its module, else its folder."""
    path, words = PurePosixPath(source), PurePosixPath(test)
    if test == source or words.stem == f"test_{path.stem}":
        return _NAMED
    return int(path.parent.name in (words.parent.name, words.stem.removeprefix("test_")))
