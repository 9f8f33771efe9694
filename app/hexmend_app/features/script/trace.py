"""Python script of the changes that led to the mesh of a document, derived from its undo list."""

from __future__ import annotations

import re
from pathlib import Path

from hexmend import __version__
from hexmend.doctor import repair
from hexmend.iteration import Outcome
from hexmend.mesh.rules import MotionRules
from hexmend.padding import pad
from hexmend.parameters import from_values
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import METHODS, Smoother
from hexmend_app.features.script.source_code import (
    comment_text,
    import_of,
    keywords_source,
    literal_source,
    multiline_source,
    value_source,
)
from hexmend_app.formats.session import SUFFIX
from hexmend_app.picture import Scene, to_toml
from hexmend_app.state.mesh.document import OWN_PARTS, State
from hexmend_app.state.mesh.run_record import RecordedIteration, RunRecord
from hexmend_app.state.session.session import Session

#: First words of the comment on the view.
VIEW = "# Current view"

#: Source of the mesh in the result of functions that return more than a mesh; it slides on its own boundary.
_MESH_OF = {repair: "[0].keeping_surface()", pad: ".mesh.keeping_surface()"}

#: What two meshes that differ in the positions of their nodes alone have in common.
_COMMON = ("hexes", "surface_points", *OWN_PARTS)


#: Outcomes of which the number of iterations is not repeated by itself.
ENDED_BY_TIME = (Outcome.STOPPED, Outcome.MAX_SECONDS)


class Trace:
    """Script of a document, in which each mesh has a name of its own.

    Parameters
    ----------
    session : Session
    """

    def __init__(self, session: Session):
        self._session, self._document = session, session.document
        self._names: dict[State, str] = {}
        self._sources: dict[str, str] = {}  # by name, in the order of the script
        self._read: set[Path] = set()
        self._imports = {"import hexmend as hx"}
        if self._document.is_open:
            data = self._document.to_data()
            for change in data.changes[: data.at + 1]:
                self._name(change.state, change.title)
            if self._document.previews and not session.run.busy:
                self._name(self._document.now)

    def text(self, scene: Scene | None = None) -> str:
        """Return the whole script, which `python FILE` runs, with the scene of the view at its end."""
        body = [*self._used(), *self._saved()]
        if scene is not None and body:
            body.append(_view_source(next(reversed(self._sources)), scene))
        head = f'"""Changes of a mesh in Hexmend {__version__}. To repeat them, run: python THIS-FILE."""'
        return "\n\n".join([head, "\n".join(sorted(self._imports)), *body]) + "\n"

    def _used(self) -> list[str]:
        """Return the sources without those that read meshes which nothing uses."""
        used: list[str] = []
        for name, source in reversed(self._sources.items()):
            if not used or "hx.read(" not in source or re.search(rf"\b{name}\b", "\n".join(used)):
                used.insert(0, source)
        return used

    def _saved(self) -> list[str]:
        """Return the source that writes the files that were saved."""
        names = {state.mesh: name for state, name in self._names.items()}
        lines = [
            f"hx.write({str(original.path.absolute())!r}, {names[original.mesh]})"
            for original in reversed(self._document.originals)
            if original.mesh in names and original.path not in self._read and original.path.suffix != SUFFIX
        ]
        return ["\n".join(["# Save", *lines])] if lines else []

    def _name(self, state: State, title: str = "") -> str:
        """Return the name of a state's mesh; write the source that makes the mesh first."""
        if state not in self._names:
            makers = (self._known, self._edited, self._moved, self._compared, self._run, self._file)
            *before, value = next(lines for make in makers if (lines := make(state)) is not None)
            moment = self._iteration_of(state)
            comment = comment_text(title or ("mesh" if moment is None else moment.name))
            name = self._names[state] = f"mesh_{len(self._sources)}"
            self._sources[name] = "\n".join([f"# {comment[:1].upper()}{comment[1:]}", *before, f"{name} = {value}"])
        return self._names[state]

    # Lines of source that make a mesh, of which the last is an expression

    def _known(self, state: State) -> list[str] | None:
        """Return the name of the same mesh."""
        points = state.mesh.points
        names = (name for known, name in self._names.items() if known.mesh.points is points and _alike(known, state))
        name = next(names, None)
        return None if name is None else [name]

    def _edited(self, state: State) -> list[str] | None:
        """Return the call of the function that changed a mesh."""
        edit = self._document.edits.get(state)
        if edit is None:
            return None
        name, statement = import_of(edit.function)
        arguments = [self._name(edit.before), *map(literal_source, edit.values)]
        self._imports |= {statement} | {"import numpy as np" for one in arguments if "np.r_[" in one}
        return [f"{name}({', '.join(arguments)}){_MESH_OF.get(edit.function, '')}"]

    def _moved(self, state: State) -> list[str] | None:
        """Return the source that moves the nodes back to where they were in an earlier mesh."""
        points = state.mesh.points
        names = (name for known, name in self._names.items() if known.mesh.points is points)
        name = next(names, None)
        return None if name is None else self._with_points(state, f"{name}.points")

    def _compared(self, state: State) -> list[str] | None:
        """Return the source of a result of the comparison of methods."""
        data, points = self._session.comparison.to_data(), state.mesh.points
        results = (one.row for one in data.results if one.state is not None and one.state.mesh.points is points)
        row = next(results, None)
        if row is None or row.method not in METHODS or data.initial.mesh.points is points:  # which a method may keep
            return None
        method = from_values(METHODS[row.method], row.parameters, owner=row.method)
        until = row.iterations if row.outcome in [outcome.key for outcome in ENDED_BY_TIME] else None
        source = smooth_source(self._name(data.initial), method, data.stop, data.rules, until)
        return self._with_points(state, f"{source}.mesh.points")

    def _run(self, state: State) -> list[str] | None:
        """Return the source of the result or another iteration of a run."""
        moment = self._iteration_of(state)
        if moment is None or moment.record.work is None:
            return None
        record, start = moment.record, self._name(moment.record.start)
        if record.outcome is None or moment.number != record.result:
            lines, points = iteration_source(record, start, moment.number), "it.points"
        else:
            *lines, mesh = result_source(record, start)
            if not record.rules and self._names.get(self._like(state)) == start:
                return [*lines, mesh]
            points = f"{mesh}.points"
        value = self._with_points(state, points)
        return None if value is None else [*lines, *value]

    def _file(self, state: State) -> list[str]:
        """Return the source that reads a mesh; a comment says if no file has the mesh yet."""
        mesh, originals = state.mesh, reversed(self._document.originals)  # the file that has been read is the first
        path = next((original.path for original in originals if original.mesh is mesh), None)
        comment = (
            [] if path is not None else ["# Save the mesh, or restore the file that had it, under this name first."]
        )
        path = path or self._document.path or Path(f"{mesh.name or 'mesh'}.vtu")
        self._read.add(path)
        return [*comment, f"hx.read({str(path.absolute())!r}).keeping_surface()"]

    def _with_points(self, state: State, points: str) -> list[str] | None:
        """Return the source that moves the nodes of the mesh that is like a state's; None without such a mesh."""
        like = self._like(state)
        return None if like is None else [f"{self._names[like]}.with_points({points})"]

    def _like(self, state: State) -> State | None:
        """Return the last state in the script whose mesh differs from a state's in the positions of nodes alone."""
        return next((known for known in reversed(self._names) if _alike(known, state)), None)

    def _iteration_of(self, state: State) -> RecordedIteration | None:
        """Return the iteration that moved the nodes; for the start of a run, the iteration of the run before it."""
        moment = self._session.history.iteration_of(state)
        while moment is not None and not moment.number:
            moment = moment.record.parent
        return moment


