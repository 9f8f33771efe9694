"""Data of the runs on the open mesh in a session file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from hexmend.advice import Advice
from hexmend.run.recipe import Recipe
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.mesh.run_record import NodeOffsets, RunRecord

#: Columns that the row of every iteration has, for any method.
_FIGURES = ("seconds", "q_min", "q_mean", "scaled_jacobian_min", "inverted", "invalid", "largest_move")


@dataclass(frozen=True, eq=False)
class RecordData:
    """Data of a run in a session file: a `RunRecord`, with its parent as the numbers of a run and an iteration."""

    name: str
    title: str
    start: MeasuredMesh
    parent: tuple[int, int] | None
    rows: tuple[dict[str, Any], ...]
    result: int | None
    end: MeasuredMesh | None
    message: str
    pauses: tuple[tuple[int, str], ...]
    advice: Advice | None
    offsets: tuple[tuple[int, NodeOffsets], ...]
    slot: int | None
    plotted: bool
    settings: str
    recipe: Recipe | None

    def __post_init__(self) -> None:
        numbers = [number for number, _ in self.offsets]
        if numbers != sorted(set(numbers)) or not set(numbers) <= set(range(1, len(self.rows))):
            raise ValueError(f"{self.name!r} has positions of iterations that do not exist")
        if (self.slot or 0) < 0:
            raise ValueError(f"{self.name!r} has the slot {self.slot}")
        for at, row in enumerate(self.rows):
            figures = [row.get(name) for name in _FIGURES]
            if row.get("iteration") != at or not all(isinstance(figure, int | float) for figure in figures):
                raise ValueError(f"iteration {at} of {self.name!r} lacks values of {', '.join(_FIGURES)}")
        if (self.result is None) != (self.end is None) or not 0 <= (self.result or 0) < len(self.rows):
            raise ValueError(f"{self.name!r} has no iteration {self.result}, which is its result")

    def check(self) -> None:
        """Raise `ValueError` if the positions are invalid; to be called in a worker, as it examines all of them."""
        n_nodes = self.start.mesh.n_nodes
        for nodes in {id(offsets.nodes): offsets.nodes for _, offsets in self.offsets}.values():
            if nodes.dtype != np.int32 or not _within(nodes, n_nodes):
                raise ValueError(f"{self.name!r} has moved nodes that the mesh does not have")
        for number, offsets in self.offsets:
            if (
                offsets.displacements.shape != (offsets.nodes.size, 3)
                or offsets.displacements.dtype != np.float32
                or not np.isfinite(offsets.displacements).all()
            ):
                raise ValueError(f"iteration {number} of {self.name!r} has invalid positions")


@dataclass(frozen=True, eq=False)
class HistoryData:
    """Data of the history in a session file: its runs, and the iterations that some states show (run, number)."""

    records: tuple[RecordData, ...]
    iterations: tuple[tuple[MeasuredMesh, int, int], ...]

    def __post_init__(self) -> None:
        for at, record in enumerate(self.records):
            if record.parent is not None:
                self._check(*record.parent, at)
        for _, run, number in self.iterations:
            self._check(run, number, len(self.records))

    def check(self) -> None:
        """Raise `ValueError` if the positions of a run are invalid."""
        for record in self.records:
            record.check()

    def _check(self, run: int, number: int, runs: int) -> None:
        if not 0 <= run < runs or not 0 <= number < len(self.records[run].rows):
            raise ValueError(f"there is no iteration {number} of run {run}")


def to_data(record: RunRecord, at: Mapping[RunRecord, int], offsets: Mapping[int, NodeOffsets]) -> RecordData:
    """Return the data of a run; `at` has the numbers of the runs, with which the data refer to the parent."""
    parent = record.parent
    same = ("name", "title", "start", "result", "end", "message", "advice", "slot", "plotted", "settings", "recipe")
    return RecordData(
        **{name: getattr(record, name) for name in same},
        parent=(at[parent.record], parent.number) if parent and parent.record in at else None,
        rows=tuple(record.rows),
        pauses=tuple(record.pauses.items()),
        offsets=tuple(sorted(offsets.items())),
    )


def _within(numbers: np.ndarray, count: int) -> bool:
    """Return True if an array is one-dimensional, of signed integers from 0 to below `count`."""
    if numbers.ndim != 1 or numbers.dtype.kind != "i":
        return False
    return not numbers.size or 0 <= int(numbers.min()) <= int(numbers.max()) < count
