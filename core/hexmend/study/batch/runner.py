"""Study of many meshes: reuses stored answers, runs the other tasks, and makes one table of all."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Container, Generator, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any, TypeAlias

from hexmend.errors import FileError
from hexmend.io import writable_suffixes
from hexmend.study.batch.case import Case
from hexmend.study.batch.plan import Plan
from hexmend.study.batch.task import PLACE, Status, Store, Task, answer, content_hash

#: Path of a mesh as given, and name of a case.
_RowKey: TypeAlias = tuple[str, str]
#: Tasks by key, each with the table rows that it fills; answers by table row.
_Tasks: TypeAlias = dict[str, tuple[Task, list[_RowKey]]]
_Rows: TypeAlias = dict[_RowKey, dict[str, Any]]


#: Runs tasks and yields each with its answer: `local_answers`, or `cluster_answers` with its address. Closing the
#: generator ends running tasks.
Workers: TypeAlias = Callable[[Sequence[Task]], Generator[tuple[Task, dict[str, Any]]]]


@dataclass(frozen=True)
class StudyProgress:
    """Progress of a study.

    Parameters
    ----------
    tasks : int
        Number of tasks.
    reused : int
        Tasks with stored answers.
    done : int
        Tasks that were run now.
    failed : int
        Tasks without a result, among those reused and those done.
    last : str
        Mesh and case of the last task.
    """

    tasks: int
    reused: int = 0
    done: int = 0
    failed: int = 0
    last: str = ""


@dataclass(frozen=True)
class StudyResult:
    """Result of a study.

    Parameters
    ----------
    plan : Plan
    rows : tuple of dict
        `COLUMNS` of each finished task, mesh after mesh, in the order of the cases.
    progress : StudyProgress
    interrupted : bool
        The user ended it: rows are missing.
    """

    plan: Plan
    rows: tuple[dict[str, Any], ...]
    progress: StudyProgress
    interrupted: bool

    def record(self) -> dict[str, Any]:
        """Return the study for JSON and for the tables of `hexmend.report`."""
        return {
            "title": self.plan.title,
            "cases": [case.name for case in self.plan.cases],
            "tasks": self.progress.tasks,
            "interrupted": self.interrupted,
            "rows": list(self.rows),
        }


def run_study(
    plan: Plan,
    meshes: Sequence[Path],
    store: Store,
    workers: Workers,
    *,
    version: str,
    again: bool = False,
    meshes_to: Path | None = None,
    watch: Callable[[StudyProgress], Any] = lambda progress: None,
) -> StudyResult:
    """Run all cases of a plan on all meshes; stored answers are reused.

    KeyboardInterrupt ends it; finished tasks are stored.

    Parameters
    ----------
    plan : Plan
    meshes : sequence of Path
    store : Store
    workers : Workers
    version : str
        Version of Hexmend.
    again : bool
        Run tasks again whose answers are stored.
    meshes_to : Path, optional
        Folder for the smoothed meshes.
    watch : callable
        Called with the progress at the start and after each task.

    Returns
    -------
    StudyResult

    Raises
    ------
    FileError
        If an answer cannot be stored.
    """
    tasks, rows = _plan_tasks(plan, meshes, version, meshes_to)
    unreadable = len(rows)
    stored = {} if again else {key: row for key, (task, _) in tasks.items() if (row := store.load(task)) is not None}
    for key, row in stored.items():
        rows |= dict.fromkeys(tasks[key][1], row)
    count = len(dict.fromkeys(meshes)) * len(plan.cases)
    progress = StudyProgress(count, reused=len(rows) - unreadable, done=unreadable, failed=_failed(rows))
    watch(progress)
    interrupted = False
    try:
        with closing(workers(_remaining(tasks, stored))) as answers:
            for task, row in answers:
                store.save(task, row)
                places = tasks[task.key][1]
                rows |= dict.fromkeys(places, row)
                mesh, case = places[0]
                done = progress.done + len(places)
                progress = replace(progress, done=done, failed=_failed(rows), last=f"{Path(mesh).name}, {case}")
                watch(progress)
    except KeyboardInterrupt:
        interrupted = True
    return StudyResult(plan, tuple(_table(plan, meshes, tasks, rows)), progress, interrupted)


def _plan_tasks(plan: Plan, meshes: Sequence[Path], version: str, meshes_to: Path | None) -> tuple[_Tasks, _Rows]:
    """Make the tasks, and the answers for meshes that cannot be read. Files of equal content are one task."""
    tasks: _Tasks = {}
    rows: _Rows = {}
    cached_hash = cache(content_hash)
    for mesh in dict.fromkeys(meshes):
        for case in plan.cases:
            place = str(mesh), case.name
            try:
                surface = plan.surface_of(mesh) if case.slides else None
                task = Task(
                    mesh=str(mesh.absolute()),
                    mesh_hash=cached_hash(mesh),
                    case=case.values(),
                    version=version,
                    surface=str(surface.absolute()) if surface else "",
                    surface_hash=cached_hash(surface) if surface else "",
                    **plan.limits.values(),
                )
            except FileError as error:
                rows[place] = answer(Status.UNREADABLE, str(error))
                continue
            if meshes_to is not None:
                task = replace(task, output=str((meshes_to / _name(mesh, case, task.key)).absolute()))
            tasks.setdefault(task.key, (task, []))[1].append(place)
    return tasks, rows


def _remaining(tasks: _Tasks, stored: Container[str]) -> list[Task]:
    """List the tasks without a stored answer, the largest meshes first."""
    todo = [task for key, (task, _) in tasks.items() if key not in stored]
    return sorted(todo, key=lambda task: -os.path.getsize(task.mesh))


def _table(plan: Plan, meshes: Sequence[Path], tasks: _Tasks, rows: _Rows) -> Iterator[dict[str, Any]]:
    """Yield the rows that exist, in order, with the columns of their mesh and case."""
    keys = {place: (task.mesh_hash, key) for key, (task, places) in tasks.items() for place in places}
    for mesh in dict.fromkeys(map(str, meshes)):
        for case in plan.cases:
            if (place := (mesh, case.name)) in rows:
                values = *place, case.method, case.parameters, *keys.get(place, (None, None))
                yield dict(zip(PLACE, values, strict=True)) | rows[place]


def _name(mesh: Path, case: Case, key: str) -> str:
    """Return the file name of a result: mesh, case and part of the key."""
    suffix = mesh.suffix if mesh.suffix.lower() in writable_suffixes() else ".vtu"
    return f"{mesh.stem}-{re.sub(r'[^A-Za-z0-9]+', '-', case.name)[:80]}-{key[:8]}{suffix}"


def _failed(rows: _Rows) -> int:
    return sum(row["status"] != Status.DONE for row in rows.values())
