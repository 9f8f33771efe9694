"""Source that reads the contents of the opened session from its file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from weakref import WeakKeyDictionary

import numpy as np

from hexmend_app.features.script.lines import ScriptLines
from hexmend_app.formats.session.session_file import read_session
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.run_record import RunRecord
from hexmend_app.state.run.comparison import MethodResult
from hexmend_app.state.run.rerun import recorded
from hexmend_app.state.session import session_data
from hexmend_app.state.session.session import Session
from hexmend_app.state.session.session_data import SessionData, numbered


class SessionContents:
    """Source of states, runs and the comparison in the opened session file.

    Parameters
    ----------
    session : Session
    lines : ScriptLines
    """

    def __init__(self, session: Session, lines: ScriptLines):
        self._session, self._lines = session, lines
        self._states: WeakKeyDictionary[State, tuple[Path, int]] = WeakKeyDictionary()
        self._runs: WeakKeyDictionary[RunRecord, tuple[Path, int]] = WeakKeyDictionary()
        self._data: SessionData | None = None
        self._path = Path()
        self._count = 0
        self.clear()

    def clear(self) -> None:
        """Forget the names of sessions; they are read again when needed."""
        self._names: dict[Path, str] = {}

    def register(self, data: SessionData, path: Path) -> None:
        """Register the contents of an opened session."""
        self._data, self._path = data, path
        self._names.pop(path, None)
        for state, at in numbered(data).items():
            self._states[state] = path, at
        for at, record in enumerate(self._session.history.records[: len(data.history.records)]):
            self._runs[record] = path, at

    def update(self, path: Path, session: SessionData, name_of: Callable[[State], str | None]) -> None:
        """Update the indices in the script after a session file was overwritten.

        Parameters
        ----------
        path : Path
        session : SessionData
            Contents written to the file.
        name_of : callable
            Returns the existing name of a state in the script.
        """
        if self._data is None or path not in (at[0] for at in self._states.values()):
            return
        before, lines = dict(self._states.items()), self._lines
        session_name = self._names.get(path) if self._same(session) else None
        for places in (self._states, self._runs):
            for item in [item for item, place in places.items() if place[0] == path]:
                del places[item]
        self.register(session, path)
        valid = set()
        for state, old in before.items():
            name, new = name_of(state), self._states.get(state)
            if old[0] == path and name is not None and new is not None:
                line = f"{name} = {self._mesh_source(*new)}"
                if lines.change(f"{name} = {self._mesh_source(*old)}", line):
                    valid.add(line)
        if session_name is not None:
            self._names[path] = session_name
            valid.add(f"{session_name} = {self._data_source(path)}")
        lines.mark_overwritten(path, valid)

    def _same(self, session: SessionData) -> bool:
        """Return True if runs, snapshots and comparison have the same indices in another session."""
        old, records = self._data, self._session.history.records
        runs = all(at < len(records) and records[at] is record for record, (path, at) in self._runs.items()
                   if path == self._path)  # fmt: skip
        snapshots = len(session.snapshots) >= len(old.snapshots) and all(
            new.points is before.points for new, before in zip(session.snapshots, old.snapshots, strict=False)
        )
        return runs and snapshots and session.comparison.results is old.comparison.results

    def mesh(self, state: State) -> str | None:
        """Return the source that reads the mesh of a state, or None."""
        if state not in self._states:
            return None
        return self._mesh_source(*self._states[state])

    def run(self, record: RunRecord) -> str | None:
        """Return the source that reads a run, or None."""
        if record not in self._runs:
            return None
        path, at = self._runs[record]
        return f"{self._lines.use(recorded)}({self._session_name(path)}, {at})"

    def points(self, points: np.ndarray) -> str | None:
        """Return the source that reads a snapshot's points, or None."""
        for at, snapshot in enumerate(() if self._data is None else self._data.snapshots):
            if snapshot.points is points:
                return f"{self._session_name(self._path)}.snapshots[{at}].points"
        return None

    def comparison(self, results: tuple[MethodResult, ...]) -> str | None:
        """Return the source that reads the comparison with these results, or None."""
        if self._data is None or self._data.comparison.results is not results:
            return None
        return f"{self._session_name(self._path)}.comparison"

    def _session_name(self, path: Path) -> str:
        if path not in self._names:
            name = self._names[path] = f"session_{self._count}"
            self._count += 1
            self._lines.put("Contents of the session", f"{name} = {self._data_source(path)}")
        return self._names[path]

    def _mesh_source(self, path: Path, at: int) -> str:
        return f"{self._lines.use(read_session)}({str(path.absolute())!r}).meshes[{at}]"

    def _data_source(self, path: Path) -> str:
        return f"{self._lines.use(session_data.read)}({str(path.absolute())!r})"
