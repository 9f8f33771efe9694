"""Pages that edit a cutting sphere and a range of depths below the boundary by numbers."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QPushButton, QWidget

from hexmend_app.features.cut.number_row import NumberRow
from hexmend_app.picture.cut_shapes import Depth, DepthUnit, Sphere
from hexmend_app.theme.style import labelled, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.form_grid import form_grid
from hexmend_app.widgets.inputs.segmented import Segmented

_LAYERS = "Layer 1 contains the hexes with a face on the boundary, layer 2 the hexes that share a face with layer 1."
_EDGES = "Distance of the centre of a hex from the boundary, in mean edge lengths of the mesh."


class SpherePage(QWidget):
    """Page that moves the centre of a sphere and changes its radius.

    Signals
    -------
    changed(Sphere)
        The user changed the sphere.
    """

    changed = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._sphere = Sphere()
        self._centre = NumberRow(
            [tr("Centre {axis}", axis=axis) for axis in "XYZ"], tr("Centre of the sphere, in mesh units.")
        )
        self._radius = NumberRow([tr("Radius")], tr("Radius of the sphere, in mesh units."), low=0.0)
        self.at_hex = QPushButton(tr("Centre on hex"))
        set_help(self.at_hex, tr("Centre on hex"), tr("Move the centre to the selected hex; click a hex to select it."))
        self.at_hex.setEnabled(False)
        grid = form_grid(self, tr("Thickness"))
        for row, (text, widget) in enumerate(((tr("Centre"), self._centre), (tr("Radius"), self._radius))):
            grid.addWidget(labelled(text, widget), row, 0)
            grid.addWidget(widget, row, 1)
        grid.addWidget(self.at_hex, 2, 1)
        self._centre.changed.connect(lambda centre: self._change(Sphere(centre, self._sphere.radius)))
        self._radius.changed.connect(lambda radius: self._change(Sphere(self._sphere.centre, *radius)))

    def set_sphere(self, sphere: Sphere) -> None:
        """Show a sphere; emits no signal."""
        self._sphere = sphere
        self._centre.set_values(sphere.centre)
        self._radius.set_values((sphere.radius,))

    def _change(self, sphere: Sphere) -> None:
        self._sphere = sphere
        self.changed.emit(sphere)


class DepthPage(QWidget):
    """Page that chooses the unit, the least and the greatest depth.

    Signals
    -------
    changed(Depth)
        The user changed the range.
    """

    changed = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._depth = Depth()
        units = ((DepthUnit.LAYERS, "Layers", _LAYERS), (DepthUnit.EDGES, "Edge lengths", _EDGES))
        self._unit = Segmented(tr("Unit of depth"), [(unit.value, tr(text), tr(help)) for unit, text, help in units])
        names = tr("Minimum depth"), tr("Maximum depth")
        self._ends = NumberRow(names, tr("Hexes above and below these depths are hidden."), low=0.0)
        grid = form_grid(self, tr("Thickness"))
        for row, (text, widget) in enumerate(((tr("Depth in"), self._unit), (tr("From, to"), self._ends))):
            grid.addWidget(labelled(text, widget), row, 0)
            grid.addWidget(widget, row, 1)
        self._unit.chosen.connect(lambda unit: self._change(replace(self._depth, unit=DepthUnit(unit))))
        self._ends.changed.connect(self._on_ends)

    def set_depth(self, depth: Depth) -> None:
        """Show a range; emits no signal, and leaves text that is being typed."""
        self._depth = depth
        self._unit.set_value(depth.unit.value)
        if sorted(self._ends.values) != [depth.low, depth.high]:
            self._ends.set_values((depth.low, depth.high))

    def _on_ends(self, ends: tuple[float, float]) -> None:
        """Take the lower number first: the first digits of a greater end may be less than the other."""
        low, high = sorted(ends)
        self._change(replace(self._depth, low=low, high=high))

    def _change(self, depth: Depth) -> None:
        self._depth = depth
        self.changed.emit(depth)
