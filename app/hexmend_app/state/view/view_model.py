"""Model of the 3D view: what of the open mesh it shows, and how."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Signal

from hexmend.quality import METRICS
from hexmend_app.picture.appearance import Look, Measurement
from hexmend_app.picture.camera import Camera
from hexmend_app.picture.cut import Cut
from hexmend_app.picture.cut_shapes import Box, Plane, Sphere
from hexmend_app.picture.displacement import Displacement
from hexmend_app.picture.page import Page
from hexmend_app.picture.visibility import Isolate, Show, known_metric
from hexmend_app.state.mesh.document import Document
from hexmend_app.state.mesh.hex_groups import hexes_of_group

if TYPE_CHECKING:
    import numpy as np


@dataclass(frozen=True)
class ViewData:
    """Data of the view in a session file: appearance, dug hexes in order, settings of cuts, isolation, measuring."""

    look: Look
    dug: tuple[int, ...]
    handles: bool
    plane_at: int
    snap: bool
    rings: int
    counted: str | None
    measuring: bool

    def __post_init__(self) -> None:
        cut = self.look.cut
        if self.counted is not None:
            known_metric(self.counted, METRICS)
        if not cut.absolute:
            raise ValueError("the cut has positions instead of points")
        if self.plane_at < 0 or (cut.planes and self.plane_at >= len(cut.planes)):
            raise ValueError(f"there is no plane {self.plane_at}")

    def check(self, hexes: int) -> None:
        """Raise `ValueError` if a mesh with this number of hexes does not have those named in the view."""
        if max(self.look.cut.largest_hex, self.look.show.largest_hex, max(self.dug, default=-1)) >= hexes:
            raise ValueError("the view names hexes that the mesh does not have")
        if min(self.dug, default=0) < 0:
            raise ValueError("the view names hexes with negative numbers")


class ViewModel(QObject):
    """Model of the 3D view.

    Requests to isolate or hide hexes that the open mesh does not have are ignored.

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
        True to show the handles of the cut in the view.
    plane_at : int
        Index of the selected plane of a cut by planes, which has the handles.
    snap : bool
        True to align dragged planes with an axis that they are close to.
    rings : int
        Rings of neighbours shown around isolated hexes.
    counted : str or None
        Metric of the histogram; None if it is that of the colours.
    measuring : bool
        True while clicks in the view pick points to measure.
    wanted_camera : Camera or None
        Camera that the 3D view is to apply as soon as it draws the open mesh; None without a request.
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
        self.measuring = False
        self.wanted_camera: Camera | None = None
        self._dug: list[int] = []  # in the order of digging
        document.mesh_replaced.connect(self.show_all)
        document.mesh_replaced.connect(self.end_measuring)

    def change(self, **tables: object) -> None:
        """Change tables of the look, and emit `changed` if it differs.

        Parameters
        ----------
        **tables
            New tables, or dicts of the keys that change, such as `show={"peel": 2}`.

        Raises
        ------
        ParameterError
            If a value is invalid.
        """
        changed: dict[str, Any] = {
            name: replace(getattr(self.look, name), **table) if isinstance(table, dict) else table
            for name, table in tables.items()
        }
        look = replace(self.look, **changed)
        if look != self.look:
            self.look = look
            if not look.show.hidden:
                self._dug.clear()
            self.changed.emit()

    def to_data(self) -> ViewData:
        """Return the data for a session file."""
        cut = self.handles, self.plane_at, self.snap
        return ViewData(self.look, tuple(self._dug), *cut, self.rings, self.counted, self.measuring)

    def restore(self, data: ViewData) -> None:
        """Restore the view of a session file."""
        self.look, self._dug = data.look, list(data.dug)
        self.handles, self.plane_at, self.snap, self.rings = data.handles, data.plane_at, data.snap, data.rings
        self.counted, self.measuring = data.counted, data.measuring
        self.changed.emit()

    def show_as(self, look: Look) -> None:
        """Show the look of a picture except the size of its page; undo restores its hidden hexes by number."""
        look = replace(look, page=Page(shading=look.page.shading))
        hidden = tuple(sorted(look.show.hidden))
        self.restore(replace(self.to_data(), look=look, dug=hidden, plane_at=0))

    def colour_by(self, metric: str) -> None:
        """Request to colour by a metric or a displacement in its default range."""
        self.metric_wanted.emit(metric)

    def request_camera(self, camera: Camera | None) -> None:
        """Request a camera for the 3D view."""
        self.wanted_camera = camera
        self.changed.emit()

    def store_remaining_hexes(self, left: np.ndarray | None) -> None:
        """Store the hexes kept by a cut by whole hexes, (m,) bool, so that they stay the same while nodes move."""
        self.look = replace(self.look, cut=self.look.cut.with_hexes(left))

    def show_all(self) -> None:
        """Show all hexes: remove the cut, filters, isolation and dug hexes."""
        show = self.look.show
        self.change(cut=Cut(), show=Show(shrink=show.shrink, outline=show.outline))

    def set_cut(self, cut: Cut) -> None:
        """Set, move or remove the cut."""
        if cut.planes and self.plane_at >= len(cut.planes):
            self.plane_at = 0
        self.change(cut=cut)

    def choose_plane(self, at: int) -> None:
        """Select the plane that is moved."""
        if at != self.plane_at:
            self.plane_at = at
            self.changed.emit()

    def drag_plane(self, plane: Plane) -> None:
        """Move the selected plane, or the middle of the slab, to where it is dragged; snap to an axis if `snap`."""
        cut, plane = self.look.cut, plane.snapped() if self.snap else plane
        if cut.planes:
            self.set_cut(cut.with_plane(self.plane_at, plane))
        elif cut.slab is not None:
            self.set_cut(replace(cut, slab=cut.slab.moved_to(plane), hexes=""))

    def drag_sphere(self, centre: tuple[float, float, float], radius: float) -> None:
        """Move the sphere of the cut to where it is dragged, or change its radius."""
        if self.look.cut.sphere is not None:
            self.set_cut(replace(self.look.cut, sphere=Sphere(centre, radius), hexes=""))

    def drag_box(self, low: tuple[float, float, float], high: tuple[float, float, float]) -> None:
        """Move the box of the cut to where it is dragged; corners as (x, y, z)."""
        if self.look.cut.box is not None:
            self.set_cut(replace(self.look.cut, box=Box(low, high), hexes=""))

    def start_measuring(self) -> None:
        """Let clicks in the view pick points to measure."""
        if not self.measuring:
            self.measuring = True
            self.changed.emit()

    def measure(self, point: tuple[float, float, float]) -> None:
        """Add a point to the measurement; the one after the third begins a new one."""
        self.change(measurement=self.look.measurement.with_point(point))

    def clear_measurement(self) -> None:
        """Remove the measured points."""
        self.change(measurement=Measurement())

    def end_measuring(self) -> None:
        """Remove the measured points; clicks select hexes again."""
        measuring, self.measuring = self.measuring, False
        self.clear_measurement()
        if measuring:
            self.changed.emit()

    def set_handles(self, shown: bool) -> None:
        """Show or hide the handles of the cut."""
        if shown != self.handles:
            self.handles = shown
            self.changed.emit()

    def set_snap(self, on: bool) -> None:
        """Set whether dragged planes snap to the axes."""
        self.snap = on

    def isolate_group(self, group: str, displacement: Displacement | None = None) -> None:
        """Show only the hexes of a group of the open mesh; see `hexes_of_group` for the parameters."""
        now = self._document.now
        self.isolate(hexes_of_group(group, now.mesh, now.quality, displacement))

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
            show = self.look.show
            self.change(  # without the filters that would hide them
                show=Show(
                    isolate=Isolate(hexes, self.rings),
                    hidden=show.hidden.difference(hexes),
                    shrink=show.shrink,
                    outline=show.outline,
                )
            )

    def set_rings(self, rings: int) -> None:
        """Set the number of rings around the isolated hexes."""
        self.rings = rings
        if self.look.show.isolate is not None:
            self.change(show={"isolate": replace(self.look.show.isolate, rings=rings)})

    def end_isolation(self) -> None:
        """End the isolation."""
        self.change(show={"isolate": None})

    def dig(self, hex: int) -> None:
        """Hide a hex."""
        hidden = self.look.show.hidden
        if hex not in hidden and self._document.has_hex(hex):
            self._dug.append(int(hex))
            self.change(show={"hidden": hidden | {int(hex)}})

    def undig_last(self) -> None:
        """Restore the hex that was dug away last."""
        if self._dug:
            self.change(show={"hidden": self.look.show.hidden - {self._dug.pop()}})
