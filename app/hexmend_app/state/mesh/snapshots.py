"""Places of the open mesh's nodes that the user keeps, to compare how quality was distributed then."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QObject, Signal

from hexmend_app.state.mesh.document import Document, State

#: How many can be kept: as many as there are colours that all kinds of colour vision tell apart.
MOST = 6


@dataclass(frozen=True, eq=False)
class Snapshot:
    """A moment of the open mesh.

    Only the points are kept, which a change that undo remembers shares: the figures of a million hexes would take as
    much again, and are measured anew when another metric is looked at.

    Parameters
    ----------
    slot : int
        From 0 to `MOST` - 1; it keeps its colour while others come and go.
    name : str
    points : (n, 3) float64
    inverted : (m,) bool
    """

    slot: int
    name: str
    points: np.ndarray
    inverted: np.ndarray

    def check(self, hexes: int, nodes: int) -> None:
        """Raise `ValueError` unless it is a moment of a mesh of so many hexes and nodes."""
        fits = self.points.shape == (nodes, 3) and self.points.dtype == np.float64
        if not fits or self.inverted.shape != (hexes,) or self.inverted.dtype != bool or not 0 <= self.slot < MOST:
            raise ValueError(f"what is kept as {self.name!r} is of another mesh")


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
        return len(self.all) == MOST

    def of(self, state: State) -> Snapshot | None:
        """Find the snapshot of a state; None if there is none."""
        return next((one for one in self.all if one.points is state.mesh.points), None)

    def keep(self, name: str, state: State) -> None:
        """Keep a moment, unless there are as many as can be; a name that one has already gets a number."""
        if not self.full:
            slot = min(set(range(MOST)) - {one.slot for one in self.all})
            names = {one.name for one in self.all}
            name = next(free for k in range(1, MOST + 1) if (free := f"{name} ({k})" if k > 1 else name) not in names)
            self._take(*self.all, Snapshot(slot, name, state.mesh.points, state.figures.inverted))

    def remove(self, slot: int) -> None:
        """Keep one no longer."""
        self._take(*(one for one in self.all if one.slot != slot))

    def rename(self, slot: int, name: str) -> None:
        """Call one otherwise."""
        self._take(*(dataclasses.replace(one, name=name) if one.slot == slot else one for one in self.all))

    def clear(self) -> None:
        """Keep none: another mesh is open."""
        self._take()

    def to_data(self) -> tuple[Snapshot, ...]:
        """Return the data for a session file."""
        return self.all

    def restore(self, data: tuple[Snapshot, ...]) -> None:
        """Restore the snapshots of a session file."""
        self._take(*data)

    def _take(self, *all: Snapshot) -> None:
        if all != self.all:
            self.all = all
            self.changed.emit()
