"""Plots in the style of the panels."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pyqtgraph as pg
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QFrame

from hexmend_app.theme.palette import LINE, MUTED, Role
from hexmend_app.theme.style import on_theme_change, smaller, tabular

#: Least distance of two tick texts of different colours, in pixels.
_TEXT_GAP = 4.0


class CalmAxis(pg.AxisItem):
    """Axis with thin lines and tabular digits; `colours` holds the colours of tick texts by text."""

    def __init__(self, orientation: str):
        super().__init__(orientation)
        self.colours: dict[str, Role] = {}
        self.enableAutoSIPrefix(False)
        self.setStyle(tickLength=4, tickTextOffset=3, hideOverlappingLabels=False, maxTickLevel=0)

    def paint_lines(self) -> None:
        """Apply the colours of the current theme."""
        self.setPen(str(LINE))
        self.setTickPen(str(LINE))
        self.setTextPen(str(MUTED))

    def drawPicture(self, p: QPainter, axisSpec: tuple, tickSpecs: list, textSpecs: list) -> None:
        """Draw the axis, then the tick texts that have a colour of their own, left of the next one."""
        coloured = [spec for spec in textSpecs if spec[2] in self.colours]
        others = [spec for spec in textSpecs if spec[2] not in self.colours]
        super().drawPicture(p, axisSpec, tickSpecs, others)
        for rect, flags, text in coloured:
            p.setPen(pg.mkPen(str(self.colours[text])))
            p.drawText(left_of_next(rect, [other for other, *_ in others]), int(flags), text)


def left_of_next(rect: QRectF, others: Sequence[QRectF]) -> QRectF:
    """Move the rectangle of a text to the left until it is clear of the rectangles to its right."""
    following = [other.left() for other in others if other.center().x() > rect.center().x()]
    excess = rect.right() + _TEXT_GAP - min(following, default=math.inf)
    return rect.translated(-max(excess, 0.0), 0.0)


def calm_plot(view: pg.ViewBox | None = None) -> pg.PlotWidget:
    """Return a plot without buttons, menu, zooming and frame, with a transparent background."""
    axes = {"left": CalmAxis("left"), "bottom": CalmAxis("bottom")}
    plot = pg.PlotWidget(
        background=None, viewBox=view or pg.ViewBox(enableMenu=False), axisItems=axes, enableMenu=False
    )
    plot.setFrameShape(QFrame.Shape.NoFrame)
    plot.hideButtons()
    plot.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # it has no keys
    plot.viewport().setFocusPolicy(Qt.FocusPolicy.NoFocus)
    plot.setMenuEnabled(False)
    plot.getViewBox().setMouseEnabled(x=False, y=False)
    plot.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    font = tabular(smaller(plot.font()))
    for axis in axes.values():
        axis.setTickFont(font)
        on_theme_change(plot, axis.paint_lines)
    on_theme_change(plot, plot.resetCachedContent)  # Qt caches the background
    return plot


def log_ticks(low: int, high: float) -> list[tuple[float, str]]:
    """Return at most four powers of ten between two decimal logarithms, with their texts.

    >>> log_ticks(-1, 3.4)
    [(-1.0, '0.1'), (1.0, '10'), (3.0, '1,000')]
    """
    step = max(1, -(-(math.floor(high) - low) // 3))
    return [(float(k), f"{10.0**k:,g}") for k in range(low, math.floor(high) + 1, step)]
