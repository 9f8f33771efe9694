"""History of the runs on the open mesh: quality and node positions of iterations, and states to compare it with."""

from __future__ import annotations

import threading
from collections.abc import Iterable
from weakref import WeakKeyDictionary

import numpy as np

from hexmend.iteration import Iteration
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import printable
from hexmend_app.picture.appearance import FILE_OPENED, Since
from hexmend_app.picture.displacement import Displacement, ReferenceState
from hexmend_app.state.mesh.document import OWN_PARTS, Command, Document, MeasuredMesh
from hexmend_app.state.mesh.run_record import CONSTANT, HistoryData, RecordedIteration, RunRecord, record_data
from hexmend_app.state.settings.settings import HISTORY_MEGABYTES
from hexmend_app.translation import tr

#: Default limit of the memory of positions in bytes: 400 iterations of 110,000 hexes.
LIMIT = HISTORY_MEGABYTES.default << 20


class History:
    """History of the runs on the open mesh.

    Runs add iterations from their own threads, so that none is lost. If positions exceed the memory limit, some of the
    longest run are dropped. Those of the start, the newest iteration and the result of a run are always
    recorded.

    Parameters
    ----------
    limit : float
        Memory limit of positions in bytes.

    Attributes
    ----------
    records : list of RunRecord
        Oldest first.
    bytes : int
        Memory of the recorded positions in bytes.
    limit : int
        Its limit, set by `set_limit`.
    """

    def __init__(self, limit: int = LIMIT):
        self.records: list[RunRecord] = []
        self.limit = limit
        self.bytes = 0
        self._lock = threading.Lock()
        self._iterations: WeakKeyDictionary[MeasuredMesh, RecordedIteration] = WeakKeyDictionary()

    def set_limit(self, limit: int) -> None:
        """Set the memory limit in bytes; a lower one drops positions at once."""
        with self._lock:
            self.limit = limit
            self._thin()

    def begin(self, title: str, start: MeasuredMesh) -> RunRecord:
        """Add and return the record of a new run, whose parent is the iteration that `start` shows.

        Parameters
        ----------
        title : str
            Title of the method or the recipe.
        start : MeasuredMesh
        """
        names = {record.name for record in self.records}
        count = 1
        while (name := f"{title} ({count})" if count > 1 else title) in names:
            count += 1
        record = RunRecord(name, title, start, self.iteration_of(start), self._free_slot())
        self.records.append(record)
        self._iterations[start] = RecordedIteration(record, 0)
        return record

    def add(self, record: RunRecord, iteration: Iteration, positions: bool = True) -> None:
        """Record an iteration, and its node positions unless `positions` is False; called in the thread of the run.

        Iterations of a run that has been removed are ignored: its thread may still be at work.
        """
        numbers = {name: value for name, value in iteration.diagnostics.items() if isinstance(value, (int, float, str))}
        row = numbers | iteration.row()
        offsets = record.compact(iteration.points) if iteration.number and positions else None
        with self._lock:
            if not any(known is record for known in self.records):
                return
            if offsets is not None:
                record._offsets[iteration.number] = offsets
                self.bytes += offsets.nbytes
                self._thin()
            record.rows.append(row)  # last, so that the positions of every row are there

    def finish(
        self, record: RunRecord, result: RecordedIteration | None, end: MeasuredMesh | None, message: str
    ) -> None:
        """Complete the record of a run that has ended; a record without iterations is removed."""
        record.message = message
        if record.newest < 1:
            self.remove(record)
            return
        if result is not None:
            record.result, record.end = result.number, end
            self._iterations[end] = result

    def remove(self, record: RunRecord) -> None:
        """Remove a run."""
        with self._lock:
            self.records = [other for other in self.records if other is not record]
            self.bytes -= sum(offsets.nbytes for offsets in record._offsets.values())
            record._offsets.clear()
        for state, iteration in list(self._iterations.items()):
            if iteration.record is record:
                del self._iterations[state]

    def clear(self) -> None:
        """Remove all runs."""
        for record in list(self.records):
            self.remove(record)

    def to_data(self, states: Iterable[MeasuredMesh]) -> HistoryData:
        """Return the data for a session file, with the iterations that some states show."""
        with self._lock:
            started = [record for record in self.records if record.rows]
            at = {record: number for number, record in enumerate(started)}
            records = tuple(record_data(record, at, record._offsets) for record in started)
        iterations = ((state, self.iteration_of(state)) for state in dict.fromkeys(states))
        shown = [(state, at[one.record], one.number) for state, one in iterations if one and one.record in at]
        return HistoryData(records, tuple(shown))

    def restore(self, data: HistoryData) -> None:
        """Replace the runs by the runs of a session file; positions beyond the limit are dropped."""
        self.clear()
        for saved in data.records:
            parent = None if saved.parent is None else RecordedIteration(self.records[saved.parent[0]], saved.parent[1])
            slot = self._free_slot() if saved.slot is None else saved.slot
            record = RunRecord(printable(saved.name), saved.title, saved.start, parent, slot)
            record.plotted, record.settings = saved.plotted, printable(saved.settings)
            record.rows, record.result, record.end = [dict(row) for row in saved.rows], saved.result, saved.end
            record.message, record.pauses, record.advice = saved.message, dict(saved.pauses), saved.advice
            record.recipe = saved.recipe
            self.records.append(record)
            self._iterations[saved.start] = RecordedIteration(record, 0)
            if saved.end is not None:
                self._iterations[saved.end] = RecordedIteration(record, saved.result)
            with self._lock:
                for number, offsets in saved.offsets:
                    record._offsets[number] = offsets
                    self.bytes += offsets.nbytes
        for state, run, number in data.iterations:
            self._iterations[state] = RecordedIteration(self.records[run], number)
        with self._lock:
            self._thin()

    def register_state(self, state: MeasuredMesh, iteration: RecordedIteration) -> None:
        """Remember which iteration a state shows."""
        self._iterations[state] = iteration

    def iteration_of(self, state: MeasuredMesh | None) -> RecordedIteration | None:
        """Find the iteration that a state shows, even after nodes were fixed or hexes tagged; None if there is none."""
        if state is None:
            return None
        if state not in self._iterations:
            same = (one for other, one in self._iterations.items() if other.mesh.points is state.mesh.points)
            iteration = next(same, None)
            if iteration is None:
                return None
            self._iterations[state] = iteration  # the other state may be deleted before this one
        return self._iterations[state]

    def command_of(self, state: MeasuredMesh, recorded: MeasuredMesh) -> Command | None:
        """Return the call that makes an iteration of a run again; None for other states.

        Parameters
        ----------
        state : MeasuredMesh
            State shown.
        recorded : MeasuredMesh
            State of the current change, which has the same `OWN_PARTS`.
        """
        iteration = self.iteration_of(state)
        if iteration is None:
            return None
        start = iteration.record.start
        if not iteration.number:
            return None if state is start else Command("move", (recorded, start))
        recipe = iteration.record.recipe_until(iteration.number)
        like = start if _same_own_parts(state.mesh, start.mesh) else recorded
        return None if recipe is None else Command("smooth", (start, like), recipe=recipe)

    def recorded_numbers(self, record: RunRecord) -> np.ndarray:
        """Return the numbers of the iterations whose positions are recorded, ascending, (k,) int."""
        with self._lock:
            return record.numbers()

    def state(self, iteration: RecordedIteration, mesh: Mesh) -> MeasuredMesh:
        """Return the state at an iteration, or at the nearest recorded one; `iteration_of` tells which.

        Parameters
        ----------
        iteration : RecordedIteration
        mesh : Mesh
            The open mesh, whose `OWN_PARTS` the state gets.
        """
        record = iteration.record
        with self._lock:
            numbers = record.numbers()
            number = int(numbers[np.abs(numbers - iteration.number).argmin()])
            points = record.points(number)
        for state in (record.start, record.end):
            if state is not None and state.mesh.points is points and _same_own_parts(state.mesh, mesh):
                break
        else:
            state = _state_with(mesh, record, points)
        self._iterations[state] = RecordedIteration(record, number)
        return state

    def _free_slot(self) -> int:
        """Return the smallest slot that no run uses."""
        used = {record.slot for record in self.records}
        return next(slot for slot in range(len(used) + 1) if slot not in used)

    def _thin(self) -> None:
        """Drop the position between the nearest two others, of the run with the most, until the limit is met."""
        while self.bytes > self.limit:
            record = max(self.records, key=lambda one: len(one._offsets))
            numbers = [0, *record._offsets]
            if len(numbers) < 3:
                break
            at = min(range(1, len(numbers) - 1), key=lambda k: numbers[k + 1] - numbers[k - 1])
            self.bytes -= record._offsets.pop(numbers[at]).nbytes


