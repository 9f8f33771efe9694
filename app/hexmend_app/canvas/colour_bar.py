"""Colour bar, or names of materials with their colours, painted by Qt so that it is sharp at all scales."""

from __future__ import annotations

import math
from collections.abc import Sequence
from html import escape

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFontMetricsF, QIcon, QImage, QPainter, QPaintEvent, QPen, QPixmap
from PySide6.QtWidgets import QFrame, QLabel, QSizePolicy, QToolButton, QVBoxLayout, QWidget

from hexmend_app.picture.colour_map import COLOUR_MAPS, DEFAULT_MAP
from hexmend_app.scene.colour.colouring import Colouring, SpecialColour
from hexmend_app.scene.page.lettering import name_entries
from hexmend_app.theme.palette import LINE, MUTED, TEXT
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import on_theme_change, set_help, set_variant, smaller, tabular
from hexmend_app.translation import tr

#: Sizes in pixels: height, width of the gradient, length of a tick, gap between tick and number, maximum title width.
_HEIGHT = 300
_THICKNESS, _TICK, _GAP = 14.0, 4.0, 3.0
_MAX_TITLE = 116

_MAX_TICKS = 11

#: Maximum number of rows of materials, and side of a swatch in pixels.
_MAX_ROWS, _SWATCH = 14, 12


class ColourBar(QFrame):
    """Colour bar: a gradient with ticks, and below it swatches of special colours.

    Signals
    -------
    special_clicked(str)
        The user clicked on the swatch of the special colour with this name.
    material_clicked(int)
        The user clicked on the name of the material with this number.
    """

    special_clicked = Signal(str)
    material_clicked = Signal(int)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("colour_bar")
        self.setFont(tabular(smaller(self.font())))
        self._title = QLabel()
        self._title.setWordWrap(True)
        self._title.setTextFormat(Qt.TextFormat.PlainText)
        self._gradient = _Gradient()
        self._names = QLabel()
        self._names.setTextFormat(Qt.TextFormat.RichText)
        self._names.setAlignment(Qt.AlignmentFlag.AlignTop)
        self._names.setMinimumHeight(20)  # fits into small views
        self._names.linkActivated.connect(lambda number: self.material_clicked.emit(int(number)))
        self.swatches: list[QToolButton] = []
        self._layout = fill(
            QVBoxLayout(self), self._title, (self._gradient, 1), (self._names, 1), margins=(8, 8, 8, 4), spacing=4
        )
        self.show_colouring(Colouring("q(H)", 0.0, 1.0, COLOUR_MAPS[DEFAULT_MAP].table))
        on_theme_change(self._names, self._show_names)  # links have a colour of their own

    def show_colouring(self, colouring: Colouring, counts: Sequence[int] = ()) -> None:
        """Show a colouring, and the numbers of hexes with its special colours, by default none."""
        self._title.setText(tr(colouring.title))
        self._gradient.colouring = colouring
        self._gradient.setVisible(not colouring.names)
        self._gradient.update()
        self._show_names()
        kinds = colouring.special_colours
        while len(self.swatches) < len(kinds):
            self._add_swatch()
        for swatch, special, count in zip(self.swatches, kinds, counts or [0] * len(kinds), strict=False):
            _show_special(swatch, special, count)
        for number, swatch in enumerate(self.swatches):
            swatch.setVisible(number < len(kinds))
        self._describe()

    def _show_names(self) -> None:
        """Show the names of the materials, each as a link."""
        colouring, style = self._gradient.colouring, f"color: {TEXT}; text-decoration: none"
        rows = name_entries(colouring.names, colouring.table, _MAX_ROWS) if colouring.names else []
        self._names.setText("<br>".join(
            f'<a href="{at}" style="{style}"><span style="color: rgb{colour}">■</span> {escape(name)}</a>'
            if colour else escape(name)
            for at, (name, colour) in enumerate(rows)
        ))  # fmt: skip
        self._names.setVisible(bool(rows))

    def _add_swatch(self) -> None:
        """Add a button that isolates the hexes with its colour; it is disabled if there are none."""
        swatch, number = QToolButton(), len(self.swatches)
        set_variant(swatch, "small")
        swatch.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        swatch.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        swatch.setIconSize(QSize(_SWATCH, _SWATCH))
        swatch.clicked.connect(lambda: self.special_clicked.emit(self._gradient.colouring.special_colours[number].name))
        self._layout.addWidget(swatch)
        self.swatches.append(swatch)

    def ticks(self, length: float) -> list[float]:
        """Return the tick values for a gradient with a height in pixels."""
        return self._gradient.ticks(length)

    def _describe(self) -> None:
        colouring = self._gradient.colouring
        if colouring.names:
            help = tr(
                "Each material has a colour; a click on its name shows only its hexes. Inverted hexes are magenta, "
                "those that are invalid inside light magenta; both are outlined."
            )
            set_help(self, tr("Legend of materials"), help)
            self.setAccessibleDescription(tr("Materials: {names}", names=", ".join(colouring.names)))
            return
        low, high = colouring.label(colouring.low), colouring.label(colouring.high)
        label = self._title.text()
        set_help(
            self,
            tr("Colour bar"),
            tr(
                "Colours show {label} from {low} to {high}; values outside the range have the colour of the nearest "
                "end. Special colours: {names}. Inverted hexes have a corner with a determinant σ ≤ 0; those that are "
                "invalid inside have a negative Jacobian between positive corners. Both are outlined.",
                label=label,
                low=low,
                high=high,
                names=", ".join(tr(special.name) for special in colouring.special_colours),
            ),
        )
        texts = "; ".join(swatch.text() for swatch in self.swatches if not swatch.isHidden())
        self.setAccessibleDescription(
            tr("{texts}; {label} from {low} to {high}", texts=texts, label=label, low=low, high=high)
        )

    def sizeHint(self) -> QSize:
        """Return the width of the texts, and the default height."""
        title = min(self._title.fontMetrics().horizontalAdvance(self._title.text()) + 2, _MAX_TITLE)
        has_names = bool(self._gradient.colouring.names)
        legend = self._names if has_names else self._gradient
        widths = [title, legend.sizeHint().width()]
        widths += [swatch.sizeHint().width() for swatch in self.swatches if not swatch.isHidden()]
        margins = self._layout.contentsMargins()
        height = min(_HEIGHT, super().sizeHint().height()) if has_names else _HEIGHT
        return QSize(max(widths) + margins.left() + margins.right(), height)


