"""Slider of the timeline, with marks for stored iterations and pauses."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QSlider, QStyle, QStyleOptionSlider, QWidget

from hexmend_app.theme.palette import BLUE, WORSE

_MARK, _STRIP = 2, 3  # pixels


class TrackSlider(QSlider):
    """Slider for iterations that jumps to the pressed place and marks stored iterations and pauses."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(Qt.Orientation.Horizontal, parent)
        self._kept = np.zeros(0, np.int64)
        self._marks: tuple[int, ...] = ()

    def set_track(self, newest: int, kept: np.ndarray, marks: Iterable[int]) -> None:
        """Set the latest iteration, the stored ones (k,) int ascending, and the pauses, without sending a signal."""
        blocked = self.blockSignals(True)
        self.setRange(0, newest)
        self.setPageStep(max(1, newest // 10))
        self.blockSignals(blocked)
        self._kept, self._marks = kept, tuple(marks)
        self.update()

    def place(self, number: float) -> int:
        """Return the horizontal position of a number in pixels."""
        groove, handle = self._groove(), self._handle_width()
        share = number / max(self.maximum(), 1)
        return round(groove.x() + handle / 2 + share * (groove.width() - handle))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the slider; below it a line for stored iterations, if not all are stored, and ticks for pauses."""
        super().paintEvent(event)
        painter = QPainter(self)
        y = self.height() - _STRIP
        if 0 < len(self._kept) < self.maximum() + 1:
            for left, right in self._ranges():
                x = self.place(left)
                painter.fillRect(x, y, max(self.place(right) - x, 1), _STRIP, QColor(str(BLUE)))
        for number in self._marks:
            x = self.place(number) - _MARK // 2
            painter.fillRect(x, y - _STRIP, _MARK, 2 * _STRIP, QColor(str(WORSE)))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Move the handle to the pressed place, from where it can be dragged."""
        if event.button() is Qt.MouseButton.LeftButton:
            groove, handle = self._groove(), self._handle_width()
            position = round(event.position().x()) - groove.x() - handle // 2
            span = groove.width() - handle
            self.setValue(QStyle.sliderValueFromPosition(self.minimum(), self.maximum(), position, span))
        super().mousePressEvent(event)

    def _ranges(self) -> Iterable[tuple[float, float]]:
        """Return the ranges of consecutive stored iterations, extended by a quarter at both ends."""
        breaks = np.flatnonzero(np.diff(self._kept) > 1)
        starts = self._kept[np.append(0, breaks + 1)]
        ends = self._kept[np.append(breaks, len(self._kept) - 1)]
        return zip(starts - 0.25, ends + 0.25, strict=True)

    def _option(self) -> QStyleOptionSlider:
        option = QStyleOptionSlider()
        self.initStyleOption(option)
        return option

    def _groove(self) -> QRect:
        controls, parts = QStyle.ComplexControl, QStyle.SubControl
        return self.style().subControlRect(controls.CC_Slider, self._option(), parts.SC_SliderGroove, self)

    def _handle_width(self) -> int:
        return self.style().pixelMetric(QStyle.PixelMetric.PM_SliderLength, self._option(), self)
