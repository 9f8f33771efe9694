"""States with which the open mesh is compared: as opened, at the start of the run, or an iteration ago."""

from __future__ import annotations

from hexmend_app.picture.appearance import FILE_OPENED, Since
from hexmend_app.picture.displacement import Displacement, ReferenceState
from hexmend_app.state.mesh import history
from hexmend_app.state.mesh.document import Document, MeasuredMesh
from hexmend_app.state.mesh.history import History
from hexmend_app.state.mesh.run_record import CONSTANT
from hexmend_app.translation import tr


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
        self._iteration: tuple[history.RecordedIteration, MeasuredMesh] | None = None

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

    def _find(self, since: Since, shown: history.RecordedIteration | None) -> tuple[MeasuredMesh, str]:
        """Return the earlier state and its name; `shown` is the iteration that the document shows."""
        if since is Since.OPENED or shown is None:
            return self._document.start, FILE_OPENED
        record = shown.record
        if since is Since.ITERATION and shown.number:
            numbers = self._history.recorded_numbers(record)
            before = history.RecordedIteration(record, int(numbers[numbers < shown.number].max()))
            if before.number:
                return self._state(before), before.name
        return record.start, CONSTANT if record.holds_times else tr("{run} started", run=record.name)

    def _state(self, iteration: history.RecordedIteration) -> MeasuredMesh:
        if self._iteration is None or self._iteration[0] != iteration:
            self._iteration = iteration, self._history.state(iteration, self._document.now.mesh)
        return self._iteration[1]