class _Gradient(QWidget):
    """Gradient with the highest value at the top, and ticks on its right."""

    def __init__(self) -> None:
        super().__init__()
        self.colouring = Colouring("", 0.0, 1.0, np.zeros((1, 3), dtype=np.uint8))
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
        """Paint gradient, ticks and numbers."""
        colouring, painter = self.colouring, QPainter(self)
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


def _show_special(swatch: QToolButton, special: SpecialColour, count: int) -> None:
    """Show a special colour on a button, with the number of its hexes unless it is 0."""
    name = tr(special.name)
    text = f"{name} ({count:,})" if count else name
    if text == swatch.text():
        return
    swatch.setText(text)
    swatch.setEnabled(count > 0)
    picture, icon = QPixmap(_SWATCH, _SWATCH), QIcon()
    picture.fill(QColor(*special.colour))
    for mode in (QIcon.Mode.Normal, QIcon.Mode.Disabled):
        icon.addPixmap(picture, mode)
    swatch.setIcon(icon)
    set_help(swatch, tr("Isolate {name}", name=name), tr("Show only {name} hexes; Esc shows all again.", name=name))
    widest = f"{name} (00,000)" if count else name  # so that the layout does not change with the number
    swatch.setMinimumWidth(_SWATCH + 10 + swatch.fontMetrics().horizontalAdvance(widest))
