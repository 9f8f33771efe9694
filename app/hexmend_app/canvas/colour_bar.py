"""Colour bar, or names of materials with their colours, painted by Qt so that it is sharp at all scales."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFontMetricsF, QImage, QPainter, QPaintEvent, QPen, QPixmap
from PySide6.QtWidgets import QFrame, QLabel, QSizePolicy, QVBoxLayout, QWidget

from hexmend_app.canvas.name_list import NameList
from hexmend_app.canvas.swatch_button import SwatchButton, swatch_text
from hexmend_app.picture.colour_map import COLOUR_MAPS, DEFAULT_MAP
from hexmend_app.scene.colour.colouring import Colouring
from hexmend_app.theme.palette import LINE, MUTED, TEXT
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

    Signals
    -------
    special_clicked(str)
        The user clicked on the swatch of the special colour with this name.
    """

    special_clicked = Signal(str)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("colour_bar")
        self.setFont(tabular(smaller(self.font())))
        self._title = QLabel()
        self._title.setWordWrap(True)
        self._title.setTextFormat(Qt.TextFormat.PlainText)
        self._gradient = _Gradient()
        self._names = NameList()
        self.swatches: list[SwatchButton] = []
        self._layout = fill(
            QVBoxLayout(self), self._title, (self._gradient, 1), (self._names, 1), margins=(8, 8, 8, 4), spacing=4
        )
        self.show_colouring(Colouring("q(H)", 0.0, 1.0, COLOUR_MAPS[DEFAULT_MAP].table))

    def show_colouring(self, colouring: Colouring, counts: Sequence[int] = ()) -> None:
        """Show a colouring, and the numbers of hexes with its special colours, by default none."""
        self._title.setText(tr(colouring.title))
        self._gradient.colouring = colouring
        self._gradient.setVisible(not colouring.names)
        self._gradient.update()
        self._names.show_names(colouring.names, colouring.table)
        self._names.setVisible(bool(colouring.names))
        kinds = colouring.special_colours
        while len(self.swatches) < len(kinds):
            swatch = SwatchButton()
            swatch.clicked.connect(lambda _=False, swatch=swatch: self.special_clicked.emit(swatch.name))
            self._layout.addWidget(swatch)
            if self.swatches:
                QWidget.setTabOrder(self.swatches[-1], swatch)
            self.swatches.append(swatch)
        for swatch, special, count in zip(self.swatches, kinds, counts or [0] * len(kinds), strict=False):
            swatch.show_kind(special.name, count, QColor(*special.colour))
        for number, swatch in enumerate(self.swatches):
            swatch.setVisible(number < len(kinds))
        self._describe()

    def ticks(self, length: float) -> list[float]:
        """Return the tick values for a gradient with a height in pixels."""
        return self._gradient.ticks(length)

    def _describe(self) -> None:
        colouring = self._gradient.colouring
        if colouring.names:
            self._describe_names()
            return
        low, high = colouring.label(colouring.low), colouring.label(colouring.high)
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
        self.colouring = Colouring("", 0.0, 1.0, np.zeros((1, 3), dtype=np.uint8))
        self._key: tuple = ()  # values that `_drawn` depends on
        self._drawn = QPixmap()
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Expanding)

    def sizeHint(self) -> QSize:
        """Return the width of gradient and numbers; a minimum width makes changes rare."""
        metrics = QFontMetricsF(self.font())
        texts = ["0.000", *(self.colouring.label(tick) for tick in self.ticks(_HEIGHT / 2))]
        widest = max(map(metrics.horizontalAdvance, texts))
        return QSize(math.ceil(_THICKNESS + _TICK + _GAP + widest), 40)

    def minimumSizeHint(self) -> QSize:
        """Return a height that fits into small views."""
        return QSize(self.sizeHint().width(), 20)

    def ticks(self, length: float) -> list[float]:
        """Return both ends, and round values between them whose labels fit into a height in pixels."""
        space = 2 * QFontMetricsF(self.font()).height() / max(length, 1)
        return self.colouring.ticks(space, _MAX_TICKS)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint gradient, ticks and numbers from a cached pixmap; called with every frame of the view below."""
        shown = self.colouring
        scale = shown.table.tobytes(), shown.low, shown.high, shown.beyond, self.font().key()
        key = self.size(), self.devicePixelRatioF(), *scale, str(LINE), str(MUTED), str(TEXT)
        if key != self._key:
            self._key, self._drawn = key, self._draw()
        QPainter(self).drawPixmap(0, 0, self._drawn)

    def _draw(self) -> QPixmap:
        colouring, ratio = self.colouring, self.devicePixelRatioF()
        pixmap = QPixmap(self.size() * ratio)
        pixmap.setDevicePixelRatio(ratio)
        pixmap.fill(Qt.GlobalColor.transparent)
        painter = QPainter(pixmap)
        painter.setFont(self.font())
        metrics = QFontMetricsF(self.font())
        half = metrics.height() / 2
        bar = QRectF(0.0, half, _THICKNESS, max(self.height() - 2 * half, 1.0))
        # A column of 256 pixels, which the painter stretches at the resolution of the screen.
        table = np.ascontiguousarray(colouring.table[::-1])
        painter.drawImage(bar, QImage(table.tobytes(), 1, len(table), 3, QImage.Format.Format_RGB888))
        painter.setPen(QPen(QColor(str(LINE)), 0))
        painter.drawRect(bar)
        for value in self.ticks(bar.height()):
            share = (value - colouring.low) / (colouring.high - colouring.low)
            y = round(bar.bottom() - share * bar.height())
            painter.setPen(QPen(QColor(str(MUTED)), 1))
            painter.drawLine(QPointF(bar.right() + 1, y), QPointF(bar.right() + _TICK, y))
            painter.setPen(QColor(str(TEXT)))
            painter.drawText(QPointF(bar.right() + _TICK + _GAP, y + metrics.ascent() / 2 - 1), colouring.label(value))
        painter.end()
        return pixmap
