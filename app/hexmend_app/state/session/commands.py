"""Commands: every change of the state that the user requests."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from PySide6.QtCore import QObject

from hexmend.boundary.marking import with_curve, without_curves
from hexmend.io.surfaces.read import sliding_on_boundary, sliding_on_file
from hexmend.mesh.fixing import fix, fix_outside, unfix
from hexmend.mesh.mesh import Mesh, TargetSurface
from hexmend.mesh.tags import with_tag, with_tag_renamed, without_tag
from hexmend.quality import summarise
from hexmend.run.memory import Shortage, available, shortage
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import Smoother
from hexmend_app.formats.session import SUFFIX
from hexmend_app.state.mesh.document import Command, Document, MeasuredMesh
from hexmend_app.state.run.run_controller import RunController
from hexmend_app.state.tasks.mesh_change import MeshChanger, PaddingChoice, pad_mesh, repair_mesh
from hexmend_app.state.tasks.mesh_opener import MeshOpener
from hexmend_app.state.tasks.mesh_saver import MeshSaver, SaveTask


class Commands(QObject):
    """Changes of the mesh, the runs and the files.

    Parameters
    ----------
    session : Session
    """

    def __init__(self, session: Any):  # of a type that has these commands
        super().__init__(session)
        self._session = session
        self.document: Document = session.document
        self.smoothing: RunController = session.run
        self._opener: MeshOpener = session.opener
        self._saver: MeshSaver = session.saver
        self._repairer: MeshChanger = session.repairer
        self._padder: MeshChanger = session.padder

    def open(self, path: str | Path) -> None:
        """Open a mesh; an active run ends first. If the file cannot be read, the open mesh stays."""
        self.smoothing.finish_then(lambda: self._opener.open(path))

    def save_in_background(self, path: str | Path, rewrite: bool = False) -> SaveTask:
        """Save the mesh in a thread, or the session if the path has the suffix of sessions.

        In the format of its file, only coordinates are replaced in a copy of that file unless `rewrite`.
        `Session.saver` reports the outcome; if saving fails, an existing file is left unchanged.
        """
        path, session, document = Path(path), self._session, self.document
        session.end_previews()
        if path.suffix.lower() == SUFFIX:
            saving = SaveTask(path, document.now, document.recorded, session.to_data())
        else:
            iteration = session.timeline.shown_iteration
            if document.previews and session.editable:
                command = session.history.command_of(document.now, document.recorded)
                title = "go back" if iteration is None else f"go to {iteration.name}"
                document.commit(title, document.now, command=command)
            saving = SaveTask(path, document.now, document.now, None, rewrite)
        self._saver.save(saving)
        return saving

    def shortage(self, works: Sequence[Smoother | Recipe]) -> Shortage | None:
        """Return the largest shortage of memory for methods on the current mesh; None if memory will suffice."""
        free, mesh = available(), self.document.now.mesh
        shortages = [found for work in works if (found := shortage(work, mesh, free)) is not None]
        return max(shortages, key=lambda shortage: shortage.needed, default=None)

    def run(self, stage: Stage, iterations: float = math.inf) -> None:
        """Run a method on the current mesh, and pause it after some iterations, unless the mesh cannot be edited."""
        if self._begin_edit():
            self._session.run_setup.active_stage = stage
            self.smoothing.start(stage.smoother, stage.stop, iterations, self._session.run_setup.rules)

    def step(self, stage: Stage, iterations: int) -> None:
        """Run some iterations: the next ones of a paused run, or the first ones of a new run."""
        if self.smoothing.busy:
            self.smoothing.step(iterations)
        else:
            self.run(stage, iterations)

    def run_recipe(self, recipe: Recipe) -> None:
        """Run the methods of a recipe one after another on the current mesh, unless it cannot be edited."""
        if self._begin_edit():
            self.smoothing.start(recipe, None)

    def branch(self, stage: Stage) -> None:
        """Run a method on the mesh as shown, at any iteration; an active run ends first."""
        self.smoothing.finish_then(lambda: self.run(stage))

    def reset(self) -> None:
        """End the run and move the nodes back to where they were when the mesh was opened."""
        self.smoothing.finish_then(self._reset)

    def _reset(self) -> None:
        if self._begin_edit():
            self.document.reset()

    def adopt_positions(self, title: str, state: MeasuredMesh) -> None:
        """Move the nodes to their positions in another state, if the mesh is editable; pins and tags stay."""
        if self._begin_edit():
            now, comparison = self.document.now, self._session.comparison
            mesh = now.mesh.with_points(state.mesh.points)
            recipe = comparison.recipe_of(state)
            command = None if recipe is None else Command("smooth", (comparison.initial, now), recipe=recipe)
            self.document.commit(title, MeasuredMesh.of(mesh, state.quality), command=command)

    def replace_mesh(self, title: str, state: MeasuredMesh) -> bool:
        """Replace the open mesh as one change that can be undone; return False if the mesh is not editable."""
        if not self._begin_edit():
            return False
        self.document.commit(title, state)
        return True

    def pin(self, nodes: int | np.ndarray, on: bool) -> None:
        """Pin nodes, so that no method moves them, or unpin them, if the mesh is editable."""
        self._amend("pin" if on else "unpin", fix if on else unfix, nodes)

    def free_only(self, hexes: Sequence[int], rings: int) -> None:
        """Pin all nodes except those of some hexes and of rings of hexes around them, if the mesh is editable."""
        self._amend("free a region", fix_outside, np.asarray(hexes, dtype=np.int64), rings)

    def tag(self, name: str, hexes: Sequence[int] | np.ndarray, on: bool = True) -> None:
        """Add hexes to a tag or remove them from it, if the mesh is editable; an empty tag is deleted."""
        hexes = np.asarray(hexes, dtype=np.int64)
        hexes = hexes[hexes < self.document.now.mesh.n_hexes]  # sets hold no other cells
        before = self.document.now.mesh.hex_sets.get(name, ())
        after = with_tag(self.document.now.mesh, name, hexes, on).hex_sets.get(name, ())
        if len(before) != len(after):
            self._amend("tag" if on else "untag", with_tag, name, hexes, on)

    def remove_tag(self, name: str) -> None:
        """Delete a tag, if the mesh is editable."""
        self._amend("untag", without_tag, name)

    def rename_tag(self, name: str, new_name: str) -> None:
        """Rename a tag, if the mesh is editable."""
        self._amend("rename the tag", with_tag_renamed, name, new_name)

    def slide_on(self, surface: TargetSurface, path: Path) -> None:
        """Let the boundary slide on a surface that was read from a file, if the mesh is editable."""
        if self._begin_edit():
            now = self.document.now
            state = replace(now, mesh=now.mesh.sliding_on(surface, check=False))
            command = Command(sliding_on_file.__name__, (now,), (str(path.absolute()),))
            self.document.commit("set target surface", state, command=command)

    def slide_on_boundary(self) -> None:
        """Let the boundary slide on itself, if the mesh is editable."""
        self._amend("remove target surface", sliding_on_boundary)

    def mark_curve(self, nodes: Sequence[int]) -> None:
        """Mark the edges of a chain of nodes as a curve, if the mesh is editable."""
        self._amend("mark a curve", with_curve, tuple(nodes))

    def unmark_curves(self, nodes: Sequence[int] | None = None) -> None:
        """Remove the marks of the edges of a chain of nodes, or of all, if the mesh is editable."""
        self._amend("unmark a curve", without_curves, *([] if nodes is None else [tuple(nodes)]))

    def _amend(self, title: str, change: Callable[..., Mesh], *values: object) -> None:
        """Change pins or tags of the mesh by a function of the core, which the script of the changes calls."""
        if self._begin_edit():
            now = self.document.now
            mesh = change(now.mesh, *values)
            summary = now.summary if mesh.pinned is now.mesh.pinned else summarise(mesh, now.quality)
            command = Command(change.__name__, (now,), values)
            self.document.commit(title, MeasuredMesh(mesh, now.quality, summary), command=command)

    def repair(self, kinds: Sequence[str] = ()) -> None:
        """Start repairing some kinds of problem, or all, if the mesh is editable; see `Session.repairer`."""
        if self._begin_edit():
            self._repairer.start("repairing", lambda before, _: repair_mesh(before, kinds))

    def pad(self, choice: PaddingChoice) -> None:
        """Start laying a layer of hexes under the boundary, if the mesh is editable; see `Session.padder`."""
        if self._begin_edit():
            self._padder.start("padding", lambda before, task: pad_mesh(before, choice, task))

    def undo(self) -> None:
        """Undo the last change, if the mesh is editable."""
        if self._begin_edit():
            self.document.undo()

    def redo(self) -> None:
        """Redo the change that was undone last, if the mesh is editable."""
        if self._begin_edit():
            self.document.redo()

    def _begin_edit(self) -> bool:
        """End previews and return True if the mesh can be edited; note how a shown iteration of a run is made."""
        if not self._session.editable:
            return False
        self._session.end_previews()
        document, history = self.document, self._session.history
        if document.now not in document.journal:
            command = history.command_of(document.now, document.recorded)
            if command is not None:
                document.journal[document.now] = command
        return True
