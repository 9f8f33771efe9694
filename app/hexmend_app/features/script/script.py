"""The script of a window: a line for every action that changes the mesh or writes a file, as it comes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from weakref import WeakKeyDictionary

import numpy as np
from PySide6.QtCore import QObject, Signal

from hexmend import __version__
from hexmend.io.atomic import replacing
from hexmend.optimise import Outcome, Result
from hexmend.smoothers import METHODS
from hexmend_app.features.script.runs import Told
from hexmend_app.features.script.words import called, lines_of, made
from hexmend_app.state.deeds import Changed, Deed, Drawn, Moved, Saved, WentBack
from hexmend_app.state.document import State
from hexmend_app.state.history import Moment, Record
from hexmend_app.state.scene import to_toml
from hexmend_app.state.session import Session
from hexmend_app.state.session_data import SessionData, numbered
from hexmend_app.state.stepping import Swept

_RENDER_IMPORTS = "import subprocess", "import sys", "import tempfile", "from pathlib import Path"
#: What draws a picture as the window has drawn it.
_RENDER = """
def render(mesh, scene, path):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        hx.write(folder / "mesh.vtu", mesh)
        (folder / "scene.toml").write_text(scene, encoding="utf-8")
        words = ["render", "--scene", folder / "scene.toml", folder / "mesh.vtu", "-o", path]
        subprocess.run([sys.executable, "-m", "hexmend", *words], check=True, stdout=subprocess.DEVNULL)
