"""Colour bar, or names of materials with their colours, painted by Qt so that it is sharp at all scales."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFontMetricsF, QImage, QPainter, QPaintEvent, QPen, QPixmap
from PySide6.QtWidgets import QFrame, QLabel, QSizePolicy, QVBoxLayout, QWidget

from hexmend_app.canvas.name_list import NameList
from hexmend_app.canvas.swatch_button import SwatchButton, swatch_text
from hexmend_app.scene.colour.colouring import end_label
from hexmend_app.scene.colour.ticks import ticks_with_ends
from hexmend_app.theme.palette import INVALID_INSIDE, INVERTED, LINE, MUTED, TEXT
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import set_help, smaller, tabular
from hexmend_app.translation import tr

#: Sizes in pixels: height, width of the gradient, length of a tick, gap between tick and number, maximum title width.
_HEIGHT = 300
_THICKNESS, _TICK, _GAP = 14.0, 4.0, 3.0
_MAX_TITLE = 116

_MAX_TICKS = 11


class ColourBar(QFrame):
    """Colour bar: a gradient with ticks, and below it swatches of special colours.

    Parameters
    ----------
    label : str
        Name of the quantity.

    Signals
    -------
    special_clicked(str)
        The user clicked on the swatch of the special colour with this name.
    """

    special_clicked = Signal(str)

    def __init__(self, label: str = "q(H)", parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("colour_bar")
        self.setFont(tabular(smaller(self.font())))
        self._title = QLabel(label)
        self._title.setWordWrap(True)
        self._title.setTextFormat(Qt.TextFormat.PlainText)
        self._gradient = _Gradient()
        self._names = NameList()
        self._names.hide()
        self.swatches: list[SwatchButton] = []
        self._layout = fill(
            QVBoxLayout(self), self._title, (self._gradient, 1), (self._names, 1), margins=(8, 8, 8, 4), spacing=4
        )
        self.set_special([("inverted", 0, INVERTED), ("invalid inside", 0, INVALID_INSIDE)])

    def set_table(self, table: np.ndarray) -> None:
        """Set the colours, (256, 3) uint8, from the lowest to the highest value."""
        table = np.ascontiguousarray(table, dtype=np.uint8)
        if table.ndim != 2 or table.shape[1] != 3:
            raise ValueError(f"the colour table has shape {table.shape}: expected (n, 3)")
        self._gradient.table = table
        self._gradient.update()

    def set_label(self, label: str) -> None:
        """Set the name of the quantity."""
        if label != self._title.text():
            self._title.setText(label)
            self._describe()

    def set_range(self, low: float, high: float, beyond: tuple[bool, bool] = (False, False)) -> None:
        """Set the values at the ends of the gradient."""
        if (low, high, beyond) != (*self.range, self._gradient.beyond):
            self._gradient.low, self._gradient.high, self._gradient.beyond = float(low), float(high), beyond
            self._gradient.update()
            self._describe()

    def set_names(self, names: tuple[str, ...]) -> None:
        """Show names with the colours of the table in place of the gradient; none to show the gradient."""
        self._names.show_names(names, self._gradient.table)
        if bool(names) == self._names.isHidden():
            self._names.setVisible(bool(names))
            self._gradient.setVisible(not names)
            self._describe()

    @property
    def range(self) -> tuple[float, float]:
        """Values at the ends of the gradient."""
        return self._gradient.low, self._gradient.high

    def ticks(self, length: float) -> list[float]:
        """Return the tick values for a gradient with a height in pixels."""
        return self._gradient.ticks(length)

    def set_special(self, special_colours: Sequence[tuple[str, int, Any]]) -> None:
        """Set the special colours: name, number of hexes, colour as name or (red, green, blue) bytes."""
        while len(self.swatches) < len(special_colours):
            swatch = SwatchButton()
            swatch.clicked.connect(lambda _=False, swatch=swatch: self.special_clicked.emit(swatch.name))
            self._layout.addWidget(swatch)
            if self.swatches:
                QWidget.setTabOrder(self.swatches[-1], swatch)
            self.swatches.append(swatch)
        for swatch in self.swatches[len(special_colours) :]:
            swatch.hide()
        for swatch, (name, count, colour) in zip(self.swatches, special_colours, strict=False):
            is_colour = isinstance(colour, str | QColor)
            swatch.show_kind(name, int(count), QColor(colour) if is_colour else QColor(*map(int, colour)))
            swatch.show()
        self._describe()

    def _describe(self) -> None:
        if self._names.names:
            self._describe_names()
            return
        low, high = (self._gradient.text(end) for end in self.range)
        label, shown = self._title.text(), [swatch for swatch in self.swatches if not swatch.isHidden()]
        set_help(
            self,
            tr("Colour bar"),
            tr(
                "Colours show {label} from {low} to {high}; values outside the range have the colour of the nearest "
                "end. Special colours: {names}. Inverted hexes have a corner with a determinant σ ≤ 0; those that are "
                "invalid inside have a negative Jacobian between positive corners. Both are outlined. Drag the bar to "
                "move it; double-click it to reset its position.",
                label=label,
                low=low,
                high=high,
                names=", ".join(tr(swatch.name) for swatch in shown),
            ),
        )
        texts = "; ".join(swatch_text(swatch.name, swatch.count) for swatch in shown)
        self.setAccessibleDescription(
            tr("{texts}; {label} from {low} to {high}", texts=texts, label=label, low=low, high=high)
        )

    def _describe_names(self) -> None:
        names = ", ".join(self._names.names)
        help = tr(
            "Each material has a colour. Inverted hexes are magenta, those that are invalid inside light magenta; both "
            "are outlined. Drag the legend to move it; double-click it to reset its position."
        )
        set_help(self, tr("Legend of materials"), help)
        self.setAccessibleDescription(tr("Materials: {names}", names=names))

    def sizeHint(self) -> QSize:
        """Return the width of the texts, and the default height."""
        title = min(self._title.fontMetrics().horizontalAdvance(self._title.text()) + 2, _MAX_TITLE)
        legend = self._names if self._names.names else self._gradient
        widths = [title, legend.sizeHint().width()]
        widths += [swatch.sizeHint().width() for swatch in self.swatches if not swatch.isHidden()]
        margins = self._layout.contentsMargins()
        height = min(_HEIGHT, super().sizeHint().height()) if self._names.names else _HEIGHT
        return QSize(max(widths) + margins.left() + margins.right(), height)


class _Gradient(QWidget):
    """Gradient with the highest value at the top, and ticks on its right."""

    def __init__(self) -> None:
        super().__init__()
        self.table = np.repeat(np.arange(256, dtype=np.uint8)[:, None], 3, axis=1)
        self.low, self.high = 0.0, 1.0
        self.beyond = (False, False)
        self._key: tuple = ()  # values that `_drawn` depends on
        self._drawn = QPixmap()
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Expanding)

    def text(self, value: float) -> str:
        """Format a value for a tick."""
        return end_label(value, self.low, self.high, self.beyond)

    def sizeHint(self) -> QSize:
        """Return the width of gradient and numbers; a minimum width makes changes rare."""
        metrics = QFontMetricsF(self.font())
        texts = ["0.000", *(self.text(tick) for tick in self.ticks(_HEIGHT / 2))]
        widest = max(map(metrics.horizontalAdvance, texts))
        return QSize(math.ceil(_THICKNESS + _TICK + _GAP + widest), 40)

    def minimumSizeHint(self) -> QSize:
        """Return a height that fits into small views."""
        return QSize(self.sizeHint().width(), 20)

    def ticks(self, length: float) -> list[float]:
        """Return both ends, and round values between them whose labels fit into a height in pixels."""
        space = 2 * QFontMetricsF(self.font()).height() / max(length, 1)
        return ticks_with_ends(self.low, self.high, space, _MAX_TICKS)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint gradient, ticks and numbers from a cached pixmap; called with every frame of the view below."""
        scale = (self.size(), self.devicePixelRatioF(), self.table.tobytes(), self.low, self.high, self.beyond)
        key = (*scale, self.font().key(), str(LINE), str(MUTED), str(TEXT))
        if key != self._key:
            self._key, self._drawn = key, self._draw()
        QPainter(self).drawPixmap(0, 0, self._drawn)

    def _draw(self) -> QPixmap:
        ratio = self.devicePixelRatioF()
        pixmap = QPixmap(self.size() * ratio)
        pixmap.setDevicePixelRatio(ratio)
        pixmap.fill(Qt.GlobalColor.transparent)
        painter = QPainter(pixmap)
        painter.setFont(self.font())
        metrics = QFontMetricsF(self.font())
        half = metrics.height() / 2
        bar = QRectF(0.0, half, _THICKNESS, max(self.height() - 2 * half, 1.0))
        # A column of 256 pixels, which the painter stretches at the resolution of the screen.
        table = np.ascontiguousarray(self.table[::-1])
        painter.drawImage(bar, QImage(table.tobytes(), 1, len(table), 3, QImage.Format.Format_RGB888))
        painter.setPen(QPen(QColor(str(LINE)), 0))
        painter.drawRect(bar)
        for value in self.ticks(bar.height()):
            share = (value - self.low) / (self.high - self.low)
            y = round(bar.bottom() - share * bar.height())
            painter.setPen(QPen(QColor(str(MUTED)), 1))
            painter.drawLine(QPointF(bar.right() + 1, y), QPointF(bar.right() + _TICK, y))
            painter.setPen(QColor(str(TEXT)))
            painter.drawText(QPointF(bar.right() + _TICK + _GAP, y + metrics.ascent() / 2 - 1), self.text(value))
        painter.end()
        return pixmap