def _alike(state: State, other: State) -> bool:
    return all(getattr(state.mesh, part) is getattr(other.mesh, part) for part in _COMMON)


def _view_source(name: str, scene: Scene) -> str:
    """Return the scene of the view as source, with a comment on how to draw it."""
    parts = [part for panel in scene.panels for part in (panel, panel.wipe) if part is not None]
    meshes = " ".join(["MESH"] * max((part.mesh for part in parts), default=1))
    return (
        f"{VIEW}, of {name}. To draw it, save this text as view.toml and run\n"
        f"# hexmend render --scene view.toml {meshes} -o PICTURE.png\n"
        f"scene = {multiline_source(to_toml(scene, whole=False))}"
    )


def smooth_source(
    mesh: str, work: Smoother | Recipe, stop: StoppingCriteria | None, rules: MotionRules, until: int | None = None
) -> str:
    """Return the source that runs a method or a recipe, `until` an iteration at most.

    >>> from hexmend.smoothers import METHODS
    >>> smooth_source("mesh_0", METHODS["laplacian"](), StoppingCriteria(max_iterations=5), MotionRules(fix=("inlet",)))
    "hx.smooth(mesh_0, hx.Laplacian(), hx.StoppingCriteria(max_iterations=5), fix=['inlet'])"
    """
    watch = [] if until is None else [f"watch=lambda it: it.number < {until}"]
    return f"hx.smooth({', '.join([*_arguments(mesh, work, stop, rules), *watch])})"


def result_source(record: RunRecord, start: str) -> list[str]:
    """Return lines of source that repeat a run; the last line is an expression for its final mesh."""
    until = record.newest if record.outcome in ENDED_BY_TIME else None
    if not record.changes:
        return [f"{smooth_source(start, record.work, record.stop, record.rules, until)}.mesh"]
    return [*_loop(record, start, until, "run.close()"), "run.result().mesh"]


def iteration_source(record: RunRecord, start: str, number: int) -> list[str]:
    """Return lines of source after which `it` is an iteration of a run."""
    return _loop(record, start, number, "break")


def _loop(record: RunRecord, start: str, until: int | None, end: str) -> list[str]:
    """Return the source that runs a method step by step and changes it as the user did."""
    arguments = _arguments(start, record.work, record.stop, record.rules)
    changes = [(at, stage) for at, stage in record.changes if until is None or at < until]
    lines = [f"run = hx.iterate({', '.join(arguments)})"]
    lines += [_switch(stage) for at, stage in changes if not at]
    lines.append("for it in run:")
    for at, stage in changes:
        lines += [f"    if it.number == {at}:", f"        {_switch(stage)}"] if at else []
    if until is not None:
        lines += [f"    if it.number == {until}:", f"        {end}"]
    return lines


def _switch(stage: Stage) -> str:
    return f"run.switch_method({value_source(stage.smoother)}, {value_source(stage.stop)})"


def _arguments(mesh: str, work: Smoother | Recipe, stop: StoppingCriteria | None, rules: MotionRules) -> list[str]:
    """Return the sources of the arguments of `smooth` and `iterate`; a recipe has its own limits and rules."""
    arguments = [mesh, value_source(work)]
    if stop is not None and stop != StoppingCriteria():
        arguments.append(value_source(stop))
    return arguments if isinstance(work, Recipe) or not rules else [*arguments, keywords_source(rules)]
