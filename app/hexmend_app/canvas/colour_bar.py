"""The colour bar, painted by Qt so that it stays sharp at every scale."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QImage, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from hexmend_app.scene.colours import range_label
from hexmend_app.widgets.style import INVERTED, LINE, MUTED, TEXT, explain, smaller, tabular

_THICKNESS = 14.0
_SWATCH = 32.0
_GAP = 24.0
_TICK = 4.0
_MOST_TICKS = 11


def nice_ticks(low: float, high: float, most: int) -> list[float]:
    """At most `most` multiples of 1, 2, 2.5 or 5 times a power of ten in [low, high].

    >>> nice_ticks(0, 1, 6)
    [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]
    >>> nice_ticks(0.31, 0.44, 4)
    [0.35, 0.4]
    """
    if not high > low or most < 1:
        return []
    power = math.floor(math.log10((high - low) / most))
    for step in (round(m * 10.0**e, 12 - e) for e in (power, power + 1, power + 2) for m in (1, 2, 2.5, 5)):
        first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
        if last - first + 1 <= most:
            return [round(k * step, 10) for k in range(first, last + 1)]
    return []


class ColourBar(QWidget):
    """What the colours mean: a gradient with ticks, and a swatch of its own for inverted elements.

    Parameters
    ----------
    orientation : Qt.Orientation
        Which way the gradient runs.
    label : str
        The quantity.
    """

    def __init__(
        self,
        orientation: Qt.Orientation = Qt.Orientation.Horizontal,
        label: str = "q(H)",
        parent: QWidget | None = None,
    ):
        super().__init__(parent)
        self._across = orientation == Qt.Orientation.Horizontal
        self._label = label
        self._table = np.repeat(np.arange(256, dtype=np.uint8)[:, None], 3, axis=1)
        self._low, self._high = 0.0, 1.0
        self._apart: list[tuple[str, int, QColor]] = [("inverted", 0, QColor(INVERTED))]
        self.setFont(tabular(smaller(self.font())))
        self.setContentsMargins(9, 3, 9, 3)
        fixed, grows = QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding
        self.setSizePolicy(*((grows, fixed) if self._across else (fixed, grows)))
        self._describe()

    def set_table(self, table: np.ndarray) -> None:
        """Take the colour map, (256, 3) uint8, lowest value first."""
        table = np.ascontiguousarray(table, dtype=np.uint8)
        if table.ndim != 2 or table.shape[1] != 3:
            raise ValueError(f"the colour table has shape {table.shape}: expected (n, 3)")
        self._table = table
        self.update()

    def set_label(self, label: str) -> None:
        """Take the name of the quantity."""
        self._label = label
        self._describe()
        self.updateGeometry()
        self.update()

    def set_range(self, low: float, high: float) -> None:
        """Take the values at the ends of the gradient."""
        self._low, self._high = float(low), float(high)
        self._describe()
        self.update()

    def set_apart(self, apart: Sequence[tuple[str, int, object]]) -> None:
        """Take what has a colour of its own: name, number of elements, colour as name or (red, green, blue) bytes."""
        self._apart = [
            (name, int(count), QColor(colour) if isinstance(colour, str | QColor) else QColor(*map(int, colour)))
            for name, count, colour in apart
        ]
        self._describe()
        self.updateGeometry()
        self.update()

    def _describe(self) -> None:
        low, high = self._text(self._low), self._text(self._high)
        explain(
            self,
            "Colour bar",
            f"Colours stand for {self._label} from {low} to {high}; values beyond an end have the end's colour. "
            f"Elements that are {' or '.join(name for name, *_ in self._apart)} have a colour of their own; inverted "
            "ones are turned inside out at a corner (a determinant σ ≤ 0), and outlined.",
        )
        texts = "; ".join(_swatch_text(name, count) for name, count, _ in self._apart)
        self.setAccessibleDescription(f"{texts}; {self._label} from {low} to {high}")

    def _text(self, value: float) -> str:
        return range_label(value, self._low, self._high)

    def sizeHint(self) -> QSize:
        """As much as the labels need."""
        metrics, margins = QFontMetricsF(self.font()), self.contentsMargins()
        if self._across:
            size = QSize(300, math.ceil(_THICKNESS + _TICK + metrics.height() + 3))
        else:
            width = max(_THICKNESS + _TICK + 3 + metrics.horizontalAdvance("0.000"), *self._rooms(metrics))
            size = QSize(math.ceil(width), 200)
        return size.grownBy(margins)

    minimumSizeHint = sizeHint

    def _rooms(self, metrics: QFontMetricsF) -> list[float]:
        """Width of each swatch's text; a single one has room for a large count, so that the gradient holds still."""
        if len(self._apart) > 1:
            return [max(_SWATCH, metrics.horizontalAdvance(_swatch_text(name, n))) for name, n, _ in self._apart]
        ((name, count, _),) = self._apart
        wide = f"{name} (00,000)" if 0 < count < 100_000 else _swatch_text(name, count)
        return [metrics.horizontalAdvance(wide)]

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint swatches, gradient, ticks and labels."""
        painter = QPainter(self)
        painter.setFont(self.font())
        metrics = QFontMetricsF(self.font())
        swatches, bar = self._boxes(metrics)
        # One row of 256 pixels, stretched by the painter at the screen's own resolution.
        table = self._table if self._across else np.ascontiguousarray(self._table[::-1])
        n = len(table)
        width, height = (n, 1) if self._across else (1, n)
        image = QImage(table.tobytes(), width, height, 3 * width, QImage.Format.Format_RGB888)
        painter.drawImage(bar, image)
        for swatch, (*_, colour) in zip(swatches, self._apart, strict=True):
            painter.fillRect(swatch, colour)
        painter.setPen(QPen(QColor(str(LINE)), 0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRects([*swatches, bar])
        self._paint_labels(painter, metrics, swatches, bar)

    def _boxes(self, metrics: QFontMetricsF) -> tuple[list[QRectF], QRectF]:
        """Swatches and gradient."""
        inside = QRectF(self.contentsRect())
        if self._across:
            swatches, left = [], inside.left()
            for room in self._rooms(metrics):
                swatches.append(QRectF(left, inside.top(), _SWATCH, _THICKNESS))
                left += room + (_GAP if len(self._apart) == 1 else 0.6 * _GAP)
            if len(self._apart) > 1:  # a single one has room to spare
                left += metrics.horizontalAdvance(self._text(self._low)) / 2
            right = inside.right() - metrics.horizontalAdvance(self._label) - 8
            return swatches, QRectF(left, inside.top(), max(right - left, 1), _THICKNESS)
        top = inside.top() + metrics.height() + 4
        each = metrics.height() + _TICK + _THICKNESS
        under = inside.bottom() - len(self._apart) * each
        swatches = [QRectF(inside.left(), under + k * each, _THICKNESS, _THICKNESS) for k in range(len(self._apart))]
        return swatches, QRectF(inside.left(), top, _THICKNESS, max(under - _GAP - top, 1))

    def _ticks(self, length: float, room: float) -> list[float]:
        """Both ends, and of the round values between them those that leave each number its room."""
        low, high = self._low, self._high
        if not high > low:
            return []
        near = room / max(length, 1) * (high - low)
        between: list[float] = []
        for most in range(min(int(length / room) + 1, _MOST_TICKS), 2, -1):
            between = nice_ticks(low, high, most)
            if len(between) < 2 or between[1] - between[0] >= near:
                break
        return [low, *(tick for tick in between if low + near <= tick <= high - near), high]

    def _paint_labels(self, painter: QPainter, metrics: QFontMetricsF, swatches: list[QRectF], bar: QRectF) -> None:
        line, ascent = metrics.height(), metrics.ascent()
        painter.setPen(QColor(str(TEXT)))
        if self._across:
            painter.drawText(QPointF(bar.right() + 8, bar.center().y() + ascent / 2 - 1), self._label)
        else:
            painter.drawText(QPointF(bar.left(), bar.top() - 4 - metrics.descent()), self._label)
        for swatch, (name, count, _) in zip(swatches, self._apart, strict=True):
            painter.setPen(QColor(str(TEXT if count else MUTED)))
            painter.drawText(QPointF(swatch.left(), swatch.bottom() + _TICK + 2 + ascent), _swatch_text(name, count))

        length = bar.width() if self._across else bar.height()
        ends = self._text(self._low), self._text(self._high)
        room = max(map(metrics.horizontalAdvance, ends)) + metrics.horizontalAdvance("00") if self._across else 2 * line
        for value in self._ticks(length, room):
            share = (value - self._low) / (self._high - self._low)
            text = self._text(value)
            painter.setPen(QPen(QColor(str(MUTED)), 1))
            if self._across:
                x = round(bar.left() + share * length) + 0.5 * (share < 0.5) - 0.5 * (share >= 0.5)
                painter.drawLine(QPointF(x, bar.bottom() + 1), QPointF(x, bar.bottom() + _TICK))
                wide = metrics.horizontalAdvance(text)
                painter.setPen(QColor(str(TEXT)))
                # The label stands higher, so the last number may reach under it.
                painter.drawText(QPointF(x - wide / 2, bar.bottom() + _TICK + 2 + ascent), text)
            else:
                y = round(bar.bottom() - share * length)
                painter.drawLine(QPointF(bar.right() + 1, y), QPointF(bar.right() + _TICK, y))
                painter.setPen(QColor(str(TEXT)))
                painter.drawText(QPointF(bar.right() + _TICK + 3, y + ascent / 2 - 1), text)


def _swatch_text(name: str, count: int) -> str:
    return f"{name} ({count:,})" if count else name
