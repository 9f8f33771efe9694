"""Record of one run: the quality of all iterations, and node positions up to a memory limit.

The times of a case, at which a solver has moved the mesh, are recorded in the same way: iterations are times then.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hexmend.advice import Advice
from hexmend.iteration import Outcome
from hexmend.run.recipe import Recipe, Stage
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.translation import tr

#: Column of the times of a case in the rows of their record: the time as text, or `CONSTANT` for number 0.
TIME = "time"
#: Name of the mesh of a case before the first time.
CONSTANT = "constant"
#: Columns that the row of every iteration has, for any method.
_FIGURES = ("seconds", "q_min", "q_mean", "scaled_jacobian_min", "inverted", "invalid", "largest_move")


@dataclass(frozen=True, eq=False)
class NodeOffsets:
    """Displacements of nodes since the start of a run.

    Parameters
    ----------
    nodes : (k,) int32
        The nodes that have moved.
    displacements : (k, 3) float32
    """

    nodes: np.ndarray
    displacements: np.ndarray

    @property
    def nbytes(self) -> int:
        """Memory in bytes, without `nodes`, which many iterations share."""
        return self.displacements.nbytes


class RunRecord:
    """Record of one run.

    Attributes
    ----------
    name : str
        Unique name: the title, with a number if there are several runs.
    title : str
        Title of the method or recipe.
    start : MeasuredMesh
        State before the run.
    parent : RecordedIteration or None
        Iteration of another run from which this run started.
    rows : list of dict
        `Iteration.row` of every iteration from number 0, with its scalar diagnostics.
    result : int or None
        Number of the iteration that is the run's result; None until it has ended.
    end : MeasuredMesh or None
        State of the result.
    outcome : Outcome or None
        Why the run ended; None until it has ended, if it failed, and for a run from a session file.
    better : int or None
        Number of an iteration that the method ranks higher than the result of a run that the user has stopped.
    message : str
        Outcome in sentences; "" until the run has ended.
    pauses : dict
        Descriptions of the breakpoints reached, by iteration.
    advice : Advice or None
        Why the run ended and what to do; None until it has ended.
    recipe : Recipe or None
        What repeats the run, as far as it got; None if it failed, or its method has changed and it has not ended.
    settings : str
        Values of the run that differ from the defaults, and its rules of motion, as text.
    slot : int
        Number of its colour, from 0, which does not change when other runs are removed.
    plotted : bool
        True to show the run in charts.
    """

    def __init__(self, name: str, title: str, start: MeasuredMesh, parent: RecordedIteration | None, slot: int = 0):
        self.name, self.title, self.start, self.parent, self.slot = name, title, start, parent, slot
        self.plotted = True
        self.rows: list[dict[str, Any]] = []
        self.result: int | None = None
        self.end: MeasuredMesh | None = None
        self.outcome: Outcome | None = None
        self.better: int | None = None
        self.message = ""
        self.pauses: dict[int, str] = {}
        self.advice: Advice | None = None
        self.settings = ""
        self.recipe: Recipe | None = None
        self._moved = start.mesh.free  # grows if boundary nodes slide
        self._nodes = np.flatnonzero(self._moved).astype(np.int32)
        self._offsets: dict[int, NodeOffsets] = {}  # by iteration

    @property
    def newest(self) -> int:
        """Number of the last iteration."""
        return len(self.rows) - 1

    @property
    def holds_times(self) -> bool:
        """True if the iterations are the times of a case."""
        return bool(self.rows) and TIME in self.rows[0]

    @property
    def unit(self) -> str:
        """Noun for the iterations, for `counted`."""
        return "time" if self.holds_times else "iteration"

    def label(self, number: int) -> str:
        """Name an iteration: its number, or the time of a case such as "t = 0.002"."""
        if not self.holds_times:
            return str(number)
        return f"t = {self.rows[number][TIME]}" if number else CONSTANT

    def labels(self) -> list[str]:
        """Name all iterations; an empty list for a run, whose iterations have numbers alone."""
        return [self.label(number) for number in range(len(self.rows))] if self.holds_times else []

    def numbers(self) -> np.ndarray:
        """Return the numbers of the iterations whose positions are recorded, ascending, (k,) int."""
        numbers = np.array([0, *self._offsets])  # a dict keeps the order of adding
        return numbers if self.end is None or self.result in self._offsets else np.union1d(numbers, self.result)

    def recipe_until(self, number: int) -> Recipe | None:
        """Return what repeats the run until an iteration and keeps that; None if several methods ran."""
        if self.recipe is None or number == self.result:
            return self.recipe
        if len(self.recipe.stages) > 1:
            return None
        (stage,) = self.recipe.stages
        stop = replace(stage.stop, max_iterations=number, max_seconds=0.0, keep_last=True)
        return replace(self.recipe, stages=(Stage(stage.smoother, stop),))

    def compact(self, points: np.ndarray) -> NodeOffsets:
        """Return the displacements of the nodes that have moved since the start."""
        displacements = points - self.start.mesh.points
        moved = self._moved | displacements.any(axis=1)
        if np.count_nonzero(moved) > self._nodes.size:
            self._moved, self._nodes = moved, np.flatnonzero(moved).astype(np.int32)
        return NodeOffsets(self._nodes, displacements[self._nodes].astype(np.float32))

    def points(self, number: int) -> np.ndarray:
        """Return the node positions at an iteration, (n, 3) float64: exact for the start and the result.

        Other iterations have rounding errors of at most 6e-8 of the displacement, which is stored as float32.

        Raises
        ------
        KeyError
            If the positions of the iteration were dropped.
        """
        if number == 0:
            return self.start.mesh.points
        if number == self.result and self.end is not None:
            return self.end.mesh.points
        points = self.start.mesh.points.copy()
        offsets = self._offsets[number]
        points[offsets.nodes] += offsets.displacements
        return points


@dataclass(frozen=True)
class RecordedIteration:
    """An iteration of a run."""

    record: RunRecord
    number: int

    @property
    def name(self) -> str:
        """Name for titles."""
        if self.record.holds_times:
            return f"{self.record.name}, {self.record.label(self.number)}"
        return f"{self.record.name} {self.number}" if self.number else tr("before {run}", run=self.record.name)


def balances(row: Mapping[str, Any]) -> bool:
    """Return True if an iteration raises the minimum scaled Jacobian and q(H); the objective may rise meanwhile."""
    return "least" in row and "least_q" in row


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


def record_data(record: RunRecord, at: Mapping[RunRecord, int], offsets: Mapping[int, NodeOffsets]) -> RecordData:
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
