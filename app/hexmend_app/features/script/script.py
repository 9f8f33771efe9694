"""The script of a window: a line for every action that changes the mesh or writes a file, and what is seen."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Signal

from hexmend.io.storage.atomic import atomic_write
from hexmend.iteration import Result
from hexmend.mesh.mesh import Mesh
from hexmend.node_step import Sweep
from hexmend.report import write_comparison
from hexmend.study.table_row import Row
from hexmend_app.features.script.lines import Lines, call
from hexmend_app.features.script.names import Names, read_from
from hexmend_app.features.script.runs import Told
from hexmend_app.features.script.seen import Seen
from hexmend_app.features.script.words import called, made
from hexmend_app.state.deeds import Changed, Deed, Iterations, Moved, Saved, Tabled, WentBack, Wrote
from hexmend_app.state.document import State
from hexmend_app.state.record import Record
from hexmend_app.state.restoring import Restored
from hexmend_app.state.scene import Scene
from hexmend_app.state.session import Session
from hexmend_app.state.session_data import SessionData
from hexmend_app.state.stepping import Swept


class Script(QObject):
    """Tells what has been done in the words of the Python library.

    Attributes
    ----------
    entries : list of str
        What was done, each a comment and Python source.
    scene : callable
        Gives the scene of what is seen, or None; who has the view sets it.

    Signals
    -------
    changed
        There is another entry.
    """

    changed = Signal()

    def __init__(self, session: Session, parent: QObject | None = None):
        super().__init__(parent)
        self._session, self._document = session, session.document
        self._lines = Lines(self.changed.emit)
        self._names = Names(session, self._lines)
        self.scene: Callable[[], Scene | None] = lambda: None
        session.opener.loaded.connect(self._on_session)
        session.opener.ended.connect(self._on_opened)
        session.opener.restored.connect(self._on_restored)
        session.commands.done.connect(self._on_done)
        session.stepping.recorded.connect(self._on_swept)
        session.comparison.changed.connect(self._on_compared)
        session.kept.changed.connect(self._names.keep)
        session.smoothing.ended.connect(self._on_ended)
        session.smoothing.failed.connect(self._on_failed)

    @property
    def entries(self) -> list[str]:
        """See the class."""
        return self._lines.entries

    @property
    def text(self) -> str:
        """All of it, to be run by `python FILE`, with what is seen now at its end."""
        seen = self._seen
        return self._lines.text(seen.source if seen is not None else "")

    @property
    def _seen(self) -> Seen | None:
        if not self._document.is_open or (scene := self.scene()) is None:
            return None
        now = self._document.now
        moment, known = self._session.history.moment_of(now), self._names.known(now)
        name = self._document.name if moment is None else moment.name
        if (sweep := self._session.stepping.sweep) is not None:
            name = f"{sweep.done} of {sweep.nodes.size} nodes of a sweep"
        return Seen(scene, f"{name}, {known}" if known else name)

    def begin_anew(self) -> None:
        """Forget what was done; what comes next goes on from the mesh as it is then."""
        self._names.clear()
        self._lines.clear()

    def write(self, path: str | Path) -> None:
        """Save it as a file; `FileError` where it cannot be written."""
        with atomic_write(path) as temporary:
            Path(temporary).write_text(self.text, encoding="utf-8", errors="backslashreplace")

    # Meshes

    def _on_opened(self, path: Path) -> None:
        state = self._document.now
        if state not in self._names:
            self._names.read(path, state)
            self._names.add(f"Open {path.name}", state, read_from(path))

    def _on_restored(self, restored: Restored) -> None:
        """Know from where the meshes are that a picture shows beside the first."""
        for one in restored.others:
            if one.state is not None:
                self._names.read(one.path, one.state)

    def _on_session(self, data: SessionData, path: Path | None) -> None:
        """Know where a session's file has its states; one that a window has left will not be there again."""
        if path is not None:
            self._names.restored(data, path)
        self._names.mesh(self._document.now)

    def _on_done(self, deed: Deed) -> None:
        names, put = self._names, self._lines.put
        match deed:
            case Changed(after=after, before=before):
                if after not in names:
                    self._lines.use(deed.change)
                    names.add(deed.title, after, called(names.mesh(before), deed.change, deed.values))
            case Moved(after=after, before=before):
                if after not in names:
                    places, mesh = names.mesh(deed.places), names.mesh(before)
                    names.add(deed.title, after, f"{mesh}.with_points({places}.points)")
            case WentBack():
                put(f"{'undo' if deed.undone else 'redo'} {deed.title}: on with {names.mesh(deed.now)}")
            case Saved(data=SessionData()):
                names.session_saved(deed.path, deed.data)
                put(f"the session was saved as {deed.path}")
            case Saved():
                source = f"hx.write({str(deed.path.absolute())!r}, {names.mesh(deed.now)})"
                self._lines.overwritten(deed.path)
                put("save", source)
                names.written(deed.path, deed.now)
            case Tabled():
                words = [self._told(deed.path), f"{names.comparisons.name()}.record()"]
                if deed.names or deed.title is not None:
                    words += [repr(dict(deed.names or {})), repr(deed.title)]
                put("table", call(self._lines.use(write_comparison), words))
            case Wrote():
                arguments = [self._told(one) for one in deed.values]
                arguments += [f"{name}={self._told(one)}" for name, one in deed.options.items()]
                put(deed.title, call(self._lines.use(deed.function), arguments))

    def _told(self, value: Any) -> str:
        """A value of a deed as source."""
        match value:
            case State():
                return self._names.mesh(value)
            case Mesh():
                return self._names.places(value)
            case Iterations():
                return self._names.run(value.record, value.numbers)
            case Record():
                return self._names.run(value)
            case Row():
                return self._names.comparisons.row(value)
            case list():
                return f"[{', '.join(map(self._told, value))}]"
            case tuple():
                return f"({', '.join(map(self._told, value))}{',' * (len(value) == 1)})"
            case dict():
                return f"{{{', '.join(f'{self._told(key)}: {self._told(one)}' for key, one in value.items())}}}"
        return self._lines.source(value)

    def _on_compared(self) -> None:
        comparison = self._session.comparison
        if comparison.results and not comparison.busy and not self._session.opener.busy:
            self._names.comparisons.name()

    # Runs

    def _on_ended(self, result: Result) -> None:
        record = self._session.smoothing.record
        if record is None or record.work is None:
            return
        told = Told.of(record.work, record.stop, record.changes, result)
        self._names.ended(record, told)
        if record.end is not None and record.end not in self._names:
            base, name = self._names.mesh(record.start), self._names.new(record.end)
            self._lines.put(f"{told.work.title}: {result.outcome.value}", told.smoothed(base, name))

    def _on_failed(self, error: Exception) -> None:
        record = self._session.smoothing.record
        told = self._names.told(record)
        if told is not None and record.end is not None:
            base = self._names.mesh(record.start)
            loop, name = told.until(base, record.result), self._names.new(record.end)
            source = f"{loop}\n{name} = {base}.with_points(it.points)"
            self._lines.put(f"{record.title}, which failed later: {error}", source)

    def _on_swept(self, swept: Swept) -> None:
        base = self._names.mesh(swept.before)
        lines = [f"sweep = {self._lines.use(Sweep)}({base}, {made(swept.smoother)})"]
        if swept.steps:
            lines += [f"for _ in range({swept.steps}):", "    next(sweep)"]
        lines += ["sweep.finish()"] * swept.finished
        name = self._names.new(swept.after)
        lines.append(f"{name} = {base}.with_points(sweep.points)")
        self._lines.put(f"{swept.smoother.title}, node by node", "\n".join(lines))
