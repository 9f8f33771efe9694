"""Dialog that edits the options of a layer of hexes."""

from __future__ import annotations

import math

from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QDoubleSpinBox,
    QFormLayout,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.named_sets import set_names
from hexmend_app.state.tasks.mesh_change import PaddingChoice
from hexmend_app.theme.spacing import apply_spacing, fill
from hexmend_app.theme.style import note, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.combo import ComboBox

#: Largest thickness, and the step of the box, in mean edge lengths.
_MAX_THICKNESS, _STEP = 2.0, 0.05


class PadDialog(QDialog):
    """Dialog that edits the options of a layer.

    Parameters
    ----------
    mesh : Mesh
    locked, inverted : int
        Number of its locked and inverted hexes.
    """

    def __init__(self, mesh: Mesh, locked: int, inverted: int, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle(tr("Pad"))
        self.where, self.rings, self.thickness = ComboBox(), QSpinBox(), QDoubleSpinBox()
        self.where.addItem(tr("Whole boundary"), (None, None))
        if locked:
            self.where.addItem(tr("Around the {count:,} locked hexes", count=locked), (None, "locked"))
        if inverted:
            self.where.addItem(tr("Around the {count:,} inverted hexes", count=inverted), (None, "inverted"))
        for name in set_names(mesh):
            self.where.addItem(tr("Set {name}", name=name), (name, None))
        text = tr("Insert the layer under the whole boundary, under the faces of a set, or around hexes.")
        set_help(self.where, tr("Where"), text)
        self.rings.setRange(0, 20)
        self.rings.setValue(1)
        set_help(self.rings, tr("Rings"), tr("Number of rings of hexes that a layer around hexes encloses."))
        edge = mesh.mean_edge_length
        self.thickness.setDecimals(max(0, 3 - math.floor(math.log10(edge))) if edge > 0 else 3)
        self.thickness.setRange(0.0, _MAX_THICKNESS * edge)
        self.thickness.setSingleStep(_STEP * edge)
        self.thickness.setSpecialValueText(tr("Automatic"))
        text = tr("Thickness of the layer in mesh units. Automatic: best for the quality of the hexes.")
        set_help(self.thickness, tr("Thickness"), text)
        form = apply_spacing(QFormLayout())
        form.addRow(tr("Where"), self.where)
        form.addRow(tr("Rings"), self.rings)
        form.addRow(tr("Thickness"), self.thickness)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        buttons.addButton(tr("Pad"), QDialogButtonBox.ButtonRole.AcceptRole)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        text = tr("Insert a layer of new hexes under the boundary, then run Mend. The boundary does not change.")
        fill(QVBoxLayout(self), note(text), form, buttons)
        self.where.currentIndexChanged.connect(self._enable)
        self._enable()

    def choice(self) -> PaddingChoice:
        """Return the selected options."""
        name, around = self.where.currentData()
        return PaddingChoice(name, around, self.rings.value(), self.thickness.value() or None)

    def _enable(self) -> None:
        """Enable the rings for layers around hexes."""
        self.rings.setEnabled(self.where.currentData()[1] is not None)
