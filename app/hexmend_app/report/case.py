"""Data of a report: the original mesh and the results of methods."""

from __future__ import annotations

import hashlib
import shlex
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from typing import Any

from hexmend.advice import Advice, advise
from hexmend.energy.norm import SQUARES, ObjectiveNorm
from hexmend.errors import FileError
from hexmend.io import read
from hexmend.iteration import Result, StoppingCriteria
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, Summary, measure, summarise
from hexmend.run import Run
from hexmend.run.recipe import Recipe
from hexmend.signal_guard import uninterrupted
from hexmend.smoothers import Smoother
from hexmend.study.compare import Row, Watch, common_norm, initial_record, run_one
from hexmend.terminal_text import printable

#: Name of the original mesh.
INITIAL = "initial"


@dataclass(frozen=True)
class Source:
    """File of a mesh.

    Parameters
    ----------
    path : str
        As given by the user.
    size : int
        In bytes.
    sha256 : str
    seconds : float or None
        Time of reading; None if it was not measured.
    """

    path: str
    size: int
    sha256: str
    seconds: float | None = None

    @classmethod
    def of(cls, path: str, seconds: float | None = None) -> Source:
        """Describe a file; raise `FileError` if it cannot be read."""
        try:
            with open(path, "rb") as file:
                digest = hashlib.file_digest(file, "sha256").hexdigest()
            return cls(path, Path(path).stat().st_size, digest, seconds)
        except OSError as error:
            raise FileError(path, f"cannot be read: {error.strerror or error}", "Name another file.") from None


@dataclass(frozen=True, eq=False)
class Version:
    """Original mesh, or result of a method.

    Parameters
    ----------
    name : str
        Name in captions and legends.
    mesh : Mesh
    quality : ElementQuality
    summary : Summary
    row : Row, optional
        Outcome of the method; None for the original mesh.
    history : sequence of mapping
        History of the run, as in `hexmend.iteration.Result.history`.
    advice : Advice, optional
        Reason why the run ended, and suggestions.
    """

    name: str
    mesh: Mesh
    quality: ElementQuality
    summary: Summary
    row: Row | None = None
    history: Sequence[Mapping[str, Any]] = ()
    advice: Advice | None = None

    @classmethod
    def of(cls, name: str, mesh: Mesh, row: Row | None = None, result: Result | None = None) -> Version:
        """Measure a mesh, the result of a run if there is one."""
        quality = measure(mesh.points, mesh.elements, mesh.mid_nodes)
        outcome = (result.history, advise(result)) if result is not None else ()
        return cls(name, mesh, quality, summarise(mesh, quality), row, *outcome)

    def record(self, norm: ObjectiveNorm = SQUARES) -> dict[str, Any]:
        """Return the measurements for a table; its objective has the p and offset of `norm`."""
        if self.row is not None:
            return self.row.record(norm)
        return initial_record(self.mesh, self.summary, norm)


@dataclass(frozen=True, eq=False)
class Case:
    """One mesh of a report.

    Parameters
    ----------
    name : str
    source : Source or None
        None for a mesh without a file.
    versions : tuple of Version
        The original mesh first.
    failed : tuple of Row
        Rows of methods without a result.
    stop : StoppingCriteria or None
        Limits of each method's run; None if runs differ in them.
    interrupted : bool
        True if the user ended the runs early.
    """

    name: str
    source: Source | None
    versions: tuple[Version, ...]
    failed: tuple[Row, ...] = ()
    stop: StoppingCriteria | None = StoppingCriteria()  # noqa: RUF009 it is immutable
    interrupted: bool = False

    @property
    def norm(self) -> ObjectiveNorm:
        """Norm (p and offset) of the objective in tables that compare methods."""
        return common_norm(version.row for version in self.versions if version.row is not None)

    @property
    def initial(self) -> Version:
        """The original mesh."""
        return self.versions[0]


def source_of(path: str) -> tuple[Mesh, Source]:
    """Read a mesh; return it with the path, size and digest of its file.

    Raises
    ------
    FileError
        If the file cannot be read.
    """
    start = perf_counter()
    mesh = read(path)
    return mesh, Source.of(path, perf_counter() - start)


def run_methods(
    mesh: Mesh,
    source: Source | None,
    methods: Iterable[Smoother | Recipe],
    stop: StoppingCriteria,
    names: Sequence[str] = (),
    watch: Watch | None = None,
) -> Case:
    """Run methods on a mesh, each from the original mesh; a failed method does not end the others.

    Parameters
    ----------
    mesh : Mesh
    source : Source, optional
    methods : iterable of Smoother or Recipe
    stop : StoppingCriteria
        Limits of each run; a recipe has its own.
    names : sequence of str
        Names of the original mesh and of the results, in this order; by default, the names of the methods.
    watch : callable, optional
        As in `hexmend.study.compare.compare`.
    """
    versions, failed = [Version.of(names[0] if names else INITIAL, mesh)], []

    @uninterrupted  # a signal must not discard a finished run
    def add(number: int, row: Row, runs: Sequence[Run]) -> None:
        if row.mesh is None:
            failed.append(row)
        else:
            name = names[number] if number < len(names) else row.method
            versions.append(Version.of(name, row.mesh, row, runs[0].result() if runs else None))

    proceed = True
    try:
        for number, method in enumerate(methods, 1):
            runs: list[Run] = []

            def watch_run(run: Run, runs: list[Run] = runs) -> Any:
                runs[:] = [run]
                return watch(run) if watch is not None else None

            row, proceed = run_one(mesh, method, stop, watch_run)
            add(number, row, runs)
            if not proceed:
                break
    except KeyboardInterrupt:  # between two runs
        proceed = False
    return Case(printable(mesh.name), source, tuple(versions), tuple(failed), stop, interrupted=not proceed)


def command_line(words: Sequence[str]) -> str:
    """Return a command as text for a shell; undecodable bytes of paths are preserved.

    >>> command_line(["report", "two words.vtk"])
    "hexmend report 'two words.vtk'"
    """
    return shlex.join(["hexmend", *words])
