"""States shown in views next to the present mesh, side by side or one wiped over the other."""

from __future__ import annotations

from dataclasses import dataclass, replace

from PySide6.QtCore import QObject, Signal

from hexmend_app.state.mesh.document import Document, State
from hexmend_app.state.mesh.snapshots import Snapshots

#: Views beside that of the mesh as it is now.
MOST = 3

#: What the view of the mesh as it is now is called.
NOW = "now"

#: How near the wipe's edge comes to a side of the view, as a share of its width.
_MARGIN = 0.03


@dataclass(frozen=True, eq=False)
class SideView:
    """A state of the open mesh in a view of its own.

    Parameters
    ----------
    name : str
        What the view's caption calls it.
    state : State
    """

    name: str
    state: State


@dataclass(frozen=True)
class Wipe:
    """Two views over one another, with an edge between them.

    Parameters
    ----------
    left, right : int
        Which views are seen on either side: 0 is that of the mesh as it is now, 1 the first beside it.
    at : float
        Where the edge is, as a share of the width.
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
        if count > MOST:
            raise ValueError(f"there are {count} views: expected {MOST} at most")
        if wipe is not None and not (
            0 <= wipe.left <= count and 0 <= wipe.right <= count and wipe.left != wipe.right and 0 <= wipe.at <= 1
        ):
            raise ValueError(f"there is no wipe {wipe} of {count} views")


class SideViews(QObject):
    """The views beside that of the mesh as it is now; the distributions of what they show are kept as long as they do.

    Parameters
    ----------
    document : Document
    kept : KeptMoments

    Signals
    -------
    changed
        Other views, or another arrangement of them.
    wiped
        The wipe's edge is elsewhere.
    """

    changed = Signal()
    wiped = Signal()

    def __init__(self, document: Document, kept: Snapshots, parent: QObject | None = None):
        super().__init__(parent)
        self._kept = kept
        self.all: tuple[SideView, ...] = ()
        self.wipe: Wipe | None = None
        document.mesh_replaced.connect(self.close_all)

    @property
    def full(self) -> bool:
        """True if there is no space for a further view."""
        return len(self.all) == MOST

    def shows(self, state: State) -> bool:
        """Return True if a state is in a view."""
        return any(one.state is state for one in self.all)

    def show(self, name: str, state: State) -> bool:
        """Show a state of the open mesh in a view under a name, unless it is in one; whether there was room for it.

        A view of the same name shows the other state from then on.
        """
        if self.shows(state):
            return True
        shown = SideView(name, state)
        names = [one.name for one in self.all]
        if name in names:
            self._take(*(shown if one.name == name else one for one in self.all))
        elif self.full:
            return False
        else:
            self._take(*self.all, shown)
        return True

    def close_view(self, at: int) -> None:
        """Close a view, 1 being the first beside that of the mesh as it is now."""
        self._take(*(one for k, one in enumerate(self.all, 1) if k != at))

    def close_all(self) -> None:
        """Leave the mesh as it is now alone."""
        self._take()

    def set_wiping(self, on: bool) -> None:
        """Lay two views over one another, or all side by side; one alone stays as it is."""
        if on != (self.wipe is not None) and (self.all or not on):
            self.wipe = Wipe(0, len(self.all)) if on else None
            self.changed.emit()

    def choose_wiped(self, left: int, right: int) -> None:
        """Wipe between two other views; chosen for both sides, one changes places with the other."""
        wipe = self.wipe
        if wipe is None or (left, right) == (wipe.left, wipe.right):
            return
        if left == right:
            left, right = wipe.right, wipe.left
        self.wipe = replace(wipe, left=left, right=right)
        self.changed.emit()

    def move_wipe(self, at: float) -> None:
        """Bring the wipe's edge elsewhere, a share of the width; it stays within the view."""
        at = min(max(at, _MARGIN), 1 - _MARGIN)
        if self.wipe is not None and at != self.wipe.at:
            self.wipe = replace(self.wipe, at=at)
            self.wiped.emit()

    def to_data(self) -> SideViewsData:
        """Return the data for a session file."""
        return SideViewsData(self.all, self.wipe)

    def restore(self, data: SideViewsData) -> None:
        """Show what a session has kept."""
        self._take(*data.shown)
        self.wipe = data.wipe
        self.changed.emit()

    def _take(self, *all: SideView) -> None:
        if all == self.all:
            return
        before, self.all = self.all, all
        for one in before:
            kept = None if self.shows(one.state) else self._kept.of(one.state)
            if kept is not None:
                self._kept.remove(kept.slot)
        for one in all:
            if self._kept.of(one.state) is None:
                self._kept.keep(one.name, one.state)
        if self.wipe is not None and max(self.wipe.left, self.wipe.right) > len(all):
            self.wipe = replace(self.wipe, left=0, right=len(all)) if all else None
        self.changed.emit()
