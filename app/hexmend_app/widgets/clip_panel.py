"""The panel of the clipping plane."""

from __future__ import annotations

import dataclasses

import numpy as np
from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QCheckBox, QGridLayout, QHBoxLayout, QLabel, QPushButton, QSlider, QWidget

from hexmend_app.state.look import ClipPlane
from hexmend_app.widgets.segmented import Segmented
from hexmend_app.widgets.style import explain, icon, tabular

_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
_TICKS = 1000


class ClipPanel(QWidget):
    """Sets a plane that cuts the mesh open.

    The slider walks along the plane's axis through the mesh's bounds, in the direction of the axis also where the plane
    is flipped.

    Signals
    -------
    clip_changed(ClipPlane or None)
        The user moved, turned or switched the plane.
    plane_shown_changed(bool)
        The user wants the plane itself drawn, or not.
    """

    clip_changed = Signal(object)
    plane_shown_changed = Signal(bool)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._bounds: np.ndarray | None = None  # (2, 3): lowest and highest corner
        self._plane = ClipPlane()
        self._on = QCheckBox("Clipping plane")
        explain(self._on, "Clipping plane", "Cut the mesh open along a plane and look inside.")
        self._axis = Segmented(
            "Axis",
            [(key, key.upper(), f"A plane across the {key.upper()} axis.") for key in _AXES]
            + [("free", "Free", "For a plane that has been turned in the view; choose X, Y or Z to set it straight.")],
        )
        self._flip = QPushButton(icon("swap-horizontal"), "Flip")
        explain(self._flip, "Flip", "Hide the other side of the plane.")
        self._slider = QSlider(Qt.Orientation.Horizontal)
        self._slider.setRange(0, _TICKS)
        self._slider.setPageStep(_TICKS // 20)
        explain(self._slider, "Position", "Where the plane stands; arrow keys move it by a thousandth of the mesh.")
        self._value = QLabel()
        self._value.setFont(tabular(self._value.font()))
        self._value.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self._value.setMinimumWidth(self._value.fontMetrics().horizontalAdvance("-0.0000e+00"))
        explain(self._value, "Position in mesh units", "Position along the plane's axis in the mesh's unit of length.")
        self._cut = Segmented(
            "Cut",
            [
                ("crinkle", "Whole elements", "Show an element whole where its centre lies on the kept side."),
                ("smooth", "Smooth cut", "Cut through the elements; the cut shows the inside of each."),
            ],
        )
        self._shown = QCheckBox("Show the plane")
        self._shown.setChecked(True)
        explain(self._shown, "Show the plane", "Draw the plane in the view, where it can be dragged and turned.")
        self._lay_out()

        self._on.clicked.connect(self._announce)
        self._axis.chosen.connect(self._on_axis)
        self._slider.valueChanged.connect(self._on_slider)
        self._flip.clicked.connect(lambda: self._change(self._plane.flipped()))
        self._cut.chosen.connect(lambda key: self._change(dataclasses.replace(self._plane, crinkle=key == "crinkle")))
        self._shown.clicked.connect(self.plane_shown_changed)
        self._refresh()

    def _lay_out(self) -> None:
        grid = QGridLayout(self)
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(7)
        grid.setColumnStretch(1, 1)
        head = QHBoxLayout()
        head.addWidget(self._on)
        head.addStretch()
        head.addWidget(self._shown)
        grid.addLayout(head, 0, 0, 1, 3)
        for row, (text, widget) in enumerate(
            (("Axis", self._axis), ("Position", self._slider), ("Cut", self._cut)), start=1
        ):
            label = QLabel(text)
            label.setBuddy(widget)
            grid.addWidget(label, row, 0)
            grid.addWidget(widget, row, 1, 1, 2 if widget is self._cut else 1)
        grid.addWidget(self._flip, 1, 2)
        self.setTabOrder(self._axis.button("free"), self._flip)
        grid.addWidget(self._value, 2, 2)

    def set_bounds(self, bounds: tuple[float, float, float, float, float, float] | None) -> None:
        """Take the mesh's (x low, x high, y low, y high, z low, z high), or None without a mesh; without a signal."""
        self._bounds = None if bounds is None else np.asarray(bounds, dtype=float).reshape(3, 2).T
        if self._bounds is not None and not self._on.isChecked():
            self._plane = dataclasses.replace(self._plane, origin=tuple(self._bounds.mean(axis=0)))
        self._refresh()

    def set_clip(self, plane: ClipPlane | None) -> None:
        """Show a plane, for example one dragged in the view, or that there is none; without a signal."""
        self._on.setChecked(plane is not None)
        self._plane = self._plane if plane is None else plane
        self._refresh()

    def set_plane_shown(self, shown: bool) -> None:
        """Show whether the plane itself is drawn; without a signal."""
        self._shown.setChecked(shown)

    def clip(self) -> ClipPlane | None:
        """The plane shown, or None while it is off."""
        return self._plane if self._on.isChecked() and self._bounds is not None else None

    def plane(self) -> ClipPlane:
        """The plane as it stands, or as it would be switched on."""
        return self._plane

    def _direction(self) -> np.ndarray:
        """(3,) unit normal in the sense in which its largest component is positive: the slider's axis."""
        normal = np.array(self._plane.normal)
        return normal if normal[np.argmax(np.abs(normal).round(9))] > 0 else -normal

    def _span(self) -> tuple[float, float]:
        """Lowest and highest place of the mesh's bounds along the slider's axis."""
        direction = self._direction()
        ends = self._bounds * direction
        return float(ends.min(axis=0).sum()), float(ends.max(axis=0).sum())

    def _written(self, place: float) -> str:
        """A position; what is less than a tenth of the slider's step from 0 is 0, such as the middle of most meshes."""
        extent = float(np.ptp(self._bounds, axis=0).max())
        return f"{0.0 if abs(place) < 0.1 * extent / _TICKS else place:.4g}"

    def _on_axis(self, key: str) -> None:
        if key == "free":  # says how the plane stands; there is nothing to set
            return
        self._plane = dataclasses.replace(self._plane, normal=_AXES[key], origin=tuple(self._bounds.mean(axis=0)))
        self._change(self._plane)

    def _on_slider(self, tick: int) -> None:
        low, high = self._span()
        direction, centre = self._direction(), self._bounds.mean(axis=0)
        place = low + (high - low) * tick / _TICKS
        origin = centre + direction * (place - centre @ direction)
        self._plane = dataclasses.replace(self._plane, origin=tuple(origin))
        self._value.setText(self._written(place))
        self._announce()

    def _change(self, plane: ClipPlane) -> None:
        self._plane = plane
        self._announce()

    def _announce(self) -> None:
        self._refresh()
        self.clip_changed.emit(self.clip())

    def _refresh(self) -> None:
        self._on.setEnabled(self._bounds is not None)
        for part in (self._axis, self._flip, self._slider, self._value, self._cut, self._shown):
            part.setEnabled(self._bounds is not None and self._on.isChecked())
        size = np.abs(self._plane.normal)
        straight = [key for key, axis in _AXES.items() if np.allclose(size, axis, atol=1e-6)]
        self._axis.set_value(straight[0] if straight else "free")
        self._axis.button("free").setEnabled(not straight)
        self._cut.set_value("crinkle" if self._plane.crinkle else "smooth")
        if self._bounds is None:
            self._value.setText("–")
            return
        low, high = self._span()
        place = float(self._direction() @ self._plane.origin)
        with QSignalBlocker(self._slider):
            self._slider.setValue(round(_TICKS * (place - low) / (high - low)) if high > low else 0)
        self._value.setText(self._written(place))
