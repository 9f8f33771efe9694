"""Inputs of a cutting plane, and rows of number boxes that show coordinates which are also dragged in the view."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QObject, QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QSlider, QWidget

from hexmend.parameters import Parameter
from hexmend_app.picture.cut_shapes import Plane
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import icon_button, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.form import row_of
from hexmend_app.widgets.inputs.number_box import NumberBox
from hexmend_app.widgets.inputs.segmented import Segmented

_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
_TICKS = 1000
#: Significant digits of numbers that were dragged.
_DIGITS = 4
_MIN_WIDTH = 48  # of three boxes in the narrowest panel


class NumberRow(QWidget):
    """Row of boxes for a few numbers.

    A number that was not typed is shown rounded; `changed` gives the number typed and leaves the others as they are.

    Parameters
    ----------
    names : sequence of str
        Accessible name of each box.
    help : str
    low : float, optional
        Lower bound.

    Attributes
    ----------
    values : tuple of float
        The numbers, not rounded.

    Signals
    -------
    changed(tuple of float)
        The user typed a number.
    """

    changed = Signal(object)

    def __init__(self, names: Sequence[str], help: str, low: float | None = None, parent: QWidget | None = None):
        super().__init__(parent)
        self.values = tuple(1.0 for _ in names)
        self._boxes = [NumberBox(Parameter(name, float, 1.0, low, None, None, "", "")) for name in names]
        for at, (name, box) in enumerate(zip(names, self._boxes, strict=True)):
            set_help(box, name, help)
            box.setMinimumWidth(_MIN_WIDTH)
            if len(names) > 1:  # there is no room for the arrows
                box.setButtonSymbols(NumberBox.ButtonSymbols.NoButtons)
            box.changed.connect(lambda at=at: self._on_changed(at))
        fill(QHBoxLayout(self), *((box, 1) for box in self._boxes), margins=(0, 0, 0, 0), spacing=4)
        self.setFocusProxy(self._boxes[0])

    def set_values(self, values: Sequence[float]) -> None:
        """Show numbers; emits no signal, and leaves text that is being typed."""
        self.values = tuple(values)
        for box, value in zip(self._boxes, self.values, strict=True):
            if _rounded(box.value()) != _rounded(value):
                box.set_value(_rounded(value))

    def set_range(self, low: float, high: float) -> None:
        """Show two numbers, of which the first digits of the greater one, being typed, may be less than the other."""
        if sorted(self.values) != [low, high]:
            self.set_values((low, high))

    def _on_changed(self, at: int) -> None:
        typed = self._boxes[at].value()
        if typed != _rounded(self.values[at]):
            self.values = (*self.values[:at], typed, *self.values[at + 1 :])
            self.changed.emit(self.values)


def _rounded(value: float) -> float:
    return float(f"{value:.{_DIGITS}g}")


class PlaneEditor(QObject):
    """Inputs that align a plane with an axis, move it and flip it.

    The slider covers the mesh's bounds along the plane's normal, in the same direction if the plane is flipped.

    Attributes
    ----------
    axis_row, position_row : QWidget
        Rows of a form.
    flip : QPushButton

    Signals
    -------
    changed(Plane)
        The user changed the plane.
    """

    changed = Signal(object)

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._bounds = np.array([[0.0] * 3, [1.0] * 3])  # lowest and highest corner
        self._plane = Plane(point=(0.0, 0.0, 0.0))
        axes = [(key, key.upper(), tr("A plane normal to the {axis} axis.", axis=key.upper())) for key in _AXES]
        free = tr("A plane that was rotated in the view; select X, Y or Z to align it with an axis.")
        self._axis = Segmented(tr("Axis"), [*axes, ("free", tr("Free"), free)])
        self.flip = icon_button("swap-horizontal", tr("Flip"), tr("Hide the opposite side of the plane."))
        self._slider = QSlider(Qt.Orientation.Horizontal)
        self._slider.setRange(0, _TICKS)
        self._slider.setPageStep(_TICKS // 20)
        help = tr("Position of the plane; arrow keys move it by 1/1000 of the mesh's extent.")
        set_help(self._slider, tr("Position"), help)
        self._value = NumberRow([tr("Position in mesh units")], tr("Position along the plane's normal, in mesh units."))
        self._value.setFixedWidth(76)
        self.axis_row = row_of((self._axis, 1), self.flip)
        self.position_row = row_of((self._slider, 1), self._value)
        self._axis.chosen.connect(self._on_axis)
        self._slider.valueChanged.connect(self._on_slider)
        self._value.changed.connect(lambda values: self._move_to(*values))
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
        self._move_to(low + (high - low) * tick / _TICKS)

    def _move_to(self, coordinate: float) -> None:
        """Move the plane along its normal to a position on the slider's axis."""
        direction, centre = self._direction(), self._bounds.mean(axis=0)
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
        extent = float(np.ptp(self._bounds, axis=0).max())
        decimals = 3 - math.floor(math.log10(extent)) if extent > 0 else 3  # about a thousandth of the mesh
        self._value.set_values((round(coordinate, decimals),))
