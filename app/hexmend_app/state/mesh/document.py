"""The document: the open mesh, its file, and its changes with undo and redo."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
from PySide6.QtCore import QObject, Signal

from hexmend.io import Original
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, Summary, measure, summarise
from hexmend.run.recipe import Recipe
from hexmend_app.state.mesh.mesh_place import mesh_place

#: What the user adds to a mesh, and its iterations have too: pins, tags, marked curves, surface to slide on.
OWN_PARTS = ("pinned", "hex_sets", "cells", "target")


@dataclass(frozen=True, eq=False)
class MeasuredMesh:
    """A mesh with its quality.

    Parameters
    ----------
    mesh : Mesh
    quality : ElementQuality
        Quality of each hex.
    summary : Summary
        Statistics of the quality.
    """

    mesh: Mesh
    quality: ElementQuality
    summary: Summary

    @classmethod
    def of(cls, mesh: Mesh, quality: ElementQuality | None = None) -> MeasuredMesh:
        """Measure a mesh, whose quality may be known already."""
        quality = measure(mesh.points, mesh.elements, mesh.mid_nodes) if quality is None else quality
        return cls(mesh, quality, summarise(mesh, quality))


@dataclass(frozen=True, eq=False)
class Command:
    """Call of the library that makes a mesh: an entry of the journal.

    Parameters
    ----------
    name : str
        Name of the function: "read"; "smooth"; "move", which moves the nodes of the first mesh to their positions in
        the second; or one that changes the first mesh, such as "fix".
    meshes : tuple of MeasuredMesh
        Meshes among the arguments. "smooth" runs on the first; the result has all but the positions from the last.
    values : tuple
        Other arguments: strings, numbers, booleans, None, lists of them, or arrays of integers.
    recipe : Recipe or None
        What "smooth" runs.
    """

    name: str
    meshes: tuple[MeasuredMesh, ...] = ()
    values: tuple[Any, ...] = ()
    recipe: Recipe | None = None


@dataclass(frozen=True, eq=False)
class Change:
    """A recorded state, and the title of the change that led to it."""

    title: str
    state: MeasuredMesh


@dataclass(frozen=True, eq=False)
class FileMesh:
    """Mesh in a file that was opened or saved.

    Parameters
    ----------
    path : str
    mesh : Mesh
    """

    path: str
    mesh: Mesh


@dataclass(frozen=True, eq=False)
class DocumentData:
    """Data of a document in a session file.

    Parameters
    ----------
    path : str or None
        File that was opened or saved last.
    changes : tuple of Change
    at : int
        Index of the current change.
    saved : MeasuredMesh or None
        State in the file.
    now : MeasuredMesh
        State that is shown.
    files : tuple of FileMesh
        Files that were opened or saved, the last one at the end.
    journal : tuple of (MeasuredMesh, Command)
        Calls that make the states.
    """

    path: str | None
    changes: tuple[Change, ...]
    at: int
    saved: MeasuredMesh | None
    now: MeasuredMesh
    files: tuple[FileMesh, ...]
    journal: tuple[tuple[MeasuredMesh, Command], ...]

    def __post_init__(self) -> None:
        if not 0 <= self.at < len(self.changes):
            raise ValueError(f"there is no change {self.at} among {len(self.changes)}")
        hexes = self.changes[self.at].state.mesh.elements
        if self.now.mesh.elements is not hexes:
            raise ValueError("the mesh shown is not that of its changes")


class Document(QObject):
    """The open mesh and its changes.

    Signals
    -------
    mesh_replaced
        A mesh was opened, or the hexes or nodes of the mesh have changed.
    points_moved
        The node positions have changed: by an iteration, undo, redo or reset.
    changes_changed
        The list of changes, the current change or the saved state has changed.

    Attributes
    ----------
    path : Path or None
        File of the mesh.
    target : Path or None
        File that was chosen for saving; None as long as none was.
    now : MeasuredMesh or None
        The state that is shown; None if no mesh is open.
    journal : mapping of MeasuredMesh to Command
        Calls that make the states; states of a sweep, of a case and of the console have none.
    """

    mesh_replaced = Signal()
    points_moved = Signal()
    changes_changed = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.path: Path | None = None
        self.target: Path | None = None
        self.now: MeasuredMesh | None = None
        self._changes: list[Change] = []
        self._at = 0
        self._before_and_after: tuple[MeasuredMesh, MeasuredMesh] | None = None
        self._saved: MeasuredMesh | None = None
        self._files: dict[Path, Mesh] = {}
        self.journal: WeakKeyDictionary[MeasuredMesh, Command] = WeakKeyDictionary()

    @property
    def is_open(self) -> bool:
        """True if a mesh is open."""
        return self.now is not None

    @property
    def start(self) -> MeasuredMesh:
        """The state as opened, or after the last change of the hexes or nodes."""
        hexes = self._changes[self._at].state.mesh.elements
        at = self._at
        while at > 0 and self._changes[at - 1].state.mesh.elements is hexes:
            at -= 1
        return self._changes[at].state

    def has_hex(self, hex: int | None) -> bool:
        """Return True if the open mesh has a hex with this number; False for None."""
        return hex is not None and self.is_open and 0 <= hex < self.now.mesh.n_elements

    @property
    def name(self) -> str:
        """Name of the mesh for titles; of an OpenFOAM case, that of the case."""
        return mesh_place(self.path).name if self.path is not None else (self.now.mesh.name if self.now else "")

    @property
    def modified(self) -> bool:
        """True if there are unsaved changes."""
        return self.is_open and self._changes[self._at].state is not self._saved

    def replace(self, state: MeasuredMesh, path: Path | None) -> None:
        """Open a mesh and discard the previous changes; runs slide nodes on its present boundary."""
        state = replace(state, mesh=state.mesh.keeping_surface())
        self.path, self.target = path, None
        self.now = state
        self._changes = [Change("open", state)]
        self._at, self._saved, self._before_and_after = 0, state, None
        self._files = {} if path is None else {path: state.mesh}
        if path is not None:
            self.journal[state] = Command("read", values=(str(path.absolute()),))
        self.mesh_replaced.emit()
        self.changes_changed.emit()

    def preview(self, state: MeasuredMesh) -> None:
        """Show a state without recording a change."""
        self.now = state
        self.points_moved.emit()

    def show_before(self, before: MeasuredMesh) -> None:
        """Show an earlier state until `end_before`, which every change of the mesh and every save call first."""
        self._before_and_after = before, self.now
        self.preview(before)

    @property
    def shows_before(self) -> bool:
        """True while the earlier state of `show_before` is shown."""
        return self._before_and_after is not None and self._before_and_after[0] is self.now

    def end_before(self) -> None:
        """Show again what was shown before `show_before`, unless something else is shown meanwhile."""
        if self.shows_before:
            self.preview(self._before_and_after[1])
        self._before_and_after = None

    @property
    def previews(self) -> bool:
        """True if the state shown is not the current change: an iteration of a run or of the history."""
        return self.is_open and self.now is not self._changes[self._at].state

    def in_effect(self, state: MeasuredMesh) -> bool:
        """Return True if a recorded state has neither been undone, nor the nodes been moved back from it by reset."""
        states = [change.state for change in self._changes[: self._at + 1]]
        if state not in states:  # states are equal to themselves alone
            return False
        points = states[-1].mesh.points
        return not any(earlier.mesh.points is points for earlier in states[: states.index(state)])

    def commit(self, title: str, state: MeasuredMesh, show: bool = True, command: Command | None = None) -> None:
        """Record a state as a change, unless it has the positions, hexes and `OWN_PARTS` of the current change.

        Parameters
        ----------
        title : str
            Title of the change in Undo and Redo.
        state : MeasuredMesh
        show : bool
            False to leave the state shown as it is.
        command : Command, optional
            Call that makes the state.
        """
        if command is not None:
            self.journal[state] = command
        before, after = self._changes[self._at].state.mesh, state.mesh
        if any(getattr(after, part) is not getattr(before, part) for part in ("points", "hexes", *OWN_PARTS)):
            del self._changes[self._at + 1 :]
            self._changes.append(Change(title, state))
            self._at += 1
        if show:
            self._show()
        else:
            self.changes_changed.emit()

    @property
    def undo_title(self) -> str | None:
        """Title of the change that undo reverts; None if there is none."""
        return self._changes[self._at].title if self._at > 0 else None

    @property
    def redo_title(self) -> str | None:
        """Title of the change that redo repeats; None if there is none."""
        return self._changes[self._at + 1].title if self._at + 1 < len(self._changes) else None

    def undo(self) -> None:
        """Undo the last change."""
        if self._at > 0:
            self._at -= 1
            self._show()

    def redo(self) -> None:
        """Redo the change that was undone last."""
        if self._at + 1 < len(self._changes):
            self._at += 1
            self._show()

    def reset(self) -> None:
        """Move the nodes back to their positions as opened, as one change; pins and tags stay."""
        start = self.start
        if not np.array_equal(self.now.mesh.points, start.mesh.points):
            mesh = self.now.mesh.with_points(start.mesh.points)
            if mesh.surface_points is not start.mesh.surface_points:  # at a time of a case, whose boundary had moved
                mesh = mesh.moving_from(start.mesh.surface_points)
            state = MeasuredMesh.of(mesh, start.quality)
            self.commit("reset", state, command=Command("move", (self.now, start)))

    @property
    def originals(self) -> tuple[Original, ...]:
        """Files that were opened or saved, the last one first, with the mesh in each."""
        return tuple(Original(path, mesh) for path, mesh in reversed(self._files.items()))

    @property
    def states(self) -> list[MeasuredMesh]:
        """The states of all changes, in their order."""
        return [change.state for change in self._changes]

    @property
    def recorded(self) -> MeasuredMesh:
        """The state of the current change; a mesh is open."""
        return self._changes[self._at].state

    @property
    def previous(self) -> MeasuredMesh | None:
        """The state before the current change; None if there is none, or it has other hexes."""
        before = self._changes[self._at - 1].state if self._at > 0 else None
        return before if before is not None and before.mesh.elements is self.recorded.mesh.elements else None

    def mark_saved(self, path: Path, state: MeasuredMesh | None = None) -> bool:
        """Mark a state as saved, by default the one shown, unless its mesh is no longer open.

        Returns
        -------
        bool
            True if its mesh is still open.
        """
        state = self.now if state is None else state
        is_open = any(change.state.mesh.elements is state.mesh.elements for change in self._changes)
        if is_open:
            self.path, self.target, self._saved = path, path, state
            self._files.pop(path, None)
            self._files[path] = state.mesh
            self.changes_changed.emit()
        return is_open

    def to_data(self) -> DocumentData:
        """Return the data for a session file; a mesh is open."""
        path = None if self.path is None else str(self.path)
        files = tuple(FileMesh(str(path), mesh) for path, mesh in self._files.items())
        needed = [self.now, *(change.state for change in self._changes)]
        journal: dict[MeasuredMesh, Command] = {}
        while needed:
            state = needed.pop()
            if state in self.journal and state not in journal:
                journal[state] = self.journal[state]
                needed += journal[state].meshes
        return DocumentData(path, tuple(self._changes), self._at, self._saved, self.now, files, tuple(journal.items()))

    def restore(self, data: DocumentData) -> None:
        """Open the mesh of a session file, with its changes."""
        self.now, self._changes, self._at = data.now, list(data.changes), data.at
        self.path, self.target, self._saved = None if data.path is None else Path(data.path), None, data.saved
        self._files = {Path(one.path): one.mesh for one in data.files}
        self.journal.update(data.journal)
        self.mesh_replaced.emit()
        self.changes_changed.emit()

    def _show(self) -> None:
        before, self.now = self.now.mesh.elements, self._changes[self._at].state
        (self.points_moved if self.now.mesh.elements is before else self.mesh_replaced).emit()
        self.changes_changed.emit()
