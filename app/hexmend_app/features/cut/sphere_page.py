"""Page that edits a cutting sphere."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QPushButton, QWidget

from hexmend_app.features.cut.number_row import NumberRow
from hexmend_app.picture.cut_shapes import Sphere
from hexmend_app.theme.style import labelled, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.form_grid import form_grid


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
        for row, part in enumerate((self._centre, self._radius, self.at_hex)):
            grid.addWidget(part, row, 1)
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
