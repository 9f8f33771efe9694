"""What a report tells of: a mesh as it was given, and as methods left it."""

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
from hexmend.study.table_row import Row, Watch, common_power, initial_record, run_one
from hexmend.terminal_text import printable

#: What the mesh as it was given is called.
INITIAL = "initial"


@dataclass(frozen=True)
class Source:
    """The file that a mesh came from.

    Parameters
    ----------
    path : str
        As it was named.
    size : int
        In bytes.
    sha256 : str
    seconds : float
        That reading took.
    """

    path: str
    size: int
    sha256: str
    seconds: float


@dataclass(frozen=True, eq=False)
class Version:
    """A mesh as it was given, or as a method left it.

    Parameters
    ----------
    name : str
        What captions and legends call it.
    mesh : Mesh
    figures : ElementQuality
    summary : Summary
    row : Row, optional
        What the method tells; None for the mesh as it was given.
    history : sequence of mapping
        Rows of the run that led to it, as `hexmend.iteration.Result.history` has them.
    advice : Advice, optional
        Why that run ended, and what would help.
    """

    name: str
    mesh: Mesh
    figures: ElementQuality
    summary: Summary
    row: Row | None = None
    history: Sequence[Mapping[str, Any]] = ()
    advice: Advice | None = None

    @classmethod
    def of(cls, name: str, mesh: Mesh, row: Row | None = None, result: Result | None = None) -> Version:
        """A mesh that is yet to be measured, with the run that led to it."""
        figures = measure(mesh.points, mesh.hexes)
        told = (result.history, advise(result)) if result is not None else ()
        return cls(name, mesh, figures, summarise(mesh, figures), row, *told)

    def record(self, power: ObjectiveNorm = SQUARES) -> dict[str, Any]:
        """Its figures, as tables take them; the objective by the p and offset that a table compares by."""
        if self.row is not None:
            return self.row.record(power)
        return initial_record(self.mesh, self.summary, power)


@dataclass(frozen=True, eq=False)
class Case:
    """One mesh of a report.

    Parameters
    ----------
    name : str
    source : Source or None
        None for a mesh that came from no file.
    versions : tuple of Version
        The first is the mesh as it was given.
    failed : tuple of Row
        Of methods that left no mesh.
    stop : StoppingCriteria
        Limits of each method's run.
    interrupted : bool
        Whether the user ended it before the last method was done.
    """

    name: str
    source: Source | None
    versions: tuple[Version, ...]
    failed: tuple[Row, ...] = ()
    stop: StoppingCriteria = StoppingCriteria()  # noqa: RUF009 it is immutable
    interrupted: bool = False

    @property
    def power(self) -> ObjectiveNorm:
        """p and offset of the objective by which its tables compare methods."""
        return common_power(one.row for one in self.versions if one.row is not None)

    @property
    def initial(self) -> Version:
        """The mesh as it was given."""
        return self.versions[0]


def source_of(path: str) -> tuple[Mesh, Source]:
    """Read a mesh, and say what it was read from."""
    began = perf_counter()
    mesh = read(path)
    seconds = perf_counter() - began
    try:
        with open(path, "rb") as file:
            digest = hashlib.file_digest(file, "sha256").hexdigest()
        return mesh, Source(path, Path(path).stat().st_size, digest, seconds)
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}", "Name another file.") from None


def run_methods(
    mesh: Mesh,
    source: Source | None,
    methods: Iterable[Smoother | Recipe],
    stop: StoppingCriteria,
    names: Sequence[str] = (),
    watch: Watch | None = None,
) -> Case:
    """Run methods on a mesh, each from the mesh as given; a method that fails does not keep the others from running.

    Parameters
    ----------
    mesh : Mesh
    source : Source, optional
    methods : iterable of Smoother or Recipe
    stop : StoppingCriteria
        Limits of each run; a recipe has its own.
    names : sequence of str
        What the mesh as given and the results are called, in this order; those that are missing have their own names.
    watch : callable, optional
        As in `hexmend.study.compare.compare`.
    """
    versions, failed = [Version.of(names[0] if names else INITIAL, mesh)], []

    @uninterrupted  # a run that has ended is not lost to a signal
    def add(number: int, row: Row, runs: Sequence[Run]) -> None:
        if row.mesh is None:
            failed.append(row)
        else:
            name = names[number] if number < len(names) else row.method
            versions.append(Version.of(name, row.mesh, row, runs[0].result() if runs else None))

    go_on = True
    try:
        for number, method in enumerate(methods, 1):
            runs: list[Run] = []

            def seen(run: Run, runs: list[Run] = runs) -> Any:
                runs[:] = [run]
                return watch(run) if watch is not None else None

            row, go_on = run_one(mesh, method, stop, seen)
            add(number, row, runs)
            if not go_on:
                break
    except KeyboardInterrupt:  # between two runs
        go_on = False
    return Case(printable(mesh.name), source, tuple(versions), tuple(failed), stop, interrupted=not go_on)


def command_line(words: Sequence[str]) -> str:
    """The words of a command as a shell takes them; bytes of a path that are no letters stay, for what can hold them.

    >>> command_line(["report", "two words.vtk"])
    "hexmend report 'two words.vtk'"
    """
    return shlex.join(["hexmend", *words])
