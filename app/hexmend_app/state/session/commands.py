"""Commands: all changes of the state that users request go through here."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, Signal

from hexmend.mesh.fixing import with_pinned, with_region_free
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.tags import with_tag, with_tag_renamed, without_tag
from hexmend.quality import summarise
from hexmend.run.memory import available, shortage
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import Smoother
from hexmend_app.state.mesh.document import State
from hexmend_app.state.session.user_events import FileExported, MeshEdited, NodesMoved, UndoOrRedo

if TYPE_CHECKING:
    from hexmend_app.state.session.session_parts import SessionParts
    from hexmend_app.state.tasks.mesh_repairer import MeshRepairer
    from hexmend_app.state.tasks.mesh_saver import MeshSaver, SaveTask


class Commands(QObject):
    """Changes of the mesh, the runs and the files.

    Parameters
    ----------
    session : SessionParts
    saver : MeshSaver
    repairer : MeshRepairer

    Signals
    -------
    memory_short(Shortage, callable)
        Memory will probably not suffice for a run, which was not started; call the callable to start it anyway.
    """

    memory_short = Signal(object, object)

    def __init__(self, session: SessionParts, saver: MeshSaver, repairer: MeshRepairer):
        super().__init__(session)
        self._session, self._saver, self._repairer = session, saver, repairer
        self.document, self.smoothing = session.document, session.run

    def open(self, path: str | Path) -> None:
        """Open a mesh; a run under way ends first. What is open stays where the file cannot be read."""
        self.smoothing.end(lambda: self._session.opener.open(path))

    def save_in_background(self, path: str | Path) -> SaveTask:
        """Write the mesh as it is now, or with a session's suffix the session, in a thread.

        `Session.saver` tells how it ends; if it fails, the file that was there stays.
        """
        return self._saver.save(path)

    def export(self, event: FileExported) -> None:
        """Write the file of an event, and emit the event; raises `HexmendError` if it cannot be written."""
        event.perform()
        self._session.user_event.emit(event)

    def run(self, stage: Stage) -> None:
        """Run a method on the present mesh, unless another mesh is being read."""
        self.when_memory_suffices([stage.smoother], lambda: self._start(stage))

    def step(self, stage: Stage, iterations: int) -> None:
        """Make some iterations: the next ones of a paused run, or the first ones of a new run."""
        if self.smoothing.busy:
            self.smoothing.step(iterations)
        else:
            self.when_memory_suffices([stage.smoother], lambda: self._start(stage, iterations))

    def when_memory_suffices(self, works: Sequence[Smoother | Recipe], start: Callable[[], object]) -> None:
        """Call `start` if memory suffices for each of some methods on the present mesh; otherwise emit `memory_short`.

        Nothing happens while no mesh is open, or another one is being read or repaired.
        """
        if not self.document.is_open or self._session.opener.busy or self._repairer.busy:
            return
        free = available()
        short = [one for work in works if (one := shortage(work, self.document.now.mesh, free)) is not None]
        if short:
            self.memory_short.emit(max(short, key=lambda one: one.needed), start)
        else:
            start()

    def _start(self, stage: Stage, iterations: float = math.inf) -> None:
        if self._session.editable:
            self._session.node_sweep.leave()
            self._session.run_setup.begun = stage
            self.smoothing.start(stage.smoother, stage.stop, iterations)

    def run_recipe(self, recipe: Recipe) -> None:
        """Run the methods of a recipe one after another on the present mesh, unless another mesh is being read."""
        self.when_memory_suffices([recipe], lambda: self._start_recipe(recipe))

    def _start_recipe(self, recipe: Recipe) -> None:
        self._session.node_sweep.leave()
        self.smoothing.start(recipe, None)

    def branch(self, stage: Stage) -> None:
        """Run a method on the mesh as it is shown, at any iteration; an active run ends first."""
        self.when_memory_suffices([stage.smoother], lambda: self.smoothing.end(lambda: self._start(stage)))

    def reset(self) -> None:
        """End a run and put the nodes back to where they were when the mesh was opened."""
        self.smoothing.end(self._reset)

    def _reset(self) -> None:
        if not self._session.editable:
            return
        self._session.node_sweep.leave()
        before = self.document.now
        self.document.reset()
        if self.document.now is not before:
            self._session.user_event.emit(NodesMoved("reset", before, self.document.now, self.document.start))

    def take(self, title: str, state: State) -> None:
        """Put the nodes to where they are in another state of the mesh, while the mesh may be changed.

        What is pinned and tagged stays so.
        """
        if self._session.editable:
            self._session.node_sweep.leave()
            before = self.document.now
            mesh = before.mesh.with_points(state.mesh.points)
            self.document.commit(title, State(mesh, state.figures, summarise(mesh, state.figures)))
            self._session.user_event.emit(NodesMoved(title, before, self.document.now, state))

    def replace_mesh(self, title: str, state: State) -> bool:
        """Make another mesh the open one, as one change that undo takes back; return False if it may not be changed."""
        if not self._session.editable:
            return False
        self._session.node_sweep.leave()
        self.document.commit(title, state)
        return True

    def pin(self, nodes: int | np.ndarray, on: bool) -> None:
        """Keep a node or several where they are whatever smooths the mesh, or let them go, while it may be changed."""
        self._amend("pin" if on else "unpin", with_pinned, nodes, on)

    def free_only(self, hexes: Sequence[int], rings: int) -> None:
        """Pin all nodes but those of some hexes and of so many rings around them, while the mesh may be changed."""
        self._amend("free a region", with_region_free, np.asarray(hexes, dtype=np.int64), rings)

    def tag(self, name: str, hexes: Sequence[int], on: bool = True) -> None:
        """Add elements to a named group of the mesh, or take them out, while the mesh may be changed.

        A group of which nothing is left is no more.
        """
        before = self.document.now.mesh.hex_sets.get(name, ())
        after = with_tag(self.document.now.mesh, name, hexes, on).hex_sets.get(name, ())
        if len(before) != len(after):
            self._amend("tag" if on else "untag", with_tag, name, np.asarray(hexes, dtype=np.int64), on)

    def remove_tag(self, name: str) -> None:
        """Let a named group of elements be no more, while the mesh may be changed."""
        self._amend("untag", without_tag, name)

    def rename_tag(self, name: str, other: str) -> None:
        """Call a group of elements otherwise, while the mesh may be changed."""
        self._amend("rename the tag", with_tag_renamed, name, other)

    def _amend(self, title: str, change: Callable[..., Mesh], *values: object) -> None:
        """Change what the mesh carries beside its nodes' places, by a function of the core that the script names."""
        if self._session.editable:
            self._session.node_sweep.leave()
            now = self.document.now
            mesh = change(now.mesh, *values)
            summary = now.summary if mesh.pinned is now.mesh.pinned else summarise(mesh, now.figures)
            self.document.commit(title, State(mesh, now.figures, summary))
            self._session.user_event.emit(MeshEdited(title, now, self.document.now, change, values))

    def repair(self, kinds: Sequence[str] = ()) -> bool:
        """Begin to repair some kinds of problem that the doctor finds, or all; whether the mesh may be changed now.

        `Session.repairer` tells how it ends.
        """
        return self._repairer.start(kinds)

    def undo(self) -> None:
        """Take back the last change, unless the mesh may not be changed."""
        if self._session.editable:
            self._session.node_sweep.leave()
            title = self.document.undo_title
            self.document.undo()
            if title is not None:
                self._session.user_event.emit(UndoOrRedo(title, self.document.now, undone=True))

    def redo(self) -> None:
        """Do again what was taken back, unless the mesh may not be changed."""
        if self._session.editable:
            self._session.node_sweep.leave()
            title = self.document.redo_title
            self.document.redo()
            if title is not None:
                self._session.user_event.emit(UndoOrRedo(title, self.document.now, undone=False))
