"""Snapshots of the node positions, to compare the distributions of quality."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QObject, Signal

from hexmend_app.state.mesh.document import Document, MeasuredMesh

#: Maximum number of snapshots: as many as there are colours that all kinds of colour vision distinguish.
MAX_SNAPSHOTS = 6


@dataclass(frozen=True, eq=False)
class Snapshot:
    """Snapshot of the open mesh.

    Only the points are stored, which are usually shared with a recorded change. The quality, which would take as much
    memory again, is measured when it is needed.

    Parameters
    ----------
    slot : int
        Number of its colour, from 0 to `MAX_SNAPSHOTS` - 1, which does not change when other snapshots are removed.
    name : str
    points : (n, 3) float64
    inverted : (m,) bool
    """

    slot: int
    name: str
    points: np.ndarray
    inverted: np.ndarray

    def check(self, hexes: int, nodes: int) -> None:
        """Raise `ValueError` if this is no snapshot of a mesh with these numbers of hexes and nodes."""
        fits = self.points.shape == (nodes, 3) and self.points.dtype == np.float64
        fits = fits and self.inverted.shape == (hexes,) and self.inverted.dtype == bool
        if not (fits and 0 <= self.slot < MAX_SNAPSHOTS):
            raise ValueError(f"the snapshot {self.name!r} is of another mesh")


class Snapshots(QObject):
    """Snapshots of the open mesh, in the order in which they were taken.

    Parameters
    ----------
    document : Document

    Signals
    -------
    changed
    """

    changed = Signal()

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        self.all: tuple[Snapshot, ...] = ()
        document.mesh_replaced.connect(self.clear)

    @property
    def full(self) -> bool:
        """True if no further snapshot can be taken."""
        return len(self.all) == MAX_SNAPSHOTS

    def of(self, state: MeasuredMesh) -> Snapshot | None:
        """Return the snapshot of a state; None if there is none."""
        return next((snapshot for snapshot in self.all if snapshot.points is state.mesh.points), None)

    def add(self, name: str, state: MeasuredMesh) -> None:
        """Add a snapshot, unless there are `MAX_SNAPSHOTS`; a number is appended to a name that is in use."""
        if not self.full:
            slot = min(set(range(MAX_SNAPSHOTS)) - {snapshot.slot for snapshot in self.all})
            names = {snapshot.name for snapshot in self.all}
            candidates = (name, *(f"{name} ({k})" for k in range(2, MAX_SNAPSHOTS + 1)))
            name = next(candidate for candidate in candidates if candidate not in names)
            self._set(*self.all, Snapshot(slot, name, state.mesh.points, state.quality.inverted))

    def remove(self, slot: int) -> None:
        """Remove a snapshot."""
        self._set(*(snapshot for snapshot in self.all if snapshot.slot != slot))

    def rename(self, slot: int, name: str) -> None:
        """Rename a snapshot."""
        self._set(*(dataclasses.replace(one, name=name) if one.slot == slot else one for one in self.all))

    def clear(self) -> None:
        """Remove all snapshots."""
        self._set()

    def to_data(self) -> tuple[Snapshot, ...]:
        """Return the data for a session file."""
        return self.all

    def restore(self, data: tuple[Snapshot, ...]) -> None:
        """Restore the snapshots of a session file."""
        self._set(*data)

    def _set(self, *all: Snapshot) -> None:
        if all != self.all:
            self.all = all
            self.changed.emit()
