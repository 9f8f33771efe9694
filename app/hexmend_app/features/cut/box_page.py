"""Page that edits the sides of a cutting box."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QLabel, QWidget
from superqt import QRangeSlider

from hexmend_app.theme.style import labelled, set_help, smaller, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.form_grid import form_grid
from hexmend_app.widgets.wording import position

_TICKS = 1000


class BoxPage(QWidget):
    """Page that moves the six sides of an axis-aligned box.

    Signals
    -------
    changed(low, high)
        The user moved a side; the lowest and highest corner as tuples of 3 floats.
    """

    changed = Signal(object, object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._bounds = np.array([[0.0] * 3, [1.0] * 3])
        self._corners = self._bounds.copy()  # low, high
        self._sliders, self._texts = [], []
        grid = form_grid(self, tr("Thickness"))
        for axis, name in enumerate("XYZ"):
            slider = QRangeSlider(Qt.Orientation.Horizontal)
            slider.setRange(0, _TICKS)
            slider.setPageStep(_TICKS // 20)
            slider.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
            help = tr("Extent of the box along {name}. Drag an end, or drag between the ends to move both.", name=name)
            set_help(slider, tr("{name} extent of the box", name=name), help)
            slider.valueChanged.connect(lambda ticks, axis=axis: self._on_slider(axis, ticks))
            text = QLabel()
            text.setFont(tabular(smaller(text.font())))
            text.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
            text.setMinimumWidth(text.fontMetrics().horizontalAdvance("-0.000 – -0.000"))
            for column, widget in enumerate((labelled(name, slider), slider, text)):
                grid.addWidget(widget, axis, column)
            self._sliders.append(slider)
            self._texts.append(text)
        self._refresh()

    def set_bounds(self, bounds: np.ndarray) -> None:
        """Set the lowest and highest corner of the mesh, (2, 3); emits no signal."""
        self._bounds = bounds
        self._refresh()

    def set_corners(self, low: tuple[float, float, float], high: tuple[float, float, float]) -> None:
        """Show a box; emits no signal."""
        self._corners = np.array([low, high])
        self._refresh()

    def _on_slider(self, axis: int, ticks: tuple[int, int]) -> None:
        low, high = self._bounds[:, axis]
        before = self._ticks(axis)
        for end in range(2):
            if ticks[end] != before[end]:  # the other end is not rounded to a tick
                self._corners[end, axis] = low + (high - low) * ticks[end] / _TICKS
        self._write()
        self.changed.emit(*(tuple(corner.tolist()) for corner in self._corners))

    def _ticks(self, axis: int) -> tuple[int, int]:
        low, high = self._bounds[:, axis]
        fractions = (self._corners[:, axis] - low) / ((high - low) or 1.0)
        return tuple(np.clip(np.rint(_TICKS * fractions), 0, _TICKS).astype(int).tolist())

    def _refresh(self) -> None:
        for axis, slider in enumerate(self._sliders):
            with QSignalBlocker(slider):
                slider.setValue(self._ticks(axis))
        self._write()

    def _write(self) -> None:
        extent = float(np.ptp(self._bounds, axis=0).max())
        for axis, text in enumerate(self._texts):
            text.setText(" – ".join(position(end, extent, 3) for end in self._corners[:, axis]))
