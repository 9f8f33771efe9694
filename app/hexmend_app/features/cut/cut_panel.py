"""Panel that cuts the mesh with planes or a box."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QWidget

from hexmend_app.features.cut.box_page import BoxPage
from hexmend_app.features.cut.plane_page import PlanePage
from hexmend_app.features.cut.plane_row import PlaneRow
from hexmend_app.picture.cut import Cut, CutStyle
from hexmend_app.picture.cut_planes import Box, Plane
from hexmend_app.theme.style import set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.form_grid import form_grid
from hexmend_app.widgets.inputs.segmented import Segmented

_MAX_PLANES = 6


@dataclass(frozen=True)
class CutPanelSettings:
    """The current or proposed cuts by planes and by a box, and which of the two is selected."""

    planes: Cut
    box: Cut
    boxed: bool

    def __post_init__(self) -> None:
        if not (self.planes.planes and self.planes.absolute and self.box.box is not None and self.box.absolute):
            raise ValueError("the proposed cuts have no planes or no box")


class CutPanel(QWidget):
    """Panel that edits the cut.

    Signals
    -------
    cut_changed(Cut)
        The user changed the cut; without planes and box if it is off.
    plane_chosen(int)
        The user selected the plane to edit here and in the view.
    handles_changed(bool)
        The user showed or hid the plane or the box in the view.
    snap_changed(bool)
        The user switched snapping to the axes, for planes that are rotated in the view.
    """

    cut_changed = Signal(object)
    plane_chosen = Signal(int)
    handles_changed = Signal(bool)
    snap_changed = Signal(bool)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._bounds: np.ndarray | None = None  # (2, 3): lowest and highest corner
        self._planes, self._box = Cut.at((1.0, 0.0, 0.0), (0.0, 0.0, 0.0)), Cut(box=Box())
        self._selected = 0
        self._switch = QCheckBox(tr("Cut"))
        set_help(self._switch, tr("Cut"), tr("Cut the mesh open (C)."))
        self._kind = Segmented(
            tr("Cut by"),
            [
                ("planes", tr("Planes"), tr("Cut along one or more planes.")),
                ("box", tr("Box"), tr("Cut along the six sides of a box.")),
            ],
        )
        self._handles = QCheckBox(tr("Handles"))
        self._handles.setChecked(True)
        set_help(self._handles, tr("Handles"), tr("Show the plane or the box in the view to drag and rotate it."))
        self._plane_row = PlaneRow(_MAX_PLANES)
        self._plane_page = PlanePage()
        self._box_page = BoxPage()
        self._hide_label = QLabel(tr("Hide"))
        self._hide_planes = Segmented(
            tr("Hide"),
            [
                ("any", tr("Any plane"), tr("Hide everything beyond at least one plane.")),
                ("all", tr("All planes"), tr("Hide only the region beyond all planes; removes a corner.")),
            ],
        )
        self._hide_box = Segmented(
            tr("Hidden side of the box"),
            [
                ("any", tr("Outside"), tr("Hide everything outside the box.")),
                ("all", tr("Inside"), tr("Hide everything inside the box.")),
            ],
        )
        self._cut_mode = Segmented(
            tr("Cut"),
            [
                ("crinkle", tr("Whole hexes"), tr("Show whole hexes whose centre is on the visible side.")),
                ("smooth", tr("Smooth cut"), tr("Cut through hexes and cap the cut surface.")),
            ],
        )
        self._lay_out()
        self._connect()
        self._refresh()

    def _lay_out(self) -> None:
        head = QHBoxLayout()
        head.addWidget(self._switch)
        head.addWidget(self._kind)
        head.addStretch()
        head.addWidget(self._handles)
        grid = form_grid(self, tr("Position"))
        grid.addLayout(head, 0, 0, 1, 2)
        for row, widget in enumerate((self._plane_row, self._plane_page, self._box_page), start=1):
            grid.addWidget(widget, row, 0, 1, 2)
        hide = QHBoxLayout()
        hide.addWidget(self._hide_planes)
        hide.addWidget(self._hide_box)
        grid.addWidget(self._hide_label, 4, 0)
        grid.addLayout(hide, 4, 1)
        grid.addWidget(self._cut_mode, 5, 0, 1, 2)

    def _connect(self) -> None:
        self._switch.clicked.connect(self._emit)
        self._kind.chosen.connect(self._emit)
        self._handles.clicked.connect(self.handles_changed)
        self._plane_row.snap_changed.connect(self.snap_changed)
        self._plane_row.chosen.connect(self._on_selected)
        self._plane_row.add_requested.connect(self._on_add)
        self._plane_row.remove_requested.connect(self._on_remove)
        self._plane_page.changed.connect(self._on_plane)
        self._box_page.changed.connect(self._on_box)
        for choice in (self._hide_planes, self._hide_box):
            choice.chosen.connect(lambda key: self._change(notch=key == "all"))
        self._cut_mode.chosen.connect(lambda key: self._change(style=CutStyle(key)))

    # Called by the feature

    def set_bounds(self, bounds: np.ndarray | None) -> None:
        """Set the bounds of the mesh; emits no signal.

        If the cut is off, the proposed plane and box are centred in the mesh.

        Parameters
        ----------
        bounds : (2, 3) float64, optional
            Lowest and highest corner; None without a mesh.
        """
        self._bounds = bounds
        if bounds is not None:
            self._plane_page.set_bounds(bounds)
            self._box_page.set_bounds(bounds)
            if not self._switch.isChecked():
                middle, half = bounds.mean(axis=0), np.ptp(bounds, axis=0) / 4
                self._planes = Cut.at(self._planes.planes[0].normal, tuple(middle.tolist()))
                self._box = Cut(box=Box(tuple((middle - half).tolist()), tuple((middle + half).tolist())))
                self._selected = 0
        self._refresh()

    def set_cut(self, cut: Cut, at: int = 0) -> None:
        """Show a cut; emits no signal.

        Parameters
        ----------
        cut : Cut
            Without planes and box if it is off.
        at : int
            Index of the selected plane.
        """
        self._switch.setChecked(cut.active)
        if cut.active:
            cut = cut.with_hexes(None)
            self._kind.set_value("planes" if cut.box is None else "box")
            if cut.box is not None:
                self._box = cut
            else:
                self._planes, self._selected = cut, at
        self._refresh()

    def set_handles(self, shown: bool) -> None:
        """Check or uncheck the handles; emits no signal."""
        self._handles.setChecked(shown)

    def settings(self) -> CutPanelSettings:
        """Return the current or proposed planes and box."""
        return CutPanelSettings(self._planes, self._box, self._kind.value() == "box")

    def restore(self, settings: CutPanelSettings) -> None:
        """Set the proposed planes and box; a cut that is on does not change."""
        on, boxed = self._switch.isChecked(), self._kind.value() == "box"
        if not on or boxed:
            self._planes = settings.planes
        if not on or not boxed:
            self._box = settings.box
        if not on:
            self._kind.set_value("box" if settings.boxed else "planes")
        self._refresh()

    def cut(self) -> Cut:
        """Return the cut, without planes and box if it is off."""
        return self.proposal() if self._switch.isChecked() and self._bounds is not None else Cut()

    def proposal(self) -> Cut:
        """Return the cut, or if it is off, the cut that switching on would make."""
        return self._box if self._kind.value() == "box" else self._planes

    # Called by the widgets

    def _on_selected(self, at: int) -> None:
        self._selected = at
        self._refresh()
        self.plane_chosen.emit(at)

    def _on_add(self) -> None:
        """Add a plane normal to the axis with the fewest planes."""
        counts = np.sum([np.abs(plane.normal) for plane in self._planes.planes], axis=0)
        normal = np.eye(3)[int(counts.round(6).argmin())]
        plane = Plane(tuple(normal), point=tuple(self._bounds.mean(axis=0)))
        self._planes = dataclasses.replace(self._planes, planes=(*self._planes.planes, plane))
        self._select(len(self._planes.planes) - 1)

    def _on_remove(self) -> None:
        remaining = tuple(plane for at, plane in enumerate(self._planes.planes) if at != self._selected)
        self._planes = dataclasses.replace(self._planes, planes=remaining)
        self._select(min(self._selected, len(remaining) - 1))

    def _select(self, at: int) -> None:
        self._selected = at
        self._emit()
        self.plane_chosen.emit(at)

    def _on_plane(self, plane: Plane) -> None:
        self._planes = self._planes.with_plane(self._selected, plane)
        self._emit()

    def _on_box(self, low: tuple, high: tuple) -> None:
        self._box = dataclasses.replace(self._box, box=Box(low, high))
        self._emit()

    def _change(self, **keys: object) -> None:
        """Change the hidden side of the planes or the box, or the style of both."""
        if "style" in keys or self._kind.value() == "box":
            self._box = dataclasses.replace(self._box, **keys)
        if "style" in keys or self._kind.value() == "planes":
            self._planes = dataclasses.replace(self._planes, **keys)
        self._emit()

    def _emit(self) -> None:
        self._refresh()
        self.cut_changed.emit(self.cut())

    def _refresh(self) -> None:
        on, box = self._bounds is not None and self._switch.isChecked(), self._kind.value() == "box"
        planes, cut = self._planes.planes, self.proposal()
        self._switch.setEnabled(self._bounds is not None)
        several = len(planes) > 1
        visible = {  # little while the cut is off, to save space
            self._kind: on,
            self._handles: on,
            self._plane_row: on and not box,
            self._plane_page: on and not box,
            self._box_page: on and box,
            self._hide_label: on and (box or several),
            self._hide_box: on and box,
            self._hide_planes: on and several and not box,
            self._cut_mode: on,
        }
        for widget, shown in visible.items():
            widget.setVisible(shown)
        self._plane_row.set_planes(len(planes), self._selected)
        self._plane_page.set_plane(planes[self._selected])
        self._box_page.set_corners(self._box.box.low, self._box.box.high)
        (self._hide_box if box else self._hide_planes).set_value("all" if cut.notch else "any")
        self._cut_mode.set_value(cut.style.value)
