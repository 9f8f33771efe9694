"""Names of meshes and runs in a script; a new object is added with the lines that create it."""

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
from hexmend_app.features.script.session_contents import SessionContents
from hexmend_app.features.script.source_code import source_of
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.run_record import RecordedIteration, RunRecord
from hexmend_app.state.run.case_times import recorded_times
from hexmend_app.state.run.rerun import rerun
from hexmend_app.state.session.session import Session
from hexmend_app.state.session.session_data import SessionData


class Names:
    """Names of meshes and runs; each is used for one object only.

    Attributes
    ----------
    comparisons : Comparisons

    Parameters
    ----------
    session : Session
    lines : ScriptLines
        Receives the source of new objects.
    """

    def __init__(self, session: Session, lines: ScriptLines):
        self._session, self._lines = session, lines
        self._paths: WeakKeyDictionary[State, Path] = WeakKeyDictionary()
        self._run_lines: WeakKeyDictionary[RunRecord, RunLines] = WeakKeyDictionary()
        self._snapshot_moments: list[tuple[np.ndarray, RecordedIteration]] = []
        self._contents = SessionContents(session, lines)
        self.comparisons = Comparisons(session, lines, self.mesh, self._contents)
        self.clear()

    def clear(self) -> None:
        """Forget all names."""
        self._states: WeakKeyDictionary[State, str] = WeakKeyDictionary()
        self._runs: WeakKeyDictionary[RunRecord, tuple[str, frozenset[int]]] = WeakKeyDictionary()
        self._counts = {"mesh": 0, "run": 0}
        self._contents.clear()
        self.comparisons.clear()

    def __contains__(self, state: State) -> bool:
        return state in self._states

    # Events

    def register_file(self, path: Path, state: State) -> None:
        """Register a state that was read from a file."""
        self._paths[state] = path

    def register_written(self, path: Path, state: State) -> None:
        """Register a state that was written to a file, instead of the state that the file contained before."""
        for old in [old for old, other in self._paths.items() if other == path]:
            del self._paths[old]
        self._paths[state] = path

    def update_session(self, path: Path, data: SessionData) -> None:
        """Update the numbers of states and runs after a session file was written."""
        self._contents.update(path, data, self.name_of)

    def register_session(self, data: Any, path: Path) -> None:
        """Register the states and runs of an opened session file."""
        self._contents.register(data, path)

    def remember_snapshots(self) -> None:
        """Remember the iterations of the snapshots, before the history drops them."""
        session, known = self._session, {id(points): moment for points, moment in self._snapshot_moments}
        now, snapshots = session.document.now, [snapshot.points for snapshot in session.snapshots.all]
        if now is not None and (moment := session.history.iteration_of(now)) is not None:
            known.setdefault(id(now.mesh.points), moment)
        self._snapshot_moments = [(points, known[id(points)]) for points in snapshots if id(points) in known]

    def register_run(self, record: RunRecord, run_lines: RunLines) -> None:
        """Register the data of a run that has ended."""
        self._run_lines[record] = run_lines

    def add_state(self, title: str, state: State, source: str) -> None:
        """Add an entry that creates a state."""
        self._lines.put(title, f"{self.new_name(state)} = {source}")

    def new_name(self, state: State) -> str:
        """Return a new name for a state."""
        self._states[state] = self._next("mesh")
        return self._states[state]

    def _next(self, kind: str) -> str:
        number = self._counts[kind]
        self._counts[kind] += 1
        return f"{kind}_{number}"

    # Meshes

    def name_of(self, state: State) -> str | None:
        """Return the existing name of a state in the script, or None."""
        return self._states.get(state)

    def mesh(self, state: State) -> str:
        """Return the name of a state's mesh; write the lines that create it if it has none."""
        if state in self._states:
            return self._states[state]
        moment = self._iteration_of(state)
        document = self._session.document
        if (source := self._contents.mesh(state)) is not None:
            self.add_state("From the session", state, source)
        elif (row := self.comparisons.row_of(state)) is not None:
            self._states[state] = self.comparisons.mesh(row)
        elif state in self._paths:
            self.add_state("The mesh as read", state, read_from(self._paths[state]))
        elif moment is not None and self._can_create(state):
            self._add_iteration(state, moment)
        else:
            path = document.path or Path(f"{state.mesh.name or 'mesh'}.vtu")
            self.add_state("The mesh in the window: save it under this name first", state, read_from(path))
        return self._states[state]

    def mesh_at(self, mesh: Mesh) -> str:
        """Return the source of a mesh of which only the node positions matter."""
        state = next((known for known in self._states if known.mesh.points is mesh.points), None)
        state = state or self._session.state_at(mesh.points)
        if state is not None:
            return self.mesh(state)
        now = self.mesh(self._session.document.start)
        if (source := self._contents.points(mesh.points)) is not None:
            return f"{now}.with_points({source})"
        state = State.of(mesh)
        moment = next((moment for points, moment in self._snapshot_moments if points is mesh.points), None)
        if moment is not None:
            self._session.history.register_state(state, moment)
        return self.mesh(state)

    def _iteration_of(self, state: State) -> RecordedIteration | None:
        """Return the iteration that produced a state; for the start of a run, the iteration of the run before it."""
        moment = self._session.history.iteration_of(state)
        while moment is not None and state is moment.record.start:
            moment = moment.record.parent
        return moment

    def _can_create(self, state: State) -> bool:
        """Return True if the script can create a state from named objects or files."""
        while not (state in self._states or state in self._paths or self._contents.mesh(state) is not None):
            moment = self._iteration_of(state)
            if moment is None or not self.repeats(moment.record):
                return self.comparisons.row_of(state) is not None
            state = moment.record.start
            if moment.record.case is not None:  # which may have been opened before the script began
                self._paths.setdefault(state, moment.record.case)
        return True

    def _add_iteration(self, state: State, moment: RecordedIteration) -> None:
        record, number = moment.record, moment.number
        ends = record.start, record.end
        same = next((end for end in ends if end is not None and end.mesh.points is state.mesh.points), None)
        run_lines = self.run_lines(record)
        if record.holds_times and same is None:
            self._add_time(state, moment)
            return
        if same is state and run_lines is not None and run_lines.stages:
            start, name = self.mesh(record.start), self.new_name(state)
            self._lines.put(moment.name, run_lines.smoothed(start, name))
            return
        base = self.mesh(self._similar(state, record.start))
        if same is not None and same is not state:
            self.add_state(moment.name, state, f"{base}.with_points({self.mesh(same)}.points)")
            return
        if run_lines is None:
            points = f"{self.run(record)}.points({number})"
            self.add_state(moment.name, state, f"{base}.with_points({points})")
            return
        start = self.mesh(record.start)
        loop = run_lines.until(start, number)
        name = self.new_name(state)
        points, note = "it.points", ""
        if same is None and self._is_rounded(state, moment):
            points = f'{start}.points + (it.points - {start}.points).astype("f4")'
            note = "# The window stores displacements from the start in single precision.\n"
        self._lines.put(moment.name, f"{loop}\n{note}{name} = {base}.with_points({points})")

    def _add_time(self, state: State, moment: RecordedIteration) -> None:
        """Write the lines for the mesh at a time of a case, whose boundary is that of the time."""
        base, run = self.mesh(self._similar(state, moment.record.start)), self.run(moment.record)
        points, name = f"points = {run}.points({moment.number})", self.new_name(state)
        self._lines.put(moment.name, f"{points}\n{name} = {base}.with_points(points).moving_from(points)")

    def _is_rounded(self, state: State, moment: RecordedIteration) -> bool:
        try:
            return np.array_equal(moment.record.points(moment.number), state.mesh.points)
        except KeyError:  # the history dropped it; only without a run was the displayed state read from the history
            return not self._session.run.busy

    def _similar(self, state: State, other: State) -> State:
        """Return a named state with the hexes, pins and tags of `state`; without one, `other`."""
        wanted = state.mesh
        for known in reversed(list(self._states)):
            mesh = known.mesh
            if mesh.hexes is wanted.hexes and mesh.pinned is wanted.pinned and mesh.hex_sets is wanted.hex_sets:
                return known
        return other

    # Runs

    def repeats(self, record: RunRecord) -> bool:
        """Return True if the script can repeat a run or read it from a session, or the times of a case from it."""
        return self.run_lines(record) is not None or self._contents.run(record) is not None or record.case is not None

    def run_lines(self, record: RunRecord) -> RunLines | None:
        """Return the data of a finished or current run; None for a run from a session."""
        if record in self._run_lines or record.work is None:
            return self._run_lines.get(record)
        return RunLines.of_active(record)

    def run(self, record: RunRecord, keep: Collection[int] = ()) -> str:
        """Return the name of a run in the script, with its history and some iterations."""
        name, available = self._runs.get(record, ("", frozenset()))
        run_lines = self.run_lines(record)
        needed = frozenset(number for number in keep if number not in (0, record.result)) if run_lines else frozenset()
        if name and needed <= available:
            return name
        source = self._contents.run(record) if run_lines is None else self._rerun(record, run_lines, needed)
        if source is None and record.case is not None:
            arguments = [repr(str(record.case.absolute())), self.mesh(record.start)]
            arguments += [f"slot={record.slot}"] * bool(record.slot) + ["plotted=False"] * (not record.plotted)
            source = call(self._lines.use(recorded_times), arguments)
        name = self._next("run")
        self._runs[record] = name, needed
        self._lines.put(f"{record.name}, with its history", f"{name} = {source}")
        return name

    def _rerun(self, record: RunRecord, run_lines: RunLines, keep: Collection[int]) -> str:
        arguments = [repr(record.name), self.mesh(record.start), run_lines.arguments]
        until = run_lines.stopped if run_lines.stages or record.result is not None else record.newest
        if record.result is not None and not run_lines.stages:
            until = record.result  # the run failed after its last valid iteration
        changes = ", ".join(f"({number}, {source_of(stage)})" for number, stage in run_lines.changes)
        arguments += [] if until is None else [f"until={until}"]
        arguments += [f"changes=[{changes}]"] if changes else []
        arguments += [f"keep={sorted(keep)}"] if keep else []
        arguments += [f"slot={record.slot}"] if record.slot else []
        if run_lines.rules:
            arguments.append(f"rules={self._lines.source(run_lines.rules)}")
        if record.parent is not None and self.repeats(record.parent.record):
            arguments.append(f"parent=({self.run(record.parent.record)}, {record.parent.number})")
        if not record.plotted:
            arguments.append("plotted=False")
        return call(self._lines.use(rerun), arguments)


def read_from(path: Path) -> str:
    """Return the source that reads a mesh."""
    return f"hx.read({str(path.absolute())!r}).keeping_surface()"