def _state_with(mesh: Mesh, record: RunRecord, points: np.ndarray) -> MeasuredMesh:
    """Return the state of the open mesh with the positions of a record."""
    mesh = mesh.with_points(points)
    surface = mesh.points if record.holds_times else record.start.mesh.surface_points
    return MeasuredMesh.of(mesh if mesh.surface_points is surface else mesh.moving_from(surface))


def _same_own_parts(mesh: Mesh, other: Mesh) -> bool:
    return all(getattr(mesh, part) is getattr(other, part) for part in OWN_PARTS)


class ComparisonBases:
    """Computes displacements from earlier states to the current one; the last is cached.

    Parameters
    ----------
    document : Document
    records : History
    """

    def __init__(self, document: Document, records: History):
        self._document, self._history = document, records
        self._last: tuple[tuple, Displacement] | None = None
        self._reference: tuple[MeasuredMesh, ReferenceState] | None = None
        self._iteration: tuple[RecordedIteration, MeasuredMesh] | None = None

    def displacement(self, since: Since) -> Displacement:
        """Return the displacement from an earlier state to the one shown."""
        now = self._document.now
        shown = self._history.iteration_of(now)
        key = (now, since, shown)
        if self._last is None or self._last[0] != key:
            reference = self._reference_state(*self._find(since, shown))
            self._last = key, Displacement(self._document.start.mesh, reference, now.mesh.points, now.quality)
        return self._last[1]

    def _reference_state(self, state: MeasuredMesh, name: str) -> ReferenceState:
        """Return the reference of a state; the last is cached, as it caches data of its surface."""
        if self._reference is None or self._reference[0] is not state or self._reference[1].name != name:
            self._reference = state, ReferenceState(state.mesh.points, state.quality, name)
        return self._reference[1]

    def _find(self, since: Since, shown: RecordedIteration | None) -> tuple[MeasuredMesh, str]:
        """Return the earlier state and its name; `shown` is the iteration that the document shows."""
        if since is Since.OPENED or shown is None:
            return self._document.start, FILE_OPENED
        record = shown.record
        if since is Since.ITERATION and shown.number:
            numbers = self._history.recorded_numbers(record)
            before = RecordedIteration(record, int(numbers[numbers < shown.number].max()))
            if before.number:
                return self._state(before), before.name
        return record.start, CONSTANT if record.holds_times else tr("{run} started", run=record.name)

    def _state(self, iteration: RecordedIteration) -> MeasuredMesh:
        if self._iteration is None or self._iteration[0] != iteration:
            self._iteration = iteration, self._history.state(iteration, self._document.now.mesh)
        return self._iteration[1]
