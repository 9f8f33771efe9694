"""Record of one run: all figures, and node positions as far as memory lasts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from hexmend.advice import Advice
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import Smoother
from hexmend_app.state.mesh.document import State


@dataclass(frozen=True, eq=False)
class NodeOffsets:
    """Displacements of nodes since the start of a run.

    Parameters
    ----------
    nodes : (k,) int32
        All others are where they were.
    displacements : (k, 3) float32
    """

    nodes: np.ndarray
    displacements: np.ndarray

    @property
    def nbytes(self) -> int:
        """Memory in bytes, without the node positions, which many states share."""
        return self.displacements.nbytes


class RunRecord:
    """Record of one run.

    Attributes
    ----------
    name : str
        Its own: the method's title, with a number where it ran before.
    title : str
        The method's title.
    start : State
        Where it began, as it was.
    parent : Moment or None
        The iteration of another run that it went on from.
    rows : list of dict
        Of every iteration, `Iteration.row` and what numbers its notes hold; number 0 first.
    result : int or None
        Number of the iteration that is the run's result; None until it has ended.
    end : State or None
        The result, as it was.
    message : str
        What came out, in sentences; "" until it has ended.
    pauses : dict
        The break-points that it paused at, in words, by the number of the iteration.
    advice : Advice or None
        Why it ended and what to do, once it has.
    work : Smoother, Recipe or None
        What it does; None of a run that a session has kept.
    stop : StoppingCriteria or None
        Its limits; None of a recipe, which has its own.
    changes : list of (int, Stage)
        What was chosen on the way, with the number of the iteration after which it was.
    slot : int
        From 0; it keeps its colour while others come and go.
    plotted : bool
        Whether it is seen in charts.
    """

    def __init__(self, name: str, title: str, start: State, parent: RecordedIteration | None, slot: int = 0):
        self.name, self.title, self.start, self.parent, self.slot = name, title, start, parent, slot
        self.plotted = True
        self.rows: list[dict[str, Any]] = []
        self.result: int | None = None
        self.end: State | None = None
        self.message = ""
        self.pauses: dict[int, str] = {}
        self.advice: Advice | None = None
        self.work: Smoother | Recipe | None = None
        self.stop: StoppingCriteria | None = None
        self.changes: list[tuple[int, Stage]] = []
        self._moved = start.mesh.free  # so far: where the boundary slides, there are others than the free ones
        self._nodes = np.flatnonzero(self._moved).astype(np.int32)
        self._offsets: dict[int, NodeOffsets] = {}  # from the start, by number

    @property
    def newest(self) -> int:
        """Number of the last iteration."""
        return len(self.rows) - 1

    def numbers(self) -> np.ndarray:
        """Numbers of the iterations whose positions are there, ascending, (k,) int."""
        numbers = np.array([0, *self._offsets])  # a dict keeps the order of adding
        return numbers if self.end is None or self.result in self._offsets else np.union1d(numbers, self.result)

    def compact(self, points: np.ndarray) -> NodeOffsets:
        """Compute the displacements of the nodes that have moved since the start."""
        path = points - self.start.mesh.points
        moved = self._moved | path.any(axis=1)
        if np.count_nonzero(moved) > self._nodes.size:
            self._moved, self._nodes = moved, np.flatnonzero(moved).astype(np.int32)
        return NodeOffsets(self._nodes, path[self._nodes].astype(np.float32))

    def points(self, number: int) -> np.ndarray:
        """Node positions, (n, 3) float64: exact at the start and for the result, otherwise within rounding.

        A way from the start is kept as float32, so that a node is off by 6e-8 of its way at most.

        Raises
        ------
        KeyError
            For an iteration that was thinned out.
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
        return f"{self.record.name} {self.number}" if self.number else f"before {self.record.name}"
