"""Slider of the timeline, with marks for pauses."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QSlider, QStyle, QStyleOptionSlider, QWidget

from hexmend_app.theme.palette import WORSE

_MARK, _STRIP = 2, 3  # pixels


class TrackSlider(QSlider):
    """Slider for iterations that jumps to the pressed place and marks pauses."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(Qt.Orientation.Horizontal, parent)
        self._marks: tuple[int, ...] = ()

    def set_track(self, newest: int, marks: Iterable[int]) -> None:
        """Set the latest iteration and the pauses, without sending a signal."""
        blocked = self.blockSignals(True)
        self.setRange(0, newest)
        self.setPageStep(max(1, newest // 10))
        self.blockSignals(blocked)
        self._marks = tuple(marks)
        self.update()

    def place(self, number: float) -> int:
        """Return the horizontal position of a number in pixels."""
        groove, handle = self._groove(), self._handle_width()
        share = number / max(self.maximum(), 1)
        return round(groove.x() + handle / 2 + share * (groove.width() - handle))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the slider, and ticks for pauses."""
        super().paintEvent(event)
        painter = QPainter(self)
        y = self.height() - _STRIP
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

    def _option(self) -> QStyleOptionSlider:
        option = QStyleOptionSlider()
        self.initStyleOption(option)
        return option

    def _groove(self) -> QRect:
        controls, parts = QStyle.ComplexControl, QStyle.SubControl
        return self.style().subControlRect(controls.CC_Slider, self._option(), parts.SC_SliderGroove, self)

    def _handle_width(self) -> int:
        return self.style().pixelMetric(QStyle.PixelMetric.PM_SliderLength, self._option(), self)
