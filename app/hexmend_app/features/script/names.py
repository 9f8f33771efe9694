"""Names of meshes and runs in a script; a new object gets the lines that create it."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend_app.features.script.comparisons import Comparisons
from hexmend_app.features.script.lines import ScriptLines, call
from hexmend_app.features.script.runs import RunLines
from hexmend_app.features.script.source_code import made
from hexmend_app.features.script.stored import Stored
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.run_record import RecordedIteration, RunRecord
from hexmend_app.state.run.rerun import rerun
from hexmend_app.state.session.session import Session
from hexmend_app.state.session.session_data import SessionData


class Names:
    """Every mesh has a name of its own, which nothing else gets: what goes on from it says so by that name.

    Attributes
    ----------
    comparisons : Comparisons

    Parameters
    ----------
    session : Session
    lines : Lines
        The script, which is given the sources of what is named.
    """

    def __init__(self, session: Session, lines: ScriptLines):
        self._session, self._lines = session, lines
        self._paths: WeakKeyDictionary[State, Path] = WeakKeyDictionary()
        self._run_lines: WeakKeyDictionary[RunRecord, RunLines] = WeakKeyDictionary()
        self._kept: list[tuple[np.ndarray, RecordedIteration]] = []
        self._stored = Stored(session, lines)
        self.comparisons = Comparisons(session, lines, self.mesh, self._stored)
        self.clear()

    def clear(self) -> None:
        """Forget all names."""
        self._states: WeakKeyDictionary[State, str] = WeakKeyDictionary()
        self._runs: WeakKeyDictionary[RunRecord, tuple[str, frozenset[int]]] = WeakKeyDictionary()
        self._counts = {"mesh": 0, "run": 0}
        self._stored.clear()
        self.comparisons.clear()

    def __contains__(self, state: State) -> bool:
        return state in self._states

    # What comes to be

    def read(self, path: Path, state: State) -> None:
        """A state was read from a file."""
        self._paths[state] = path

    def written(self, path: Path, state: State) -> None:
        """A file holds a state, and no other any more."""
        for one in [one for one, other in self._paths.items() if other == path]:
            del self._paths[one]
        self._paths[state] = path

    def session_saved(self, path: Path, data: SessionData) -> None:
        """A session's file holds its states and its runs by other numbers."""
        self._stored.saved(path, data, self.known)

    def restored(self, data: Any, path: Path) -> None:
        """A session's file holds its states and its runs."""
        self._stored.take(data, path)

    def keep(self) -> None:
        """Know of which iterations the places are that the window keeps, before the iterations themselves are gone."""
        session, known = self._session, {id(points): moment for points, moment in self._kept}
        now, kept = session.document.now, [one.points for one in session.snapshots.all]
        if now is not None and (moment := session.history.moment_of(now)) is not None:
            known.setdefault(id(now.mesh.points), moment)
        self._kept = [(points, known[id(points)]) for points in kept if id(points) in known]

    def ended(self, record: RunRecord, run_lines: RunLines) -> None:
        """All is known of a run."""
        self._run_lines[record] = run_lines

    def add(self, title: str, state: State, source: str) -> None:
        """Tell what makes a state."""
        self._lines.put(title, f"{self.new(state)} = {source}")

    def new(self, state: State) -> str:
        """A name for a state, whose source follows."""
        self._states[state] = self._next("mesh")
        return self._states[state]

    def _next(self, kind: str) -> str:
        number = self._counts[kind]
        self._counts[kind] += 1
        return f"{kind}_{number}"

    # Meshes

    def known(self, state: State) -> str | None:
        """Return the existing name of a state in the script, or None."""
        return self._states.get(state)

    def mesh(self, state: State) -> str:
        """Return the name of a state's mesh; write the lines that create it if it has none."""
        if state in self._states:
            return self._states[state]
        moment = self._made_by(state)
        document = self._session.document
        if (source := self._stored.mesh(state)) is not None:
            self.add("From the session", state, source)
        elif (row := self.comparisons.row_of(state)) is not None:
            self._states[state] = f"{self.comparisons.row(row)}.mesh"
        elif state in self._paths:
            self.add("The mesh, as read", state, read_from(self._paths[state]))
        elif moment is not None and self._reaches(state):
            self._add_iteration(state, moment)
        else:
            path = document.path or Path(f"{state.mesh.name or 'mesh'}.vtu")
            self.add("The mesh, as the window had it: save it under this name first", state, read_from(path))
        return self._states[state]

    def places(self, mesh: Mesh) -> str:
        """The same of a mesh whose places alone matter."""
        state = next((one for one in self._states if one.mesh.points is mesh.points), None)
        state = state or self._session.state_at(mesh.points)
        if state is not None:
            return self.mesh(state)
        now = self.mesh(self._session.document.start)
        if (source := self._stored.points(mesh.points)) is not None:
            return f"{now}.with_points({source})"
        state = State.of(mesh)
        if (moment := next((one for points, one in self._kept if points is mesh.points), None)) is not None:
            self._session.history.note(state, moment)
        return self.mesh(state)

    def _made_by(self, state: State) -> RecordedIteration | None:
        """The iteration that a state is of; of a state where runs begin, that of the run before them."""
        moment = self._session.history.moment_of(state)
        while moment is not None and state is moment.record.start:
            moment = moment.record.parent
        return moment

    def _reaches(self, state: State) -> bool:
        """Return True if the script can create a state from named objects or files."""
        while not (state in self._states or state in self._paths or self._stored.mesh(state) is not None):
            moment = self._made_by(state)
            if moment is None or not self.repeats(moment.record):
                return self.comparisons.row_of(state) is not None
            state = moment.record.start
        return True

    def _add_iteration(self, state: State, moment: RecordedIteration) -> None:
        record, number = moment.record, moment.number
        same = record.start, record.end
        at = next((one for one in same if one is not None and one.mesh.points is state.mesh.points), None)
        run_lines = self.run_lines(record)
        if at is state and run_lines is not None and run_lines.stages:
            start, name = self.mesh(record.start), self.new(state)
            self._lines.put(moment.name, run_lines.smoothed(start, name))
            return
        base = self.mesh(self._like(state, record.start))
        if at is not None and at is not state:
            self.add(moment.name, state, f"{base}.with_points({self.mesh(at)}.points)")
            return
        if run_lines is None:
            points = f"{self.run(record)}.points({number})"
            self.add(moment.name, state, f"{base}.with_points({points})")
            return
        start = self.mesh(record.start)
        loop = run_lines.until(start, number)
        name = self.new(state)
        points, note = "it.points", ""
        if at is None and self._is_rounded(state, moment):
            points = f'{start}.points + (it.points - {start}.points).astype("f4")'
            note = "# The window keeps ways from the start in single precision.\n"
        self._lines.put(moment.name, f"{loop}\n{note}{name} = {base}.with_points({points})")

    def _is_rounded(self, state: State, moment: RecordedIteration) -> bool:
        try:
            return np.array_equal(moment.record.points(moment.number), state.mesh.points)
        except KeyError:  # it was thinned out since: only what comes from there is shown while no run goes on
            return not self._session.run.busy

    def _like(self, state: State, other: State) -> State:
        """A named state whose mesh carries what that of another does."""
        mine = state.mesh
        for one in reversed(list(self._states)):
            mesh = one.mesh
            if mesh.hexes is mine.hexes and mesh.pinned is mine.pinned and mesh.hex_sets is mine.hex_sets:
                return one
        return other

    # Runs

    def repeats(self, record: RunRecord) -> bool:
        """Return True if the script can repeat a run or read it from a session."""
        return self.run_lines(record) is not None or self._stored.run(record) is not None

    def run_lines(self, record: RunRecord) -> RunLines | None:
        """Return the data of a finished or current run; None for a run from a session."""
        if record in self._run_lines or record.work is None:
            return self._run_lines.get(record)
        return RunLines(record.work, record.stop, tuple(record.changes))

    def run(self, record: RunRecord, keep: Collection[int] = ()) -> str:
        """Return the name of a run in the script, with its history and some iterations."""
        name, kept = self._runs.get(record, ("", frozenset()))
        run_lines = self.run_lines(record)
        needed = frozenset(number for number in keep if number not in (0, record.result)) if run_lines else frozenset()
        if name and needed <= kept:
            return name
        arguments = self._stored.run(record) if run_lines is None else self._rerun(record, run_lines, needed)
        name = self._next("run")
        self._runs[record] = name, needed
        self._lines.put(f"{record.name}, with all that is known of it", f"{name} = {arguments}")
        return name

    def _rerun(self, record: RunRecord, run_lines: RunLines, keep: Collection[int]) -> str:
        words = [repr(record.name), self.mesh(record.start), *run_lines.arguments]
        until = run_lines.stopped if run_lines.stages or record.result is not None else record.newest
        if record.result is not None and not run_lines.stages:
            until = record.result  # it has failed later
        changes = ", ".join(f"({number}, {made(stage)})" for number, stage in run_lines.changes)
        words += [] if until is None else [f"until={until}"]
        words += [f"changes=[{changes}]"] if changes else []
        words += [f"keep={sorted(keep)}"] if keep else []
        words += [f"slot={record.slot}"] if record.slot else []
        if record.parent is not None and self.repeats(record.parent.record):
            words.append(f"parent=({self.run(record.parent.record)}, {record.parent.number})")
        if not record.plotted:
            words.append("plotted=False")
        return call(self._lines.use(rerun), words)


def read_from(path: Path) -> str:
    """The source that reads a mesh."""
    return f"hx.read({str(path.absolute())!r}).keeping_surface()"
