"""View of the open mesh: the only source of what the window shows."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES
from hexmend.quality import METRICS
from hexmend_app.picture.appearance import Isolation, Look
from hexmend_app.picture.colour_map import COLOUR_MAPS
from hexmend_app.picture.cut_planes import BoxClip, Clip, ClipPlane, CutLeft, PlaneClip
from hexmend_app.state.mesh.document import Document


@dataclass(frozen=True)
class ViewData:
    """Data of the view in a session file: appearance, hidden hexes in order, and settings of cuts and isolation."""

    look: Look
    dug: tuple[int, ...]
    handles: bool
    plane_at: int
    snap: bool
    rings: int
    counted: str | None

    def __post_init__(self) -> None:
        scale, shown = self.look.scale, self.look.quality_range
        if self.counted is not None and self.counted not in METRICS:
            raise ValueError(f"there is no metric {self.counted!r}")
        if scale.metric not in METRICS and scale.metric not in DISPLACEMENT_QUANTITIES:
            raise ValueError(f"there is no metric {scale.metric!r}")
        if shown is not None and shown.metric not in METRICS:
            raise ValueError(f"there is no metric {shown.metric!r}")
        if scale.map not in COLOUR_MAPS:
            raise ValueError(f"there is no colour map {scale.map!r}")
        clip = self.look.clip
        if not 0 <= self.plane_at < (len(clip.planes) if isinstance(clip, PlaneClip) else 1 + self.plane_at):
            raise ValueError(f"there is no plane {self.plane_at}")

    def check(self, hexes: int) -> None:
        """Raise `ValueError` unless a mesh of so many hexes has those that are shown or hidden one by one."""
        isolated = () if self.look.isolation is None else self.look.isolation.hexes
        named = (*isolated, *self.look.dug, *self.dug)
        if named and not 0 <= min(named) <= max(named) < hexes:
            raise ValueError("hexes are isolated or dug which the mesh has not")
        if self.look.left is not None and self.look.left.most >= hexes:
            raise ValueError("hexes are left by the cut which the mesh has not")


class ViewModel(QObject):
    """The look of the 3D view.

    Hexes that the open mesh does not have are neither isolated nor dug away.

    Parameters
    ----------
    document : Document

    Signals
    -------
    look_changed
    metric_wanted(name)
        The colours are to show another metric, in the range that suits it.
    """

    look_changed = Signal()
    metric_wanted = Signal(str)

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self.look = Look()
        self.handles = True  # of the plane or the box, in the view
        self.plane_at = 0  # which of several planes has them
        self.snap = True
        self.rings = 1
        self.counted: str | None = None  # the metric of the histogram, where it is not that of the colours
        self._dug: list[int] = []  # in the order of digging
        document.mesh_replaced.connect(self.show_all)

    def change(self, **fields: object) -> None:
        """Change fields of the look; says nothing where nothing changes."""
        if fields.get("clip", self) is not self:
            fields = {"left": None, **fields}  # the cut is made anew
        look = dataclasses.replace(self.look, **fields)
        if look != self.look:
            self.look = look
            if not look.dug:
                self._dug.clear()
            self.look_changed.emit()

    def to_data(self) -> ViewData:
        """Return the data for a session file."""
        return ViewData(self.look, tuple(self._dug), self.handles, self.plane_at, self.snap, self.rings, self.counted)

    def restore(self, data: ViewData) -> None:
        """Look as a session has kept it."""
        self.look, self._dug = data.look, list(data.dug)
        self.handles, self.plane_at, self.snap, self.rings = data.handles, data.plane_at, data.snap, data.rings
        self.counted = data.counted
        self.look_changed.emit()

    def show_as(self, look: Look) -> None:
        """Look as a picture has it: what was hidden one by one comes back in the order of numbers."""
        self.restore(dataclasses.replace(self.to_data(), look=look, dug=tuple(sorted(look.dug)), plane_at=0))

    def colour_by(self, metric: str) -> None:
        """Have the colours show another metric, or movement, in the range that suits it."""
        self.metric_wanted.emit(metric)

    def note_cut(self, left: CutLeft | None) -> None:
        """Store which hexes the cut by whole hexes has left, if the same cut of the present mesh would leave others."""
        self.look = dataclasses.replace(self.look, left=left)

    def show_all(self) -> None:
        """Hide nothing: numbers of hexes mean others in another mesh."""
        self.change(clip=None, quality_range=None, peel=0, isolation=None, dug=frozenset())

    def set_clip(self, clip: Clip | None) -> None:
        """Cut, move the cut, or cut no more."""
        if isinstance(clip, PlaneClip) and self.plane_at >= len(clip.planes):
            self.plane_at = 0
        self.change(clip=clip)

    def choose_plane(self, at: int) -> None:
        """Let another of several planes be the one that is moved."""
        if at != self.plane_at:
            self.plane_at = at
            self.look_changed.emit()

    def drag_plane(self, plane: ClipPlane) -> None:
        """Move the plane that is chosen to where the hand has it, set straight where it is to snap."""
        if isinstance(self.look.clip, PlaneClip):
            self.set_clip(self.look.clip.with_plane(self.plane_at, plane.snapped() if self.snap else plane))

    def drag_box(self, low: tuple[float, float, float], high: tuple[float, float, float]) -> None:
        """Move the sides of the box to where the hand has them."""
        if isinstance(self.look.clip, BoxClip):
            self.set_clip(dataclasses.replace(self.look.clip, low=low, high=high))

    def set_handles(self, shown: bool) -> None:
        """Show or hide what the cut is dragged by in the view; the cut stays."""
        if shown != self.handles:
            self.handles = shown
            self.look_changed.emit()

    def set_snap(self, on: bool) -> None:
        """Set planes straight that come near to an axis, or leave them."""
        self.snap = on

    def isolate(self, hexes: Iterable[int], rings: int | None = None) -> None:
        """Show some elements with so many rings of neighbours around them, and nothing else.

        Parameters
        ----------
        hexes : iterable of int
        rings : int, optional
            As many as were last chosen where none are named.
        """
        self.rings = self.rings if rings is None else rings
        hexes = tuple(int(h) for h in hexes if self._document.has_hex(h))
        if hexes:
            # What else would hide them is given up: they are what is to be seen.
            dug = self.look.dug - set(hexes)
            self.change(isolation=Isolation(hexes, self.rings), quality_range=None, peel=0, dug=dug)

    def set_rings(self, rings: int) -> None:
        """Show so many rings of neighbours around what is isolated, now or next."""
        self.rings = rings
        if self.look.isolation is not None:
            self.change(isolation=dataclasses.replace(self.look.isolation, rings=rings))

    def end_isolation(self) -> None:
        """Show again what is around."""
        self.change(isolation=None)

    def dig(self, hex: int) -> None:
        """Hide one element."""
        if hex not in self.look.dug and self._document.has_hex(hex):
            self._dug.append(int(hex))
            self.change(dug=self.look.dug | {int(hex)})

    def undig_last(self) -> None:
        """Show the element again that was hidden last."""
        if self._dug:
            self.change(dug=self.look.dug - {self._dug.pop()})

    def undig_all(self) -> None:
        """Show all elements again that were hidden one by one."""
        self.change(dug=frozenset())
