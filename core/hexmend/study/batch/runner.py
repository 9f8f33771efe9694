"""A study: what is kept is taken, the rest is done, and all of it is one table."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any, Protocol, TypeAlias

from hexmend.errors import FileError
from hexmend.io import writable_suffixes
from hexmend.study.batch.case import Case
from hexmend.study.batch.plan import Plan
from hexmend.study.batch.store import Store
from hexmend.study.batch.table_columns import PLACE, Status, answer
from hexmend.study.batch.task import Task, content_hash

#: A mesh as it was named, and the name of a case.
_Place: TypeAlias = tuple[str, str]
#: Tasks by their keys, with the places that each fills; and the answers by place.
_Tasks: TypeAlias = dict[str, tuple[Task, list[_Place]]]
_Rows: TypeAlias = dict[_Place, dict[str, Any]]


class Workers(Protocol):
    """Who does tasks: `Local` or `Cluster`."""

    def answers(self, tasks: Sequence[Task]) -> Generator[tuple[Task, dict[str, Any]]]:
        """Each task with its answer, as it is done; closing the iterator ends what is at work."""


@dataclass(frozen=True)
class StudyProgress:
    """How far a study is.

    Parameters
    ----------
    tasks : int
        All of them.
    kept : int
        Those that were done before.
    done : int
        Those that have been done now.
    failed : int
        Those without a result, of both.
    last : str
        Mesh and case of the one done last.
    """

    tasks: int
    kept: int = 0
    done: int = 0
    failed: int = 0
    last: str = ""


@dataclass(frozen=True)
class StudyResult:
    """What a study gave.

    Parameters
    ----------
    plan : Plan
    rows : tuple of dict
        `COLUMNS` of each task that was done, mesh after mesh, in the order of the cases.
    count : StudyProgress
    interrupted : bool
        Whether the user ended it; rows that are missing are left for another time.
    """

    plan: Plan
    rows: tuple[dict[str, Any], ...]
    count: StudyProgress
    interrupted: bool

    def record(self) -> dict[str, Any]:
        """The study for other programs: what `hexmend.report` writes its tables from."""
        return {
            "title": self.plan.title,
            "cases": [case.name for case in self.plan.cases],
            "tasks": self.count.tasks,
            "interrupted": self.interrupted,
            "rows": list(self.rows),
        }


def study_many(
    plan: Plan,
    meshes: Sequence[Path],
    store: Store,
    workers: Workers,
    *,
    version: str,
    again: bool = False,
    meshes_to: Path | None = None,
    watch: Callable[[StudyProgress], Any] = lambda count: None,
) -> StudyResult:
    """Do each of a plan's cases on each mesh, but for what is kept.

    KeyboardInterrupt ends it; what was done is kept.

    Parameters
    ----------
    plan : Plan
    meshes : sequence of Path
    store : Store
    workers : Workers
    version : str
        Of Hexmend.
    again : bool
        Do what is kept, too.
    meshes_to : Path, optional
        Folder for the meshes that result.
    watch : callable
        Called with the count at first, and after each task.

    Raises
    ------
    FileError
        Where an answer cannot be kept.
    """
    tasks, rows = _planned(plan, meshes, version, meshes_to)
    unreadable = len(rows)
    kept = {} if again else {key: row for key, (task, _) in tasks.items() if (row := store.kept(task)) is not None}
    for key, row in kept.items():
        rows |= dict.fromkeys(tasks[key][1], row)
    count = StudyProgress(
        tasks=len(dict.fromkeys(meshes)) * len(plan.cases),
        kept=len(rows) - unreadable,
        done=unreadable,
        failed=_failed(rows),
    )
    watch(count)
    todo = [task for key, (task, _) in tasks.items() if key not in kept]
    todo.sort(key=lambda task: -os.path.getsize(task.mesh))  # so that no large one is left for the end
    interrupted = False
    try:
        with closing(workers.answers(todo)) as answers:
            for task, row in answers:
                store.keep(task, row)
                places = tasks[task.key][1]
                rows |= dict.fromkeys(places, row)
                mesh, case = places[0]
                done = count.done + len(places)
                count = replace(count, done=done, failed=_failed(rows), last=f"{Path(mesh).name}, {case}")
                watch(count)
    except KeyboardInterrupt:
        interrupted = True
    return StudyResult(plan, tuple(_table(plan, meshes, tasks, rows)), count, interrupted)


def _planned(plan: Plan, meshes: Sequence[Path], version: str, meshes_to: Path | None) -> tuple[_Tasks, _Rows]:
    """What is to be done, and the answers for meshes that cannot be read.

    Files of the same content are one task.
    """
    tasks: _Tasks = {}
    rows: _Rows = {}
    hashed = cache(content_hash)
    for mesh in dict.fromkeys(meshes):
        for case in plan.cases:
            place = str(mesh), case.name
            try:
                surface = plan.surface_of(mesh) if case.slides else None
                task = Task(
                    mesh=str(mesh.absolute()),
                    mesh_hash=hashed(mesh),
                    case=case.values(),
                    version=version,
                    surface=str(surface.absolute()) if surface else "",
                    surface_hash=hashed(surface) if surface else "",
                    **plan.limits.values(),
                )
            except FileError as error:
                rows[place] = answer(Status.UNREADABLE, str(error))
                continue
            if meshes_to is not None:
                task = replace(task, output=str((meshes_to / _name(mesh, case, task.key)).absolute()))
            tasks.setdefault(task.key, (task, []))[1].append(place)
    return tasks, rows


def _table(plan: Plan, meshes: Sequence[Path], tasks: _Tasks, rows: _Rows) -> Iterator[dict[str, Any]]:
    """The rows that there are, in order and with what is known of their places."""
    keys = {place: (task.mesh_hash, key) for key, (task, places) in tasks.items() for place in places}
    for mesh in dict.fromkeys(map(str, meshes)):
        for case in plan.cases:
            if (place := (mesh, case.name)) in rows:
                values = *place, case.method, case.parameters, *keys.get(place, (None, None))
                yield dict(zip((column.name for column in PLACE), values, strict=True)) | rows[place]


def _name(mesh: Path, case: Case, key: str) -> str:
    """Of the file of a result: after mesh and case, and its own."""
    suffix = mesh.suffix if mesh.suffix.lower() in writable_suffixes() else ".vtu"
    return f"{mesh.stem}-{re.sub(r'[^A-Za-z0-9]+', '-', case.name)[:80]}-{key[:8]}{suffix}"


def _failed(rows: _Rows) -> int:
    return sum(row["status"] != Status.DONE for row in rows.values())
