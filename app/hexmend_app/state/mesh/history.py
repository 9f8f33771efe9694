"""Every iteration of the runs on the open mesh: its figures for good, where its nodes were as long as memory lasts."""

from __future__ import annotations

import threading
from collections.abc import Iterable
from weakref import WeakKeyDictionary

import numpy as np

from hexmend.iteration import Iteration
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import printable
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.history_data import HistoryData, to_data
from hexmend_app.state.mesh.run_record import RecordedIteration, RunRecord
from hexmend_app.state.settings.settings import HISTORY_MEGABYTES

#: Bytes that positions may take unless the user says otherwise: 400 iterations of 110,000 hexes.
LIMIT = HISTORY_MEGABYTES.default << 20


class History:
    """The runs on the open mesh, oldest first.

    A run adds to it from its own thread, so that no iteration is lost however seldom the window looks. Positions that
    take more than the limit are thinned: the older they are, the further apart are those that stay. The start, the
    newest iteration and the result of a run are always there.

    Parameters
    ----------
    limit : float
        Bytes that positions may take.
    """

    def __init__(self, limit: float = LIMIT):
        self.records: list[RunRecord] = []
        self._limit = limit
        self._bytes = 0
        self._kept: list[tuple[RunRecord, int, int]] = []  # with a stamp that counts on, in the order of adding
        self._stamp = 0
        self._lock = threading.Lock()
        self._moments: WeakKeyDictionary[State, RecordedIteration] = WeakKeyDictionary()

    @property
    def bytes(self) -> int:
        """Memory of the recorded positions."""
        return self._bytes

    @property
    def limit(self) -> int:
        """Bytes that positions may take; less than there are thins them at once."""
        return self._limit

    @limit.setter
    def limit(self, limit: int) -> None:
        with self._lock:
            self._limit = limit
            self._thin()

    def begin(self, title: str, start: State) -> RunRecord:
        """Open the record of a run that is about to begin; what it goes on from is known by its start.

        Parameters
        ----------
        title : str
            Of the method or the recipe.
        start : State
        """
        names = {record.name for record in self.records}
        count = 1
        while (own := f"{title} ({count})" if count > 1 else title) in names:
            count += 1
        record = RunRecord(own, title, start, self.moment_of(start), self._free_slot())
        self.records.append(record)
        self._moments[start] = RecordedIteration(record, 0)
        return record

    def add(self, record: RunRecord, iteration: Iteration, positions: bool = True) -> None:
        """Record an iteration, and its node positions unless `positions` is False; called in the thread of the run.

        Iterations of a run that has been removed are ignored: its thread may still be at work.
        """
        numbers = {name: value for name, value in iteration.diagnostics.items() if isinstance(value, (int, float, str))}
        row = numbers | iteration.row()
        offsets = record.compact(iteration.points) if iteration.number and positions else None
        with self._lock:
            if not any(one is record for one in self.records):
                return
            if offsets is not None:
                record._offsets[iteration.number] = offsets
                self._stamp += 1
                self._kept.append((record, iteration.number, self._stamp))
                self._bytes += offsets.nbytes
                self._thin()
            record.rows.append(row)  # last, so that whoever counts rows finds the positions

    def finish(self, record: RunRecord, result: RecordedIteration | None, end: State | None, message: str) -> None:
        """Close the record of a run; one without an iteration is dropped, but whoever holds it reads the message."""
        record.message = message
        if record.newest < 1:
            self.remove(record)
            return
        if result is not None:
            record.result, record.end = result.number, end
            self._moments[end] = result

    def remove(self, record: RunRecord) -> None:
        """Forget a run."""
        with self._lock:
            self.records = [one for one in self.records if one is not record]
            self._kept = [one for one in self._kept if one[0] is not record]
            self._bytes -= sum(offsets.nbytes for offsets in record._offsets.values())
            record._offsets.clear()
        for state, moment in list(self._moments.items()):
            if moment.record is record:
                del self._moments[state]

    def clear(self) -> None:
        """Forget all: another mesh is open."""
        for record in list(self.records):
            self.remove(record)

    def to_data(self, states: Iterable[State]) -> HistoryData:
        """Return the data for a session file, with the iterations that some states show; no run is active."""
        with self._lock:
            begun = [record for record in self.records if record.rows]
            at = {record: number for number, record in enumerate(begun)}
            records = tuple(to_data(record, at, record._offsets) for record in begun)
        moments = ((state, self.moment_of(state)) for state in dict.fromkeys(states))
        shown = [(state, at[one.record], one.number) for state, one in moments if one and one.record in at]
        return HistoryData(records, tuple(shown))

    def restore(self, data: HistoryData) -> None:
        """Have the runs that a session has kept, and no others; more positions than fit are thinned."""
        self.clear()
        for kept in data.records:
            parent = None if kept.parent is None else RecordedIteration(self.records[kept.parent[0]], kept.parent[1])
            slot = self._free_slot() if kept.slot is None else kept.slot
            record = RunRecord(printable(kept.name), kept.title, kept.start, parent, slot)
            record.plotted = kept.plotted
            record.rows, record.result, record.end = [dict(row) for row in kept.rows], kept.result, kept.end
            record.message, record.pauses, record.advice = kept.message, dict(kept.pauses), kept.advice
            self.records.append(record)
            self._moments[kept.start] = RecordedIteration(record, 0)
            if kept.end is not None:
                self._moments[kept.end] = RecordedIteration(record, kept.result)
            with self._lock:
                for number, offsets in kept.offsets:
                    record._offsets[number] = offsets
                    self._stamp += 1
                    self._kept.append((record, number, self._stamp))
                    self._bytes += offsets.nbytes
        for state, run, number in data.moments:
            self._moments[state] = RecordedIteration(self.records[run], number)
        with self._lock:
            self._thin()

    def note(self, state: State, moment: RecordedIteration) -> None:
        """Remember which iteration a state shows."""
        self._moments[state] = moment

    def moment_of(self, state: State | None) -> RecordedIteration | None:
        """Find the iteration that a state shows, even after nodes were fixed or hexes tagged; None if there is none."""
        if state is None:
            return None
        if state not in self._moments:
            same = (moment for one, moment in self._moments.items() if one.mesh.points is state.mesh.points)
            moment = next(same, None)
            if moment is None:
                return None
            self._moments[state] = moment  # the other may be gone before this one is
        return self._moments[state]

    def kept(self, record: RunRecord) -> np.ndarray:
        """Numbers of the iterations whose positions are there, ascending, (k,) int."""
        with self._lock:
            return record.numbers()

    def state(self, moment: RecordedIteration, mesh: Mesh) -> State:
        """The mesh as it was at an iteration, or at the nearest one whose positions are there: `moment_of` tells which.

        Parameters
        ----------
        moment : Moment
        mesh : Mesh
            The open one: what is pinned and tagged is as it is there.
        """
        record = moment.record
        with self._lock:
            numbers = record.numbers()
            number = int(numbers[np.abs(numbers - moment.number).argmin()])
            points = record.points(number)
        for state in (record.start, record.end):
            if state is not None and state.mesh.points is points and _carries(state.mesh, mesh):
                break
        else:
            state = State.of(mesh.with_points(points))
        self._moments[state] = RecordedIteration(record, number)
        return state

    def _free_slot(self) -> int:
        """The least slot that no run has."""
        taken = {record.slot for record in self.records}
        return next(slot for slot in range(len(taken) + 1) if slot not in taken)

    def _thin(self) -> None:
        """Drop positions until they fit: each time those that leave the smallest gap for their age."""
        while self._bytes > self._limit:
            numbers = np.array([number for _, number, _ in self._kept])
            age = self._stamp + 1 - np.array([stamp for _, _, stamp in self._kept])
            owners = np.array([id(record) for record, _, _ in self._kept])
            begins = np.append(True, owners[1:] != owners[:-1])
            ends = np.append(begins[1:], True)
            before = np.where(begins, 0, np.roll(numbers, 1))
            gap = np.where(ends, np.inf, np.roll(numbers, -1) - before)
            if np.isinf(gap).all():
                break
            record, number, _ = self._kept.pop(int((gap / age).argmin()))
            self._bytes -= record._offsets.pop(number).nbytes


def _carries(one: Mesh, other: Mesh) -> bool:
    return one.pinned is other.pinned and one.hex_sets is other.hex_sets


__all__ = ["LIMIT", "History", "RecordedIteration", "RunRecord"]