"""

#: Outcomes of a run that hang on when it was ended, not on what it found.
_BY_CLOCK = (Outcome.STOPPED.key, Outcome.MAX_SECONDS.key)

#: What a line that holds the first needs.
_IMPORTS = {
    "np.r_[": "import numpy as np",
    "repair(": "from hexmend.doctor import repair",
    "with_pinned(": "from hexmend.fixing import with_pinned",
    "with_region_free(": "from hexmend.fixing import with_region_free",
    "read_session(": "from hexmend.io.session import read_session",
    "Sweep(": "from hexmend.node_step import Sweep",
    "tagged(": "from hexmend.tags import tagged",
    "without_tag(": "from hexmend.tags import without_tag",
    "renamed_tag(": "from hexmend.tags import renamed_tag",
}


class Script(QObject):
    """Tells what has been done in the words of the Python library.

    Every mesh has a name of its own, which nothing else gets: what goes on from an earlier one, after undo or from an
    iteration, says so by that name.

    Attributes
    ----------
    entries : list of str
        What was done, each a comment and Python source.

    Signals
    -------
    changed
        There is another entry.
    """

    changed = Signal()

    def __init__(self, session: Session, parent: QObject | None = None):
        super().__init__(parent)
        self._session, self._document, self._history = session, session.document, session.history
        self._stored: WeakKeyDictionary[State, str] = WeakKeyDictionary()  # where a session has them
        self._told: WeakKeyDictionary[Record, Told] = WeakKeyDictionary()
        self.begin_anew()
        self._smoothing = smoothing = session.smoothing
        session.opener.loaded.connect(self._on_session)
        session.opener.ended.connect(self._on_opened)
        session.commands.done.connect(self._on_done)
        session.stepping.recorded.connect(self._on_swept)
        smoothing.ended.connect(self._on_ended)
        smoothing.failed.connect(self._on_failed)

    @property
    def text(self) -> str:
        """All of it, to be run by `python FILE`."""
        body = "\n\n".join(self.entries)
        imports = sorted({line for word, line in _IMPORTS.items() if word in body}, key=lambda one: one.split()[::-1])
        head = [f'"""What was done in the window of Hexmend {__version__}, to be done again: python THIS-FILE."""', ""]
        plain = [one for one in imports if one.startswith("import")]
        if plain:
            head += [*plain, ""]
        head += ["import hexmend as hx", *(one for one in imports if one not in plain)]
        if "\nrender(" in body:
            head = [*head[:2], *_RENDER_IMPORTS, "", *head[2:], "", _RENDER]
        return "\n".join([*head, "", body, ""]) if body else "\n".join([*head, ""])

    def begin_anew(self) -> None:
        """Forget what was done; what comes next goes on from the mesh as it is then."""
        self.entries: list[str] = []
        self._names: WeakKeyDictionary[State, str] = WeakKeyDictionary()
        self._count = 0
        self.changed.emit()

    def write(self, path: str | Path) -> None:
        """Save it as a file; `FileError` where it cannot be written."""
        with replacing(path) as temporary:
            Path(temporary).write_text(self.text, encoding="utf-8", errors="backslashreplace")

    def _on_opened(self, path: Path) -> None:
        state = self._document.now
        if state not in self._names:
            self._add(f"Open {path.name}", state, f"hx.read({_quoted(path)}).keeping_surface()")

    def _on_session(self, data: SessionData, path: Path | None) -> None:
        """Know where a session's file has its states; one that a window has left will not be there again."""
        if path is not None:
            quoted = _quoted(path)
            for state, at in numbered(data).items():
                self._stored[state] = f"read_session({quoted}).meshes[{at}]"
        self.name(self._document.now)

    def _on_done(self, deed: Deed) -> None:
        match deed:
            case Changed(after=after, before=before):
                if after not in self._names:
                    self._add(deed.title, after, called(self.name(before), deed.change, deed.values))
            case Moved(after=after, before=before):
                if after not in self._names:
                    self._add_compared(deed.places)
                    self._add(deed.title, after, f"{self.name(before)}.with_points({self.name(deed.places)}.points)")
            case WentBack():
                self._put(f"{'undo' if deed.undone else 'redo'} {deed.title}: on with {self.name(deed.now)}")
            case Saved(session=True):
                self._put(f"the session was saved as {deed.path}")
            case Drawn(alone=False):
                self._put(f"the picture {deed.path} shows more than one mesh: it carries its scene, for hexmend render")
            case Drawn():
                drawn = f"{self.name(deed.now)}, {lines_of(to_toml(deed.scene))}, {_quoted(deed.path)}"
                self._put("picture", f"render({drawn})")
            case Saved():
                self._put("save", f"hx.write({_quoted(deed.path)}, {self.name(deed.now)})")

    def _add_compared(self, state: State) -> None:
        """Tell what method has made a state, where one has that was compared."""
        comparison = self._session.comparison
        row = next((one.row for one in comparison.results if one.state is state), None)
        if row is not None and state not in self._names:
            ended = row.iterations if row.outcome in _BY_CLOCK else None
            told = Told(METHODS[row.method](**row.parameters), replace(comparison.stop, max_seconds=0.0), stopped=ended)
            base, name = self.name(comparison.initial), self._new_name(state)
            self._put(f"{told.work.title}, as it was compared", told.smoothed(base, name))

    def name(self, state: State) -> str:
        """What the script calls the mesh of a state; where it has no name yet, it is told how it came about."""
        if state in self._names:
            return self._names[state]
        moment = self._history.moment_of(state)
        if moment is not None and state is moment.record.start:
            moment = moment.record.parent
        if state in self._stored:
            self._add("From the session", state, self._stored[state])
        elif moment is not None and (told := self._run_of(moment.record)) is not None:
            self._add_iteration(state, moment, told)
        else:
            path = self._document.path or Path(f"{state.mesh.name or 'mesh'}.vtu")
            known = "as the window had it: save it under this name first" if moment or not path.exists() else "as read"
            self._add(f"The mesh, {known}", state, f"hx.read({_quoted(path)}).keeping_surface()")
        return self._names[state]

    def _run_of(self, record: Record) -> Told | None:
        """What is known of a run that has ended, or goes on; None of a session's."""
        if record in self._told or record.work is None:
            return self._told.get(record)
        return Told(record.work, record.stop, tuple(record.changes))

    def _add_iteration(self, state: State, moment: Moment, told: Told) -> None:
        record, number = moment.record, moment.number
        same = record.start, record.end
        at = next((one for one in same if one is not None and one.mesh.points is state.mesh.points), None)
        base = self.name(self._like(state, record.start))
        if at is not None:
            self._add(moment.name, state, f"{base}.with_points({self.name(at)}.points)")
            return
        start = self.name(record.start)
        loop = told.until(start, number)
        name = self._new_name(state)
        points, note = "it.points", ""
        if self._is_rounded(state, moment):
            points = f'{start}.points + (it.points - {start}.points).astype("f4")'
            note = "# The window keeps ways from the start in single precision.\n"
        self._put(moment.name, f"{loop}\n{note}{name} = {base}.with_points({points})")

    def _is_rounded(self, state: State, moment: Moment) -> bool:
        try:
            return np.array_equal(moment.record.points(moment.number), state.mesh.points)
        except KeyError:  # it was thinned out since: only what comes from there is shown while no run goes on
            return not self._smoothing.busy

    def _like(self, state: State, other: State) -> State:
        """A named state whose mesh carries what that of another does."""
        mine = state.mesh
        for one in reversed(list(self._names)):
            mesh = one.mesh
            if mesh.hexes is mine.hexes and mesh.pinned is mine.pinned and mesh.hex_sets is mine.hex_sets:
                return one
        return other

    def _on_ended(self, result: Result) -> None:
        record = self._smoothing.record
        if record is None or record.work is None:
            return
        told = self._told[record] = Told.of(record.work, record.stop, record.changes, result)
        if record.end is not None and record.end not in self._names:
            base, name = self.name(record.start), self._new_name(record.end)
            self._put(f"{told.work.title}: {result.outcome.value}", told.smoothed(base, name))

    def _on_failed(self, error: Exception) -> None:
        record = self._smoothing.record
        told = self._run_of(record)
        if told is not None and record.end is not None:
            loop, base = told.until(self.name(record.start), record.result), self.name(record.start)
            name = self._new_name(record.end)
            self._put(f"{record.title}, which failed later: {error}", f"{loop}\n{name} = {base}.with_points(it.points)")

    def _on_swept(self, swept: Swept) -> None:
        base = self.name(swept.before)
        lines = [f"sweep = Sweep({base}, {made(swept.smoother)})"]
        if swept.steps:
            lines += [f"for _ in range({swept.steps}):", "    next(sweep)"]
        lines += ["sweep.finish()"] * swept.finished
        name = self._new_name(swept.after)
        lines.append(f"{name} = {base}.with_points(sweep.points)")
        self._put(f"{swept.smoother.title}, node by node", "\n".join(lines))

    def _add(self, title: str, state: State, source: str) -> None:
        self._put(title, f"{self._new_name(state)} = {source}")

    def _new_name(self, state: State) -> str:
        self._names[state] = f"mesh_{self._count}"
        self._count += 1
        return self._names[state]

    def _put(self, title: str, source: str = "") -> None:
        words = " ".join(title.split())
        comment = f"# {words[:1].upper()}{words[1:]}"
        self.entries.append(f"{comment}\n{source}" if source else comment)
        self.changed.emit()


def _quoted(path: Path) -> str:
    return repr(str(path.absolute()))
