"""What the session that was opened holds, as source that reads it from its file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from weakref import WeakKeyDictionary

import numpy as np

from hexmend.io.formats.session.session_file import read_session
from hexmend_app.features.script.lines import Lines
from hexmend_app.state import session_data
from hexmend_app.state.comparison import Compared
from hexmend_app.state.document import State
from hexmend_app.state.record import Record
from hexmend_app.state.rerun import recorded
from hexmend_app.state.session import Session
from hexmend_app.state.session_data import SessionData, numbered


class Stored:
    """Knows where a session's file has its states, its runs, and what it compares.

    Parameters
    ----------
    session : Session
    lines : Lines
    """

    def __init__(self, session: Session, lines: Lines):
        self._session, self._lines = session, lines
        self._states: WeakKeyDictionary[State, tuple[Path, int]] = WeakKeyDictionary()
        self._runs: WeakKeyDictionary[Record, tuple[Path, int]] = WeakKeyDictionary()
        self._data: SessionData | None = None
        self._path = Path()
        self._count = 0
        self.clear()

    def clear(self) -> None:
        """Read it anew where it is needed again."""
        self._names: dict[Path, str] = {}

    def take(self, data: SessionData, path: Path) -> None:
        """A session was opened."""
        self._data, self._path = data, path
        self._names.pop(path, None)
        for state, at in numbered(data).items():
            self._states[state] = path, at
        for at, record in enumerate(self._session.history.records[: len(data.history.records)]):
            self._runs[record] = path, at

    def saved(self, path: Path, session: SessionData, known: Callable[[State], str | None]) -> None:
        """A session was saved; what the script reads from that file is read by its new numbers.

        Parameters
        ----------
        path : Path
        session : SessionData
            What was written.
        known : callable
            What the script calls a state already.
        """
        if self._data is None or path not in (at[0] for at in self._states.values()):
            return
        before, lines = dict(self._states.items()), self._lines
        whole = self._names.get(path) if self._same(session) else None
        for kept in (self._states, self._runs):
            for one in [one for one, at in kept.items() if at[0] == path]:
                del kept[one]
        self.take(session, path)
        good = set()
        for state, at in before.items():
            called, new = known(state), self._states.get(state)
            if at[0] == path and called is not None and new is not None:
                line = f"{called} = {self._reads(*new)}"
                if lines.change(f"{called} = {self._reads(*at)}", line):
                    good.add(line)
        if whole is not None:
            self._names[path] = whole
            good.add(f"{whole} = {self._whole(path)}")
        lines.overwritten(path, good)

    def _same(self, session: SessionData) -> bool:
        """Whether all that the script may read of a session, besides meshes, has the same numbers in another."""
        old, records = self._data, self._session.history.records
        runs = all(at < len(records) and records[at] is one for one, (path, at) in self._runs.items()
                   if path == self._path)  # fmt: skip
        kept = [one.points for one in old.kept]
        places = len(session.kept) >= len(kept) and all(
            one.points is points for one, points in zip(session.kept, kept, strict=False)
        )
        return runs and places and session.comparison.results is old.comparison.results

    def mesh(self, state: State) -> str | None:
        """What reads the mesh of a state."""
        if state not in self._states:
            return None
        return self._reads(*self._states[state])

    def run(self, record: Record) -> str | None:
        """What reads a run."""
        if record not in self._runs:
            return None
        path, at = self._runs[record]
        return f"{self._lines.use(recorded)}({self._session_of(path)}, {at})"

    def points(self, points: np.ndarray) -> str | None:
        """What reads where nodes are that the session has kept."""
        for at, one in enumerate(() if self._data is None else self._data.kept):
            if one.points is points:
                return f"{self._session_of(self._path)}.kept[{at}].points"
        return None

    def comparison(self, results: tuple[Compared, ...]) -> str | None:
        """What reads the comparison with these results."""
        if self._data is None or self._data.comparison.results is not results:
            return None
        return f"{self._session_of(self._path)}.comparison"

    def _session_of(self, path: Path) -> str:
        if path not in self._names:
            name = self._names[path] = f"session_{self._count}"
            self._count += 1
            self._lines.put("All that the session holds", f"{name} = {self._whole(path)}")
        return self._names[path]

    def _reads(self, path: Path, at: int) -> str:
        return f"{self._lines.use(read_session)}({str(path.absolute())!r}).meshes[{at}]"

    def _whole(self, path: Path) -> str:
        return f"{self._lines.use(session_data.read)}({str(path.absolute())!r})"
