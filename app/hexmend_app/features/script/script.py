"""Script of a window: an entry for each action that changes the mesh or writes a file, and the current view."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Signal

from hexmend.io.storage.atomic import atomic_write
from hexmend.iteration import Result
from hexmend.mesh.mesh import Mesh
from hexmend.report import write_comparison
from hexmend.study.table_row import Row
from hexmend_app.features.script.lines import ScriptLines, call
from hexmend_app.features.script.names import Names, read_from
from hexmend_app.features.script.runs import RunLines
from hexmend_app.features.script.source_code import mesh_call, source_of
from hexmend_app.features.script.view_lines import ViewLines
from hexmend_app.picture import Scene
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.run_record import RunRecord
from hexmend_app.state.node_step import Sweep
from hexmend_app.state.run.node_sweep import SweepResult
from hexmend_app.state.session.restored_picture import RestoredPicture
from hexmend_app.state.session.session import Session
from hexmend_app.state.session.session_data import SessionData
from hexmend_app.state.session.user_events import (
    FileExported,
    IterationsExported,
    MeshEdited,
    MeshSaved,
    NodesMoved,
    TableExported,
    UndoOrRedo,
    UserEvent,
)


class Script(QObject):
    """Record of the user's actions as calls of the Python library.

    Attributes
    ----------
    entries : list of str
        Actions, each a comment and Python source.
    scene : callable
        Returns the scene of the view, or None; set by the owner of the view.

    Signals
    -------
    changed
        The entries have changed.
    """

    changed = Signal()

    def __init__(self, session: Session, parent: QObject | None = None):
        super().__init__(parent)
        self._session, self._document = session, session.document
        self._lines = ScriptLines(self.changed.emit)
        self._names = Names(session, self._lines)
        self.scene: Callable[[], Scene | None] = lambda: None
        session.opener.loaded.connect(self._on_session)
        session.opener.ended.connect(self._on_opened)
        session.opener.restored.connect(self._on_restored)
        session.user_event.connect(self._on_done)
        session.node_sweep.recorded.connect(self._on_sweep_recorded)
        session.comparison.changed.connect(self._on_compared)
        session.snapshots.changed.connect(self._names.remember_snapshots)
        session.run.ended.connect(self._on_ended)
        session.run.failed.connect(self._on_failed)

    @property
    def entries(self) -> list[str]:
        """Actions, each a comment and Python source."""
        return self._lines.entries

    @property
    def text(self) -> str:
        """The whole script, which `python FILE` runs, with the current view at its end."""
        view = self._view_lines
        return self._lines.text(view.source if view is not None else "")

    @property
    def _view_lines(self) -> ViewLines | None:
        if not self._document.is_open or (scene := self.scene()) is None:
            return None
        now = self._document.now
        moment, known = self._session.history.iteration_of(now), self._names.name_of(now)
        name = self._document.name if moment is None else moment.name
        if (sweep := self._session.node_sweep.sweep) is not None:
            name = f"{sweep.done} of {sweep.nodes.size} steps of a sweep"
        return ViewLines(scene, f"{name}, {known}" if known else name)

    def restart(self) -> None:
        """Clear the script; it continues from the current mesh."""
        self._names.clear()
        self._lines.clear()

    def write(self, path: str | Path) -> None:
        """Write the script to a file; raise `FileError` if that fails."""
        with atomic_write(path) as temporary:
            Path(temporary).write_text(self.text, encoding="utf-8", errors="backslashreplace")

    # Meshes

    def _on_opened(self, path: Path) -> None:
        state = self._document.now
        if state not in self._names:
            self._names.register_file(path, state)
            self._names.add_state(f"Open {path.name}", state, read_from(path))

    def _on_restored(self, restored: RestoredPicture) -> None:
        """Register the files of the other meshes in a restored picture."""
        for other in restored.others:
            if other.state is not None:
                self._names.register_file(other.path, other.state)

    def _on_session(self, data: SessionData, path: Path | None) -> None:
        """Register the contents of a session file; `path` is None for a recovered session, whose file is temporary."""
        if path is not None:
            self._names.register_session(data, path)
        self._names.mesh(self._document.now)

    def _on_done(self, event: UserEvent) -> None:
        names, put = self._names, self._lines.put
        match event:
            case MeshEdited(after=after, before=before):
                if after not in names:
                    function = self._lines.use(event.change)
                    source = mesh_call(function, event.change, names.mesh(before), event.values)
                    names.add_state(event.title, after, source)
            case NodesMoved(after=after, before=before):
                if after not in names:
                    source, mesh = names.mesh(event.source), names.mesh(before)
                    other = after.mesh.surface_points is not before.mesh.surface_points  # after a time of a case
                    moving = f".moving_from({source}.surface_points)" * other
                    names.add_state(event.title, after, f"{mesh}.with_points({source}.points){moving}")
            case UndoOrRedo():
                put(f"{'undo' if event.undone else 'redo'} {event.title}: continue with {names.mesh(event.now)}")
            case MeshSaved(data=SessionData()):
                names.update_session(event.path, event.data)
                put(f"the session was saved as {event.path}")
            case MeshSaved():
                like = "" if event.like is None else f", like={str(event.like.absolute())!r}"
                source = f"hx.write({str(event.path.absolute())!r}, {names.mesh(event.now)}{like})"
                self._lines.mark_overwritten(event.path)
                put("save", source)
                names.register_written(event.path, event.now)
            case TableExported():
                arguments = [self._source_of(event.path), f"{names.comparisons.name()}.record()"]
                if event.names or event.title is not None:
                    arguments += [repr(dict(event.names or {})), repr(event.title)]
                put("table", call(self._lines.use(write_comparison), arguments))
            case FileExported():
                arguments = [self._source_of(value) for value in event.values]
                arguments += [f"{name}={self._source_of(value)}" for name, value in event.options.items()]
                put(event.title, call(self._lines.use(event.function), arguments))

    def _source_of(self, value: Any) -> str:
        """Return the source of a value of an event."""
        match value:
            case State():
                return self._names.mesh(value)
            case Mesh():
                return self._names.mesh_at(value)
            case IterationsExported():
                return self._names.run(value.record, value.numbers)
            case RunRecord():
                return self._names.run(value)
            case Row():
                return self._names.comparisons.row(value)
            case list():
                return f"[{', '.join(map(self._source_of, value))}]"
            case tuple():
                return f"({', '.join(map(self._source_of, value))}{',' * (len(value) == 1)})"
            case dict():
                entries = (f"{self._source_of(key)}: {self._source_of(item)}" for key, item in value.items())
                return f"{{{', '.join(entries)}}}"
        return self._lines.source(value)

    def _on_compared(self) -> None:
        comparison = self._session.comparison
        if comparison.results and not comparison.busy and not self._session.opener.busy:
            self._names.comparisons.name()

    # Runs

    def _on_ended(self, result: Result) -> None:
        record = self._session.run.record
        if record is None or record.work is None:
            return
        run_lines = RunLines.of(record, result)
        self._names.register_run(record, run_lines)
        if record.end is not None and record.end not in self._names:
            base, name = self._names.mesh(record.start), self._names.new_name(record.end)
            self._lines.put(f"{run_lines.work.title}: {result.outcome.value}", run_lines.smoothed(base, name))

    def _on_failed(self, error: Exception) -> None:
        record = self._session.run.record
        run_lines = self._names.run_lines(record)
        if run_lines is not None and record.end is not None:
            base = self._names.mesh(record.start)
            loop, name = run_lines.until(base, record.result), self._names.new_name(record.end)
            source = f"{loop}\n{name} = {base}.with_points(it.points)"
            self._lines.put(f"{record.title}, until it failed: {error}", source)

    def _on_sweep_recorded(self, sweep: SweepResult) -> None:
        base = self._names.mesh(sweep.before)
        lines = [f"sweep = {self._lines.use(Sweep)}({base}, {source_of(sweep.smoother)})"]
        if sweep.steps:
            lines += [f"for _ in range({sweep.steps}):", "    next(sweep)"]
        lines += ["sweep.finish()"] * sweep.finished
        name = self._names.new_name(sweep.after)
        lines.append(f"{name} = {base}.with_points(sweep.points)")
        self._lines.put(f"{sweep.smoother.title}, node by node", "\n".join(lines))
