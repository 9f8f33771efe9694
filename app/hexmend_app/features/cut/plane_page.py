"""Page that edits a cutting plane."""

from __future__ import annotations

import dataclasses

import numpy as np
from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QLabel, QPushButton, QSlider, QWidget

from hexmend_app.picture.cut_shapes import Plane
from hexmend_app.theme.style import icon, labelled, set_help, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.form_grid import form_grid
from hexmend_app.widgets.inputs.segmented import Segmented
from hexmend_app.widgets.wording import position

_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
_TICKS = 1000


class PlanePage(QWidget):
    """Page that aligns a plane with an axis, moves it and flips it.

    The slider covers the mesh's bounds along the plane's normal, in the same direction if the plane is flipped.

    Signals
    -------
    changed(Plane)
        The user changed the plane.
    """

    changed = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._bounds = np.array([[0.0] * 3, [1.0] * 3])  # lowest and highest corner
        self._plane = Plane(point=(0.0, 0.0, 0.0))
        self._axis = Segmented(
            tr("Axis"),
            [(key, key.upper(), tr("A plane normal to the {axis} axis.", axis=key.upper())) for key in _AXES]
            + [
                (
                    "free",
                    tr("Free"),
                    tr("A plane that was rotated in the view; select X, Y or Z to align it with an axis."),
                )
            ],
        )
        self.flip = QPushButton(icon("swap-horizontal"), "")
        self.flip.setFixedWidth(34)
        set_help(self.flip, tr("Flip"), tr("Hide the opposite side of the plane."))
        self._slider = QSlider(Qt.Orientation.Horizontal)
        self._slider.setRange(0, _TICKS)
        self._slider.setPageStep(_TICKS // 20)
        set_help(
            self._slider,
            tr("Position"),
            tr("Position of the plane; arrow keys move it by 1/1000 of the mesh's extent."),
        )
        self._value = QLabel()
        self._value.setFont(tabular(self._value.font()))
        self._value.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self._value.setMinimumWidth(self._value.fontMetrics().horizontalAdvance("-0.000"))
        set_help(self._value, tr("Position in mesh units"), tr("Position along the plane's normal, in mesh units."))
        grid = form_grid(self, tr("Thickness"))
        for row, (text, widget, companion) in enumerate(
            ((tr("Axis"), self._axis, self.flip), (tr("Position"), self._slider, self._value))
        ):
            for column, cell in enumerate((labelled(text, widget), widget, companion)):
                grid.addWidget(cell, row, column)

        self._axis.chosen.connect(self._on_axis)
        self._slider.valueChanged.connect(self._on_slider)
        self.flip.clicked.connect(lambda: self._change(self._plane.flipped()))
        self._refresh()

    def set_bounds(self, bounds: np.ndarray) -> None:
        """Set the lowest and highest corner of the mesh, (2, 3); emits no signal."""
        self._bounds = bounds
        self._refresh()

    def set_plane(self, plane: Plane) -> None:
        """Show a plane; emits no signal."""
        self._plane = plane
        self._refresh()

    def _direction(self) -> np.ndarray:
        """Return the slider's axis, (3,): the unit normal with its largest component positive."""
        normal = np.array(self._plane.normal)
        return normal if normal[np.argmax(np.abs(normal).round(9))] > 0 else -normal

    def _span(self) -> tuple[float, float]:
        """Return the lowest and highest position of the mesh's bounds along the slider's axis."""
        direction = self._direction()
        ends = self._bounds * direction
        return float(ends.min(axis=0).sum()), float(ends.max(axis=0).sum())

    def _on_axis(self, key: str) -> None:
        if key != "free":  # free is a state, not a command
            self._change(Plane(_AXES[key], point=tuple(self._bounds.mean(axis=0))))

    def _on_slider(self, tick: int) -> None:
        low, high = self._span()
        direction, centre = self._direction(), self._bounds.mean(axis=0)
        coordinate = low + (high - low) * tick / _TICKS
        point = centre + direction * (coordinate - centre @ direction)
        self._change(dataclasses.replace(self._plane, point=tuple(point)))

    def _change(self, plane: Plane) -> None:
        self.set_plane(plane)
        self.changed.emit(plane)

    def _refresh(self) -> None:
        size = np.abs(self._plane.normal)
        aligned = [key for key, axis in _AXES.items() if np.allclose(size, axis, atol=1e-6)]
        self._axis.set_value(aligned[0] if aligned else "free")
        self._axis.button("free").setEnabled(not aligned)
        low, high = self._span()
        coordinate = float(self._direction() @ self._plane.point)
        with QSignalBlocker(self._slider):
            # A plane of the previous mesh may be farther away than an int of Qt can hold.
            fraction = min(max((coordinate - low) / (high - low), 0.0), 1.0) if high > low else 0.0
            self._slider.setValue(round(_TICKS * fraction))
        self._value.setText(position(coordinate, float(np.ptp(self._bounds, axis=0).max())))
