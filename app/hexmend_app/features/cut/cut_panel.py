"""Panel that cuts the mesh with planes, a box, a slab, a sphere, or by the depth of hexes."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QTabBar, QWidget

from hexmend_app.features.cut.plane_editor import NumberRow, PlaneEditor
from hexmend_app.picture.cut import PLANE_KINDS, Cut, CutKind, CutStyle, proposed_cuts
from hexmend_app.picture.cut_shapes import Box, Depth, DepthUnit, Plane, Sphere
from hexmend_app.theme.style import check_box, icon_button, push_button, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.form import form_layout, row_of
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
_LAYERS = "Layer 1 contains the hexes with a face on the boundary, layer 2 the hexes that share a face with layer 1."
_EDGES = "Distance of the centre of a hex from the boundary, in mean edge lengths of the mesh."
_UNITS = ((DepthUnit.LAYERS, "Layers", _LAYERS), (DepthUnit.EDGES, "Edge lengths", _EDGES))
_HIDE_PLANES = (
    ("any", "Any plane", "Hide everything beyond at least one plane."),
    ("all", "All planes", "Hide only the region beyond all planes; removes a corner."),
)
_HIDE_INSIDE = (
    ("any", "Outside", "Hide everything outside the shape or range."),
    ("all", "Inside", "Hide everything inside the shape or range."),
)
_STYLES = (
    (CutStyle.CRINKLE, "Whole hexes", "Show whole hexes whose centre is on the visible side."),
    (CutStyle.SMOOTH, "Smooth cut", "Cut through hexes and cap the cut surface."),
)


@dataclass(frozen=True)
class CutPanelSettings:
    """The current or proposed cuts, one of each kind, and which of them is selected."""

    cuts: tuple[Cut, ...]
    kind: CutKind

    def __post_init__(self) -> None:
        if [cut.kind for cut in self.cuts] != list(CutKind) or not all(cut.absolute for cut in self.cuts):
            raise ValueError(f"the proposed cuts are not one of each kind: expected {', '.join(CutKind)}")

    @property
    def by_kind(self) -> dict[CutKind, Cut]:
        """The cuts by their kind."""
        return dict(zip(CutKind, self.cuts, strict=True))


class CutPanel(QWidget):
    """Form that edits the cut; it has the rows of the kind of cut that is selected.

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
        self._switch = check_box(tr("Cut"), tr("Cut the mesh open (C)."))
        self.handles_box = check_box(tr("Handles"), tr("Show the shape of the cut in the view to drag it."), on=True)
        self._kind = _segmented(tr("Cut by"), _KINDS)
        self._plane = PlaneEditor(self)
        self._add_plane_row()
        self._add_numbers()
        self._hide_planes = _segmented(tr("Hide"), _HIDE_PLANES)
        self._hide_inside = _segmented(tr("Hidden side"), _HIDE_INSIDE)
        self._style = _segmented(tr("Cut"), _STYLES)
        self._lay_out()
        self._connect()
        self._refresh()

    def _add_plane_row(self) -> None:
        """Add the tabs of the planes, with buttons that add and remove planes."""
        tabs = self._tabs = QTabBar()
        tabs.setDrawBase(False)
        tabs.setExpanding(False)
        tabs.setUsesScrollButtons(False)
        tabs.setElideMode(Qt.TextElideMode.ElideRight)
        tabs.setMinimumWidth(64)  # its hint for one tab is twice as wide
        set_help(tabs, tr("Plane"), tr("Plane that is edited here and in the view."))
        self._add = icon_button("plus", tr("Add plane"), tr("Add a cutting plane."))
        self._remove = icon_button("minus", tr("Remove plane"), tr("Remove this cutting plane."))
        self.snap_box = check_box(
            tr("Snap"), tr("Align a plane with an axis when it is rotated close to the axis."), on=True
        )

    def _add_numbers(self) -> None:
        """Add the numbers of the box, slab, sphere and depth."""
        self._sides = []
        for name in "XYZ":
            ends = tr("Minimum {name} of the box", name=name), tr("Maximum {name} of the box", name=name)
            self._sides.append(NumberRow(ends, tr("Sides of the box normal to the {name} axis.", name=name)))
        self._thickness = NumberRow([tr("Thickness")], tr("Distance of the two planes, in mesh units."), low=0.0)
        axes = [tr("Centre {axis}", axis=axis) for axis in "XYZ"]
        self._centre = NumberRow(axes, tr("Centre of the sphere, in mesh units."))
        self._radius = NumberRow([tr("Radius")], tr("Radius of the sphere, in mesh units."), low=0.0)
        help = tr("Move the centre to the selected hex; click a hex to select it.")
        self.at_hex = push_button(tr("Centre on hex"), help)
        self.at_hex.setEnabled(False)
        self._unit = _segmented(tr("Unit of depth"), _UNITS)
        ends = tr("Minimum depth"), tr("Maximum depth")
        self._depths = NumberRow(ends, tr("Hexes above and below these depths are hidden."), low=0.0)

    def _lay_out(self) -> None:
        """Lay out the rows: a label, the widget, and the kinds of cuts that it belongs to."""
        every, planes, box, slab = tuple(CutKind), (CutKind.PLANES,), (CutKind.BOX,), (CutKind.SLAB,)
        sphere, depth = (CutKind.SPHERE,), (CutKind.DEPTH,)
        plane_row = row_of(self._tabs, self._add, self._remove, None, self.snap_box)
        self._rows: tuple[tuple[str, QWidget, tuple[CutKind, ...]], ...] = (
            ("", self._kind, every),
            (tr("Plane"), plane_row, planes),
            (tr("Axis"), self._plane.axis_row, (*planes, *slab)),
            (tr("Position"), self._plane.position_row, (*planes, *slab)),
            *(zip("XYZ", self._sides, [box] * 3, strict=True)),
            (tr("Thickness"), self._thickness, slab),
            (tr("Centre"), self._centre, sphere),
            (tr("Radius"), self._radius, sphere),
            ("", self.at_hex, sphere),
            (tr("Depth in"), self._unit, depth),
            (tr("From, to"), self._depths, depth),
            (tr("Hide"), self._hide_planes, planes),
            (tr("Hide"), self._hide_inside, (*box, *slab, *sphere, *depth)),
            ("", self._style, tuple(PLANE_KINDS)),
        )
        form = self._form = form_layout(self)
        form.addRow(row_of(self._switch, None, self.handles_box))
        for text, widget, _ in self._rows:
            form.addRow(text, widget) if text else form.addRow(widget)

    def _connect(self) -> None:
        self._switch.clicked.connect(self._emit)
        self._kind.chosen.connect(self._emit)
        self._tabs.currentChanged.connect(self._on_selected)
        self._add.clicked.connect(self._on_add)
        self._remove.clicked.connect(self._on_remove)
        self._plane.changed.connect(self._on_plane)
        for row in self._sides:
            row.changed.connect(self._on_sides)
        self._thickness.changed.connect(self._on_thickness)
        for row in (self._centre, self._radius):
            row.changed.connect(self._on_sphere)
        self._unit.chosen.connect(self._on_depth)
        self._depths.changed.connect(self._on_depth)
        for choice in (self._hide_planes, self._hide_inside):
            choice.chosen.connect(lambda key: self._change(self._chosen, notch=key == "all"))
        self._style.chosen.connect(lambda key: self._set_style(CutStyle(key)))

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
            self._plane.set_bounds(bounds)
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

    def _on_sides(self) -> None:
        low, high = zip(*(sorted(row.values) for row in self._sides), strict=True)
        self._change(CutKind.BOX, box=Box(low, high))

    def _on_thickness(self, thickness: tuple[float]) -> None:
        slab = self._cuts[CutKind.SLAB].slab
        self._change(CutKind.SLAB, slab=dataclasses.replace(slab, thickness=thickness[0]))

    def _on_sphere(self) -> None:
        (x, y, z), (radius,) = self._centre.values, self._radius.values
        self._change(CutKind.SPHERE, sphere=Sphere((x, y, z), radius))

    def _on_depth(self) -> None:
        low, high = sorted(self._depths.values)
        self._change(CutKind.DEPTH, depth=Depth(low, high, DepthUnit(self._unit.value())))

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
        planes, by_planes = self._planes.planes, kind is CutKind.PLANES
        self._switch.setEnabled(self._bounds is not None)
        self.handles_box.setVisible(on and kind is not CutKind.DEPTH)
        for _, widget, kinds in self._rows:  # none while the cut is off, to save space
            self._form.setRowVisible(widget, on and kind in kinds)
        self._form.setRowVisible(self._hide_planes, on and by_planes and len(planes) > 1)
        self._plane.flip.setVisible(by_planes)
        with QSignalBlocker(self._tabs):
            while self._tabs.count() < len(planes):
                self._tabs.addTab(str(self._tabs.count() + 1))
            while self._tabs.count() > len(planes):
                self._tabs.removeTab(self._tabs.count() - 1)
            self._tabs.setCurrentIndex(self._selected)
        self._add.setEnabled(len(planes) < _MAX_PLANES)
        self._remove.setEnabled(len(planes) > 1)
        self._plane.set_plane(cut.slab.middle if kind is CutKind.SLAB else planes[self._selected])
        box, slab = self._cuts[CutKind.BOX].box, self._cuts[CutKind.SLAB].slab
        sphere, depth = self._cuts[CutKind.SPHERE].sphere, self._cuts[CutKind.DEPTH].depth
        for row, low, high in zip(self._sides, box.low, box.high, strict=True):
            row.set_range(low, high)
        self._thickness.set_values((slab.thickness,))
        self._centre.set_values(sphere.centre)
        self._radius.set_values((sphere.radius,))
        self._unit.set_value(depth.unit.value)
        self._depths.set_range(depth.low, depth.high)
        (self._hide_planes if by_planes else self._hide_inside).set_value("all" if cut.notch else "any")
        self._style.set_value(cut.style.value)


def _segmented(name: str, options: Iterable[tuple[str, str, str]]) -> Segmented:
    return Segmented(name, [(str(key), tr(text), tr(help)) for key, text, help in options])
