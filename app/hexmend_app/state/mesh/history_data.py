"""Data of the runs on the open mesh in a session file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from hexmend.advice import Advice
from hexmend_app.codec.codec import since
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.run_record import NodeOffsets, RunRecord

#: Numbers that every iteration has, whatever the method tells besides.
_FIGURES = ("seconds", "q_min", "q_mean", "inverted", "largest_move")


@dataclass(frozen=True, eq=False)
class RecordData:
    """Data of a run in a session file: a `RunRecord`, with its parent as the numbers of a run and an iteration."""

    name: str
    title: str
    start: State
    parent: tuple[int, int] | None
    rows: tuple[dict[str, Any], ...]
    result: int | None
    end: State | None
    message: str
    pauses: tuple[tuple[int, str], ...]
    advice: Advice | None
    offsets: tuple[tuple[int, NodeOffsets], ...]
    slot: int | None = field(default=None, metadata=since(2))
    plotted: bool = field(default=True, metadata=since(2))

    def __post_init__(self) -> None:
        numbers = [number for number, _ in self.offsets]
        if numbers != sorted(set(numbers)) or not set(numbers) <= set(range(1, len(self.rows))):
            raise ValueError(f"{self.name!r} keeps iterations that it has not made")
        if (self.slot or 0) < 0:
            raise ValueError(f"{self.name!r} has the slot {self.slot}")
        for at, row in enumerate(self.rows):
            figures = [row.get(name) for name in _FIGURES]
            if row.get("iteration") != at or not all(isinstance(one, int | float) for one in figures):
                raise ValueError(f"iteration {at} of {self.name!r} lacks figures")
        if (self.result is None) != (self.end is None) or not 0 <= (self.result or 0) < len(self.rows):
            raise ValueError(f"{self.name!r} has no iteration {self.result}, which is its result")

    def check(self) -> None:
        """Raise `ValueError` unless its positions can be the run's; all are looked at, which is a worker's task."""
        nodes = self.start.mesh.n_nodes
        for one in {id(offsets.nodes): offsets for _, offsets in self.offsets}.values():
            inside = one.nodes.dtype == np.int32 and (
                not one.nodes.size or 0 <= one.nodes.min() <= one.nodes.max() < nodes
            )
            if one.nodes.ndim != 1 or not inside:
                raise ValueError(f"{self.name!r} has moved nodes that the mesh has not")
        for number, one in self.offsets:
            if (
                one.displacements.shape != (one.nodes.size, 3)
                or one.displacements.dtype != np.float32
                or not np.isfinite(one.displacements).all()
            ):
                raise ValueError(f"iteration {number} of {self.name!r} has lost its positions")


@dataclass(frozen=True, eq=False)
class HistoryData:
    """Data of the history in a session file: its runs, and the iterations that some states show (run, number)."""

    records: tuple[RecordData, ...]
    moments: tuple[tuple[State, int, int], ...]

    def __post_init__(self) -> None:
        for at, record in enumerate(self.records):
            if record.parent is not None:
                self._check(*record.parent, at)
        for _, run, number in self.moments:
            self._check(run, number, len(self.records))

    def check(self) -> None:
        """Raise `ValueError` unless positions can be those of their runs."""
        for record in self.records:
            record.check()

    def _check(self, run: int, number: int, runs: int) -> None:
        if not 0 <= run < runs or not 0 <= number < len(self.records[run].rows):
            raise ValueError(f"there is no iteration {number} of run {run}")


def to_data(record: RunRecord, at: Mapping[RunRecord, int], offsets: Mapping[int, NodeOffsets]) -> RecordData:
    """Return the data of a run, whose parent is the run with that number."""
    parent = record.parent
    same = ("name", "title", "start", "result", "end", "message", "advice", "slot", "plotted")
    return RecordData(
        **{name: getattr(record, name) for name in same},
        parent=(at[parent.record], parent.number) if parent and parent.record in at else None,
        rows=tuple(record.rows),
        pauses=tuple(record.pauses.items()),
        offsets=tuple(sorted(offsets.items())),
    )


def _within(numbers: np.ndarray, count: int) -> bool:
    """Return True if an array is a list of whole numbers from 0 to below `count`."""
    if numbers.ndim != 1 or numbers.dtype.kind != "i":
        return False
    return not numbers.size or 0 <= int(numbers.min()) <= int(numbers.max()) < count
