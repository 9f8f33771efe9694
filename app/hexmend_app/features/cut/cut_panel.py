"""Panel that cuts the mesh with planes, a box, a slab, a sphere, or by the depth of hexes."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QWidget

from hexmend_app.features.cut.box_page import BoxPage
from hexmend_app.features.cut.cut_settings import CutPanelSettings
from hexmend_app.features.cut.number_pages import DepthPage, SpherePage
from hexmend_app.features.cut.number_row import NumberRow
from hexmend_app.features.cut.plane_page import PlanePage
from hexmend_app.features.cut.plane_row import PlaneRow
from hexmend_app.picture.cut import PLANE_KINDS, Cut, CutKind, CutStyle, proposed_cuts
from hexmend_app.picture.cut_shapes import Box, Plane
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import labelled, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.form_grid import form_grid
from hexmend_app.widgets.inputs.segmented import Segmented

_MAX_PLANES = 6
_UNIT_BOUNDS = np.array([[0.0] * 3, [1.0] * 3])

#: Kinds of cuts with their texts and help.
_KINDS = (
    (CutKind.PLANES, "Planes", "Cut along one or more planes."),
    (CutKind.BOX, "Box", "Cut along the six sides of a box."),
    (CutKind.SLAB, "Slab", "Cut along two parallel planes."),
    (CutKind.SPHERE, "Sphere", "Show the hexes in a sphere."),
    (CutKind.DEPTH, "Depth", "Show the hexes with a depth below the boundary in a range."),
)


class CutPanel(QWidget):
    """Panel that edits the cut.

    Signals
    -------
    cut_changed(Cut)
        The user changed the cut; without any shape if it is off.
    plane_chosen(int)
        The user selected the plane to edit here and in the view.
    """

    cut_changed = Signal(object)
    plane_chosen = Signal(int)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._bounds: np.ndarray | None = None  # (2, 3): lowest and highest corner
        self._cuts = proposed_cuts(_UNIT_BOUNDS)
        self._selected = 0
        self._switch = QCheckBox(tr("Cut"))
        set_help(self._switch, tr("Cut"), tr("Cut the mesh open (C)."))
        self._kind = Segmented(tr("Cut by"), [(kind.value, tr(text), tr(help)) for kind, text, help in _KINDS])
        self.handles_box = QCheckBox(tr("Handles"))
        self.handles_box.setChecked(True)
        set_help(self.handles_box, tr("Handles"), tr("Show the shape of the cut in the view to drag it."))
        self.plane_row = PlaneRow(_MAX_PLANES)
        self._plane_page = PlanePage()
        self._box_page = BoxPage()
        self._thickness = NumberRow([tr("Thickness")], tr("Distance of the two planes, in mesh units."), low=0.0)
        self._thickness_label = labelled(tr("Thickness"), self._thickness)
        self.sphere_page, self._depth_page = SpherePage(), DepthPage()
        self._hide_label = QLabel(tr("Hide"))
        self._hide_planes = Segmented(
            tr("Hide"),
            [
                ("any", tr("Any plane"), tr("Hide everything beyond at least one plane.")),
                ("all", tr("All planes"), tr("Hide only the region beyond all planes; removes a corner.")),
            ],
        )
        self._hide_inside = Segmented(
            tr("Hidden side"),
            [
                ("any", tr("Outside"), tr("Hide everything outside the shape or range.")),
                ("all", tr("Inside"), tr("Hide everything inside the shape or range.")),
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
        head = fill(QHBoxLayout(), self._switch, None, self.handles_box, spacing=None)
        grid = form_grid(self, tr("Thickness"))
        grid.addLayout(head, 0, 0, 1, 2)
        pages = self._kind, self.plane_row, self._plane_page, self._box_page, self.sphere_page, self._depth_page
        for row, widget in enumerate(pages, start=1):
            grid.addWidget(widget, row, 0, 1, 2)
        hide = fill(QHBoxLayout(), self._hide_planes, self._hide_inside, spacing=None)
        row = len(pages) + 1
        grid.addWidget(self._thickness_label, row, 0)
        grid.addWidget(self._thickness, row, 1)
        grid.addWidget(self._hide_label, row + 1, 0)
        grid.addLayout(hide, row + 1, 1)
        grid.addWidget(self._cut_mode, row + 2, 0, 1, 2)

    def _connect(self) -> None:
        self._switch.clicked.connect(self._emit)
        self._kind.chosen.connect(self._emit)
        self.plane_row.tabs.currentChanged.connect(self._on_selected)
        self.plane_row.add_button.clicked.connect(self._on_add)
        self.plane_row.remove_button.clicked.connect(self._on_remove)
        self._plane_page.changed.connect(self._on_plane)
        self._box_page.changed.connect(lambda low, high: self._change(CutKind.BOX, box=Box(low, high)))
        self._thickness.changed.connect(self._on_thickness)
        self.sphere_page.changed.connect(lambda sphere: self._change(CutKind.SPHERE, sphere=sphere))
        self._depth_page.changed.connect(lambda depth: self._change(CutKind.DEPTH, depth=depth))
        for choice in (self._hide_planes, self._hide_inside):
            choice.chosen.connect(lambda key: self._change(self._chosen, notch=key == "all"))
        self._cut_mode.chosen.connect(lambda key: self._set_style(CutStyle(key)))

    # Called by the feature

    def set_bounds(self, bounds: np.ndarray | None, layers: int = 1) -> None:
        """Set the bounds of the mesh; emits no signal.

        If the cut is off, the proposed shapes are centred in the mesh.

        Parameters
        ----------
        bounds : (2, 3) float64, optional
            Lowest and highest corner; None without a mesh.
        layers : int
            Number of layers of hexes from the boundary inwards.
        """
        self._bounds = bounds
        if bounds is not None:
            self._plane_page.set_bounds(bounds)
            self._box_page.set_bounds(bounds)
            if not self._switch.isChecked():
                self._cuts, self._selected = proposed_cuts(bounds, self._cuts, layers), 0
        self._refresh()

    def set_cut(self, cut: Cut, at: int = 0) -> None:
        """Show a cut; emits no signal.

        Parameters
        ----------
        cut : Cut
            Without any shape if it is off.
        at : int
            Index of the selected plane.
        """
        self._switch.setChecked(cut.active)
        if cut.active:
            self._kind.set_value(cut.kind.value)
            self._cuts[cut.kind] = cut.with_hexes(None)
            if cut.planes:
                self._selected = at
        self._refresh()

    def set_handles(self, shown: bool) -> None:
        """Check or uncheck the handles; emits no signal."""
        self.handles_box.setChecked(shown)

    def settings(self) -> CutPanelSettings:
        """Return the current or proposed cut of each kind."""
        return CutPanelSettings(tuple(self._cuts.values()), self._chosen)

    def restore(self, settings: CutPanelSettings) -> None:
        """Set the proposed cuts; a cut that is on does not change."""
        on, kind = self._switch.isChecked(), self._chosen
        self._cuts = settings.by_kind | ({kind: self._cuts[kind]} if on else {})
        if not on:
            self._kind.set_value(settings.kind.value)
        self._refresh()

    def cut(self) -> Cut:
        """Return the cut, without any shape if it is off."""
        return self.proposal() if self._switch.isChecked() and self._bounds is not None else Cut()

    def proposal(self) -> Cut:
        """Return the cut, or if it is off, the cut that switching on would make."""
        return self._cuts[self._chosen]

    @property
    def _chosen(self) -> CutKind:
        return CutKind(self._kind.value())

    @property
    def _planes(self) -> Cut:
        return self._cuts[CutKind.PLANES]

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
        self._set_planes((*self._planes.planes, plane), len(self._planes.planes))

    def _on_remove(self) -> None:
        remaining = tuple(plane for at, plane in enumerate(self._planes.planes) if at != self._selected)
        self._set_planes(remaining, min(self._selected, len(remaining) - 1))

    def _set_planes(self, planes: tuple[Plane, ...], at: int) -> None:
        self._selected = at
        self._change(CutKind.PLANES, planes=planes)
        self.plane_chosen.emit(at)

    def _on_plane(self, plane: Plane) -> None:
        if self._chosen is CutKind.SLAB:
            self._change(CutKind.SLAB, slab=self.proposal().slab.moved_to(plane))
        else:
            planes = self._planes.planes
            self._change(CutKind.PLANES, planes=(*planes[: self._selected], plane, *planes[self._selected + 1 :]))

    def _on_thickness(self, thickness: tuple[float]) -> None:
        slab = self._cuts[CutKind.SLAB].slab
        self._change(CutKind.SLAB, slab=dataclasses.replace(slab, thickness=thickness[0]))

    def _set_style(self, style: CutStyle) -> None:
        """Set the style of all cuts that can have it."""
        for kind in PLANE_KINDS:
            self._cuts[kind] = dataclasses.replace(self._cuts[kind], style=style)
        self._emit()

    def _change(self, kind: CutKind, **keys: Any) -> None:
        """Change the cut of a kind."""
        self._cuts[kind] = dataclasses.replace(self._cuts[kind], **keys)
        self._emit()

    def _emit(self) -> None:
        self._refresh()
        self.cut_changed.emit(self.cut())

    def _refresh(self) -> None:
        on, kind, cut = self._bounds is not None and self._switch.isChecked(), self._chosen, self.proposal()
        planes = self._planes.planes
        self._switch.setEnabled(self._bounds is not None)
        by_planes, several, slab = kind is CutKind.PLANES, len(planes) > 1, kind is CutKind.SLAB
        visible = {  # little while the cut is off, to save space
            self._kind: True,
            self.handles_box: kind is not CutKind.DEPTH,
            self.plane_row: by_planes,
            self._plane_page: by_planes or slab,
            self._box_page: kind is CutKind.BOX,
            self._thickness_label: slab,
            self._thickness: slab,
            self.sphere_page: kind is CutKind.SPHERE,
            self._depth_page: kind is CutKind.DEPTH,
            self._hide_label: several or not by_planes,
            self._hide_inside: not by_planes,
            self._hide_planes: several and by_planes,
            self._cut_mode: kind in PLANE_KINDS,
        }
        for widget, shown in visible.items():
            widget.setVisible(on and shown)
        self.plane_row.set_planes(len(planes), self._selected)
        self._plane_page.flip.setVisible(by_planes)
        self._plane_page.set_plane(cut.slab.middle if slab else planes[self._selected])
        box, sphere, depth = (self._cuts[kind] for kind in (CutKind.BOX, CutKind.SPHERE, CutKind.DEPTH))
        self._box_page.set_corners(box.box.low, box.box.high)
        self._thickness.set_values((self._cuts[CutKind.SLAB].slab.thickness,))
        self.sphere_page.set_sphere(sphere.sphere)
        self._depth_page.set_depth(depth.depth)
        (self._hide_planes if by_planes else self._hide_inside).set_value("all" if cut.notch else "any")
        self._cut_mode.set_value(cut.style.value)
