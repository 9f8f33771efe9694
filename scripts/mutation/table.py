"""Results as text."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import PurePosixPath

from mutation.campaign import Row
from mutation.trial import EQUIVALENT, ERROR, FOUND, SURVIVED, TIMED_OUT


def as_text(rows: Sequence[Row]) -> str:
    """Survivors and errors with their diffs, then the counts of each folder and the share that was found."""
    shown = [row for outcome in (SURVIVED, ERROR) for row in rows if row.outcome == outcome]
    parts = [f"{row.id}  {row.outcome}, {row.operator}: {row.by}\n{row.diff}\n" for row in shown]
    folders = sorted({_folder(row) for row in rows})
    width = max(map(len, [*folders, "all"]), default=3)
    heads = (FOUND, TIMED_OUT, SURVIVED, EQUIVALENT, ERROR)
    lines = [" " * width + "".join(f"{head:>12}" for head in heads)]
    for folder in [*folders, "all"]:
        counts = Counter(row.outcome for row in rows if folder in ("all", _folder(row)))
        lines.append(f"{folder:{width}}" + "".join(f"{counts[head]:12}" for head in heads))
    return "\n".join([*parts, *lines, f"{100 * share_found(rows):.1f} % found"])


def share_found(rows: Sequence[Row]) -> float:
    """Of the faults that change a result, the share that tests found; 1 where there are none.

    Those whose trial ended with an error are left out.
    """
    counts = Counter(row.outcome for row in rows)
    found = counts[FOUND] + counts[TIMED_OUT]
    return found / (found + counts[SURVIVED]) if found + counts[SURVIVED] else 1.0


def _folder(row: Row) -> str:
    return PurePosixPath(row.path).parent.as_posix()
