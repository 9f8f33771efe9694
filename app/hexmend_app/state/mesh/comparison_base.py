"""States with which the open mesh is compared: as opened, at the start of the run, or an iteration ago."""

from __future__ import annotations

from hexmend.boundary.displacement import Displacement, ReferenceState
from hexmend_app.picture.appearance import Since
from hexmend_app.state.mesh import history
from hexmend_app.state.mesh.document import Document, State
from hexmend_app.state.mesh.history import History


class ComparisonBases:
    """Finds the moments to compare with; what was found last is remembered.

    Parameters
    ----------
    document : Document
    records : History
    """

    def __init__(self, document: Document, records: History):
        self._document, self._history = document, records
        self._last: tuple[tuple, Displacement] | None = None
        self._before: tuple[State, ReferenceState] | None = None
        self._measured: tuple[history.RecordedIteration, State] | None = None

    def movement(self, since: Since) -> Displacement:
        """From then until what is shown now."""
        now = self._document.now
        shown = self._history.moment_of(now)
        asked = (now, since, shown)
        if self._last is None or self._last[0] != asked:
            state, name = self._find(since, shown)
            before = self._moment(state, name)
            self._last = asked, Displacement(self._document.start.mesh, before, now.mesh.points, now.figures)
        return self._last[1]

    def _moment(self, state: State, name: str) -> ReferenceState:
        """A state to compare with: the same as long as it is the one, with what is known of its surface."""
        if self._before is None or self._before[0] is not state or self._before[1].name != name:
            self._before = state, ReferenceState(state.mesh.points, state.figures, name)
        return self._before[1]

    def _find(self, since: Since, shown: history.RecordedIteration | None) -> tuple[State, str]:
        if since is Since.OPENED or shown is None:
            return self._document.start, "opening"
        record = shown.record
        if since is Since.ITERATION and shown.number:
            kept = self._history.kept(record)
            before = history.RecordedIteration(record, int(kept[kept < shown.number].max()))
            if before.number:
                return self._state(before), before.name
        return record.start, f"{record.name} began"

    def _state(self, moment: history.RecordedIteration) -> State:
        if self._measured is None or self._measured[0] != moment:
            self._measured = moment, self._history.state(moment, self._document.now.mesh)
        return self._measured[1]
