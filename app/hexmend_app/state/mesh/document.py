"""The open mesh: where it came from, where its nodes are now, and the way back."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from PySide6.QtCore import QObject, Signal

from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, Summary, measure, summarise


@dataclass(frozen=True, eq=False)
class State:
    """A mesh with its figures.

    Parameters
    ----------
    mesh : Mesh
    figures : ElementQuality
    summary : Summary
    """

    mesh: Mesh
    figures: ElementQuality
    summary: Summary

    @classmethod
    def of(cls, mesh: Mesh) -> State:
        """Measure a mesh."""
        figures = measure(mesh.points, mesh.hexes)
        return cls(mesh, figures, summarise(mesh, figures))


@dataclass(frozen=True, eq=False)
class Change:
    """A state that undo can come back to, and what led to it."""

    title: str
    state: State


@dataclass(frozen=True, eq=False)
class DocumentData:
    """Data of a document in a session file.

    Parameters
    ----------
    path : str or None
        Of the file that was opened or saved last.
    changes : tuple of Change
    at : int
        Which of them is recorded as the mesh as it is.
    saved : State or None
        What is on disk.
    now : State
        What is shown.
    """

    path: str | None
    changes: tuple[Change, ...]
    at: int
    saved: State | None
    now: State

    def __post_init__(self) -> None:
        if not 0 <= self.at < len(self.changes):
            raise ValueError(f"there is no change {self.at} among {len(self.changes)}")
        hexes = self.changes[self.at].state.mesh.hexes
        if self.now.mesh.hexes is not hexes:
            raise ValueError("what is shown is another mesh than that of its changes")


class Document(QObject):
    """The open mesh and its changes.

    Signals
    -------
    mesh_replaced
        Another mesh is open (or the first), or the same has other hexes or nodes.
    points_moved
        The same mesh, its nodes elsewhere: an iteration, undo, redo, reset.
    changes_changed
        What undo, redo or saving would do has changed.
    """

    mesh_replaced = Signal()
    points_moved = Signal()
    changes_changed = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.path: Path | None = None
        self.now: State | None = None
        self._changes: list[Change] = []
        self._at = 0
        self._saved: State | None = None

    @property
    def is_open(self) -> bool:
        """True if a mesh is open."""
        return self.now is not None

    @property
    def start(self) -> State:
        """The mesh as it was opened, or as a change left it that gave it other hexes or nodes."""
        hexes = self._changes[self._at].state.mesh.hexes
        at = self._at
        while at > 0 and self._changes[at - 1].state.mesh.hexes is hexes:
            at -= 1
        return self._changes[at].state

    def has_hex(self, hex: int | None) -> bool:
        """Return True if the open mesh has a hex with this number; False for None."""
        return hex is not None and self.is_open and 0 <= hex < self.now.mesh.n_hexes

    def has_node(self, node: int | None) -> bool:
        """Return True if the open mesh has a node with this number; False for None."""
        return node is not None and self.is_open and 0 <= node < self.now.mesh.n_nodes

    @property
    def name(self) -> str:
        """Name of the mesh for titles."""
        return self.path.name if self.path is not None else (self.now.mesh.name if self.now else "")

    @property
    def modified(self) -> bool:
        """True if there are unsaved changes."""
        return self.is_open and self._changes[self._at].state is not self._saved

    def replace(self, state: State, path: Path | None) -> None:
        """Open another mesh; its changes begin anew, and its boundary as it is now is what any run slides on."""
        state = replace(state, mesh=state.mesh.keeping_surface())
        self.path = path
        self.now = state
        self._changes = [Change("open", state)]
        self._at, self._saved = 0, state
        self.mesh_replaced.emit()
        self.changes_changed.emit()

    def preview(self, state: State) -> None:
        """Show nodes on their way; no change is recorded."""
        self.now = state
        self.points_moved.emit()

    @property
    def previews(self) -> bool:
        """True if the state shown is no recorded change: nodes in motion, or an earlier iteration."""
        return self.is_open and self.now is not self._changes[self._at].state

    def commit(self, title: str, state: State, show: bool = True) -> None:
        """Record where the nodes are now, what is pinned and what is tagged, as one change that undo takes back.

        Without `show`, what is previewed stays in view.
        """
        before, after = self._changes[self._at].state.mesh, state.mesh
        if any(getattr(after, part) is not getattr(before, part) for part in ("points", "pinned", "hex_sets", "hexes")):
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
        """Take the last change back."""
        if self._at > 0:
            self._at -= 1
            self._show()

    def redo(self) -> None:
        """Do again what was taken back."""
        if self._at + 1 < len(self._changes):
            self._at += 1
            self._show()

    def reset(self) -> None:
        """Put the nodes back to where they were when the mesh was opened; undo takes that back too.

        What was pinned or tagged since stays so.
        """
        start = self.start
        if not np.array_equal(self.now.mesh.points, start.mesh.points):
            mesh = self.now.mesh.with_points(start.mesh.points)
            self.commit("reset", State(mesh, start.figures, summarise(mesh, start.figures)))

    @property
    def recorded(self) -> State:
        """The mesh as it was changed last, which undo would come back from; a mesh is open."""
        return self._changes[self._at].state

    def saved(self, path: Path, state: State | None = None) -> bool:
        """Remember that a state is on disk, the one that is shown where none is named.

        Returns
        -------
        bool
            Whether its mesh is open still; nothing is remembered of another.
        """
        state = self.now if state is None else state
        is_open = any(change.state.mesh.hexes is state.mesh.hexes for change in self._changes)
        if is_open:
            self.path, self._saved = path, state
            self.changes_changed.emit()
        return is_open

    def to_data(self) -> DocumentData:
        """Return the data for a session file; a mesh is open."""
        path = None if self.path is None else str(self.path)
        return DocumentData(path, tuple(self._changes), self._at, self._saved, self.now)

    def restore(self, data: DocumentData) -> None:
        """Open the mesh of a session file, with its changes."""
        self.now, self._changes, self._at = data.now, list(data.changes), data.at
        self.path, self._saved = None if data.path is None else Path(data.path), data.saved
        self.mesh_replaced.emit()
        self.changes_changed.emit()

    def _show(self) -> None:
        before, self.now = self.now.mesh.hexes, self._changes[self._at].state
        (self.points_moved if self.now.mesh.hexes is before else self.mesh_replaced).emit()
        self.changes_changed.emit()
