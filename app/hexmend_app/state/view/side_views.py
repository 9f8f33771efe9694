"""States shown in views next to the current mesh, side by side or with a wipe, and snapshots to compare with."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, replace

import numpy as np
from PySide6.QtCore import QObject, Signal

from hexmend_app.state.mesh.document import Document, MeasuredMesh

#: Maximum number of side views.
MAX_SIDE_VIEWS = 3
#: Name of the main view, of the current mesh.
NOW = "now"
#: Minimum distance of the wipe's edge from the sides of the view, as a share of its width.
_MARGIN = 0.03
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


@dataclass(frozen=True, eq=False)
class SideView:
    """View of a state of the open mesh.

    Parameters
    ----------
    name : str
        Name in the caption of the view.
    state : MeasuredMesh
    """

    name: str
    state: MeasuredMesh


@dataclass(frozen=True)
class Wipe:
    """Two views on top of each other; an edge separates their visible parts.

    Parameters
    ----------
    left, right : int
        Numbers of the views to the left and right of the edge: 0 is the main view, 1 the first side view.
    at : float
        Position of the edge, as a share of the width.
    """

    left: int
    right: int
    at: float = 0.5


@dataclass(frozen=True, eq=False)
class SideViewsData:
    """Data of the side views in a session file."""

    shown: tuple[SideView, ...]
    wipe: Wipe | None

    def __post_init__(self) -> None:
        wipe, count = self.wipe, len(self.shown)
        if count > MAX_SIDE_VIEWS:
            raise ValueError(f"there are {count} views: expected {MAX_SIDE_VIEWS} at most")
        if wipe is not None and not (
            0 <= wipe.left <= count and 0 <= wipe.right <= count and wipe.left != wipe.right and 0 <= wipe.at <= 1
        ):
            raise ValueError(f"the wipe {wipe} does not fit {count} side views")


class SideViews(QObject):
    """The side views; each has a snapshot of its state, to compare the distributions of quality.

    Parameters
    ----------
    document : Document
    snapshots : Snapshots

    Signals
    -------
    changed
        The views or their arrangement have changed.
    wiped
        The wipe's edge has moved.

    Attributes
    ----------
    all : tuple of SideView
    wipe : Wipe or None
        None if the views are side by side.
    """

    changed = Signal()
    wiped = Signal()

    def __init__(self, document: Document, snapshots: Snapshots, parent: QObject | None = None):
        super().__init__(parent)
        self._snapshots = snapshots
        self.all: tuple[SideView, ...] = ()
        self.wipe: Wipe | None = None
        document.mesh_replaced.connect(self.close_all)

    @property
    def full(self) -> bool:
        """True if no further view can be shown."""
        return len(self.all) == MAX_SIDE_VIEWS

    def shows(self, state: MeasuredMesh) -> bool:
        """Return True if a side view shows this state."""
        return any(view.state is state for view in self.all)

    def show(self, name: str, state: MeasuredMesh) -> bool:
        """Show a state of the open mesh in a side view, unless a side view shows it; return False if none is free.

        A side view with this name shows the new state instead of its former one.
        """
        if self.shows(state):
            return True
        new_view = SideView(name, state)
        if name in [view.name for view in self.all]:
            self._set(*(new_view if view.name == name else view for view in self.all))
        elif self.full:
            return False
        else:
            self._set(*self.all, new_view)
        return True

    def close_view(self, number: int) -> None:
        """Close a side view, numbered from 1."""
        self._set(*(view for k, view in enumerate(self.all, 1) if k != number))

    def close_all(self) -> None:
        """Close all side views."""
        self._set()

    def set_wiping(self, on: bool) -> None:
        """Show two views with a wipe, or all side by side; a wipe needs a side view."""
        if on != (self.wipe is not None) and (self.all or not on):
            self.wipe = Wipe(0, len(self.all)) if on else None
            self.changed.emit()

    def choose_wiped(self, left: int, right: int) -> None:
        """Choose the views of the wipe; the same view for both sides swaps the present ones."""
        wipe = self.wipe
        if wipe is None or (left, right) == (wipe.left, wipe.right):
            return
        if left == right:
            left, right = wipe.right, wipe.left
        self.wipe = replace(wipe, left=left, right=right)
        self.changed.emit()

    def move_wipe(self, at: float) -> None:
        """Move the wipe's edge to a position within the view, as a share of the width."""
        at = min(max(at, _MARGIN), 1 - _MARGIN)
        if self.wipe is not None and at != self.wipe.at:
            self.wipe = replace(self.wipe, at=at)
            self.wiped.emit()

    def to_data(self) -> SideViewsData:
        """Return the data for a session file."""
        return SideViewsData(self.all, self.wipe)

    def restore(self, data: SideViewsData) -> None:
        """Restore the side views of a session file."""
        self._set(*data.shown)
        self.wipe = data.wipe
        self.changed.emit()

    def _set(self, *all: SideView) -> None:
        if all == self.all:
            return
        before, self.all = self.all, all
        for view in before:
            snapshot = None if self.shows(view.state) else self._snapshots.of(view.state)
            if snapshot is not None:
                self._snapshots.remove(snapshot.slot)
        for view in all:
            if self._snapshots.of(view.state) is None:
                self._snapshots.add(view.name, view.state)
        if self.wipe is not None and max(self.wipe.left, self.wipe.right) > len(all):
            self.wipe = replace(self.wipe, left=0, right=len(all)) if all else None
        self.changed.emit()
