"""Page that edits a range of depths below the boundary."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QLabel, QWidget

from hexmend.parameters import Parameter
from hexmend_app.picture.cut_shapes import Depth, DepthUnit
from hexmend_app.theme.style import labelled, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.form_grid import form_grid
from hexmend_app.widgets.inputs.number_box import NumberBox
from hexmend_app.widgets.inputs.segmented import Segmented

_ENDS = ("low", "high")
_MIN_WIDTH = 60  # of each number in the narrowest panel
_LAYERS = "Layer 1 contains the hexes with a face on the boundary, layer 2 the hexes that share a face with layer 1."
_EDGES = "Distance of the centre of a hex from the boundary, in mean edge lengths of the mesh."


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
        self._unit = Segmented(
            tr("Unit of depth"),
            [
                (DepthUnit.LAYERS.value, tr("Layers"), tr(_LAYERS)),
                (DepthUnit.EDGES.value, tr("Edge lengths"), tr(_EDGES)),
            ],
        )
        self._low, self._high = (NumberBox(Parameter(name, float, 1.0, 0.0, None, None, "", "")) for name in _ENDS)
        set_help(self._low, tr("Minimum depth"), tr("Hexes below this depth are hidden."))
        set_help(self._high, tr("Maximum depth"), tr("Hexes above this depth are hidden."))
        for box in (self._low, self._high):
            box.setMinimumWidth(_MIN_WIDTH)
        grid = form_grid(self, tr("Thickness"))
        grid.addWidget(labelled(tr("Depth in"), self._unit), 0, 0)
        grid.addWidget(self._unit, 0, 1, 1, 3)
        parts = (labelled(tr("From"), self._low), self._low, QLabel(tr("to")), self._high)
        for column, widget in enumerate(parts):
            grid.addWidget(widget, 1, column)
        grid.setColumnStretch(3, 1)
        self._unit.chosen.connect(lambda unit: self._change(DepthUnit(unit)))
        self._low.changed.connect(self._on_end)
        self._high.changed.connect(self._on_end)

    def set_depth(self, depth: Depth) -> None:
        """Show a range; emits no signal, and leaves text that is being typed."""
        self._depth = depth
        self._unit.set_value(depth.unit.value)
        if self._ends() != (depth.low, depth.high):
            self._low.set_value(depth.low)
            self._high.set_value(depth.high)

    def _ends(self) -> tuple[float, float]:
        """Return the typed ends, the lower first: the first digits of a greater end may be less than the other."""
        return tuple(sorted((self._low.value(), self._high.value())))

    def _on_end(self) -> None:
        low, high = self._ends()
        if (low, high) != (self._depth.low, self._depth.high):
            self._depth = Depth(low, high, self._depth.unit)
            self.changed.emit(self._depth)

    def _change(self, unit: DepthUnit) -> None:
        self._depth = Depth(self._depth.low, self._depth.high, unit)
        self.changed.emit(self._depth)
