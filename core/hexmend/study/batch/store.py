"""Store of answers: a small file each, named by the key of the task, written as a whole or not at all."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from hexmend.io.storage.atomic import atomic_write
from hexmend.study.batch.table_columns import Status, is_answer
from hexmend.study.batch.task import Task

#: Most bytes of a file; only the message of a run varies in length.
_MOST = 1_000_000

#: Failures that another limit may turn into a result, with the name of the limit.
_LIMITED = {Status.TIME: "max_seconds", Status.MEMORY: "max_memory_mb"}


class Store:
    """Answers in a folder.

    Parameters
    ----------
    folder : Path
        Exists already.
    """

    def __init__(self, folder: Path):
        self._folder = folder

    def load(self, task: Task) -> dict[str, Any] | None:
        """Return the stored answer, None if the task is to be run.

        It is run again if the process was lost, if it failed by a limit that has changed, or if the mesh that it wrote
        is missing. Files without a valid answer are ignored.
        """
        path = self._path(task)
        try:
            if path.stat().st_size > _MOST:
                return None
            stored = json.loads(path.read_bytes())
        except (OSError, ValueError, RecursionError):
            return None
        if not isinstance(stored, dict) or stored.get("key") != task.key or not is_answer(stored.get("answer")):
            return None
        row = stored["answer"]
        if row["status"] == Status.LOST or not _same_limit(task, row["status"], stored.get("limits")):
            return None
        if row["status"] == Status.DONE and task.output and not Path(task.output).is_file():
            return None
        return row

    def save(self, task: Task, row: Mapping[str, Any]) -> None:
        """Store an answer; it replaces an older one."""
        stored = {
            "key": task.key,
            "hexmend": task.version,
            **{key: getattr(task, key) for key in ("mesh", "mesh_hash", "surface_hash", "case")},
            "limits": {"max_seconds": task.max_seconds, "max_memory_mb": task.max_memory_mb},
            "answer": dict(row),
        }
        with atomic_write(self._path(task)) as temporary:
            temporary.write_text(json.dumps(stored, indent=1, allow_nan=False) + "\n", encoding="utf-8")

    def _path(self, task: Task) -> Path:
        return self._folder / f"{task.key}.json"


def _same_limit(task: Task, status: str, limits: object) -> bool:
    name = _LIMITED.get(Status(status))
    if name is None:
        return True
    limit = getattr(task, name)  # 0: a share of the memory that was free then
    return isinstance(limits, dict) and limits.get(name) == limit != 0
