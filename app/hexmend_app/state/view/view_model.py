"""Model of the 3D view: what of the open mesh it shows, and how."""

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
    """Data of the view in a session file: appearance, dug hexes in order, and settings of cuts and isolation."""

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
        if self.plane_at < 0 or (isinstance(clip, PlaneClip) and self.plane_at >= len(clip.planes)):
            raise ValueError(f"there is no plane {self.plane_at}")

    def check(self, hexes: int) -> None:
        """Raise `ValueError` if a mesh with this number of hexes does not have those named in the view."""
        isolated = () if self.look.isolation is None else self.look.isolation.hexes
        named = (*isolated, *self.look.dug, *self.dug)
        if named and not 0 <= min(named) <= max(named) < hexes:
            raise ValueError("hexes are isolated or dug away that the mesh does not have")
        if self.look.left is not None and self.look.left.most >= hexes:
            raise ValueError("hexes are left by the cut that the mesh does not have")


class ViewModel(QObject):
    """Model of the 3D view.

    Requests to isolate or dig away hexes that the open mesh does not have are ignored.

    Parameters
    ----------
    document : Document

    Signals
    -------
    changed
    metric_wanted(name)
        Request to colour by a metric in its default range.

    Attributes
    ----------
    look : Look
    handles : bool
        True to show the handles of the cut's plane or box in the view.
    plane_at : int
        Index of the selected plane of a cut, which has the handles.
    snap : bool
        True to align dragged planes with an axis that they are close to.
    rings : int
        Rings of neighbours shown around isolated hexes.
    counted : str or None
        Metric of the histogram; None if it is that of the colours.
    """

    changed = Signal()
    metric_wanted = Signal(str)

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self.look = Look()
        self.handles = True
        self.plane_at = 0
        self.snap = True
        self.rings = 1
        self.counted: str | None = None
        self._dug: list[int] = []  # in the order of digging
        document.mesh_replaced.connect(self.show_all)

    def change(self, **fields: object) -> None:
        """Change fields of the look, and emit `changed` if it differs."""
        if fields.get("clip", self) is not self:
            fields = {"left": None, **fields}  # for the old cut
        look = dataclasses.replace(self.look, **fields)
        if look != self.look:
            self.look = look
            if not look.dug:
                self._dug.clear()
            self.changed.emit()

    def to_data(self) -> ViewData:
        """Return the data for a session file."""
        return ViewData(self.look, tuple(self._dug), self.handles, self.plane_at, self.snap, self.rings, self.counted)

    def restore(self, data: ViewData) -> None:
        """Restore the view of a session file."""
        self.look, self._dug = data.look, list(data.dug)
        self.handles, self.plane_at, self.snap, self.rings = data.handles, data.plane_at, data.snap, data.rings
        self.counted = data.counted
        self.changed.emit()

    def show_as(self, look: Look) -> None:
        """Show the look of a picture; its dug hexes are restored by undo in the order of their numbers."""
        self.restore(dataclasses.replace(self.to_data(), look=look, dug=tuple(sorted(look.dug)), plane_at=0))

    def colour_by(self, metric: str) -> None:
        """Request to colour by a metric or a displacement in its default range."""
        self.metric_wanted.emit(metric)

    def store_remaining_hexes(self, left: CutLeft | None) -> None:
        """Store the hexes kept by a cut by whole hexes, so that they stay the same while nodes move."""
        self.look = dataclasses.replace(self.look, left=left)

    def show_all(self) -> None:
        """Show all hexes: remove the cut, filters, isolation and dug hexes."""
        self.change(clip=None, quality_range=None, peel=0, isolation=None, dug=frozenset())

    def set_clip(self, clip: Clip | None) -> None:
        """Set, move or remove the cut."""
        if isinstance(clip, PlaneClip) and self.plane_at >= len(clip.planes):
            self.plane_at = 0
        self.change(clip=clip)

    def choose_plane(self, at: int) -> None:
        """Select the plane that is moved."""
        if at != self.plane_at:
            self.plane_at = at
            self.changed.emit()

    def drag_plane(self, plane: ClipPlane) -> None:
        """Move the selected plane to where it is dragged, snapping to an axis if `snap` is set."""
        if isinstance(self.look.clip, PlaneClip):
            self.set_clip(self.look.clip.with_plane(self.plane_at, plane.snapped() if self.snap else plane))

    def drag_box(self, low: tuple[float, float, float], high: tuple[float, float, float]) -> None:
        """Move the box of the cut to where it is dragged; corners as (x, y, z)."""
        if isinstance(self.look.clip, BoxClip):
            self.set_clip(dataclasses.replace(self.look.clip, low=low, high=high))

    def set_handles(self, shown: bool) -> None:
        """Show or hide the handles of the cut."""
        if shown != self.handles:
            self.handles = shown
            self.changed.emit()

    def set_snap(self, on: bool) -> None:
        """Set whether dragged planes snap to the axes."""
        self.snap = on

    def isolate(self, hexes: Iterable[int], rings: int | None = None) -> None:
        """Show only some hexes and rings of neighbours around them.

        Parameters
        ----------
        hexes : iterable of int
        rings : int, optional
            Number of rings; by default the last one.
        """
        self.rings = self.rings if rings is None else rings
        hexes = tuple(int(h) for h in hexes if self._document.has_hex(h))
        if hexes:
            # Remove all that would hide them.
            dug = self.look.dug - set(hexes)
            self.change(isolation=Isolation(hexes, self.rings), quality_range=None, peel=0, dug=dug)

    def set_rings(self, rings: int) -> None:
        """Set the number of rings around the isolated hexes."""
        self.rings = rings
        if self.look.isolation is not None:
            self.change(isolation=dataclasses.replace(self.look.isolation, rings=rings))

    def end_isolation(self) -> None:
        """End the isolation."""
        self.change(isolation=None)

    def dig(self, hex: int) -> None:
        """Dig away a hex."""
        if hex not in self.look.dug and self._document.has_hex(hex):
            self._dug.append(int(hex))
            self.change(dug=self.look.dug | {int(hex)})

    def undig_last(self) -> None:
        """Restore the hex that was dug away last."""
        if self._dug:
            self.change(dug=self.look.dug - {self._dug.pop()})

    def undig_all(self) -> None:
        """Restore all hexes that were dug away."""
        self.change(dug=frozenset())
