"""Plots in the style of the panels."""

from __future__ import annotations

import math
from collections.abc import Callable

import pyqtgraph as pg
from PySide6.QtCore import QPointF, Qt, Signal
from PySide6.QtWidgets import QFrame, QToolTip

from hexmend_app.theme.palette import LINE, MUTED
from hexmend_app.theme.style import on_theme_change, smaller, tabular


class MouseView(pg.ViewBox):
    """View that announces clicks and drags by their positions on the plot.

    Signals
    -------
    clicked(place, double)
    dragged(start, place)
    """

    clicked = Signal(QPointF, bool)
    dragged = Signal(QPointF, QPointF)

    def __init__(self):
        super().__init__(enableMenu=False, defaultPadding=0)

    def mouseDragEvent(self, ev, axis=None) -> None:
        """Announce a drag."""
        if ev.button() != Qt.MouseButton.LeftButton:
            ev.ignore()
            return
        ev.accept()
        self.dragged.emit(self.mapToView(ev.buttonDownPos()), self.mapToView(ev.pos()))

    def mouseClickEvent(self, ev) -> None:
        """Announce a click."""
        if ev.button() == Qt.MouseButton.LeftButton:
            ev.accept()
            self.clicked.emit(self.mapToView(ev.pos()), ev.double())

    def wheelEvent(self, ev, axis=None) -> None:
        """Leave the wheel to the parent, which scrolls."""
        ev.ignore()


def show_tooltips(plot: pg.PlotWidget, describe: Callable[[QPointF], str]) -> None:
    """Show the description of the position under the mouse as the tooltip of a plot."""

    def on_moved(place: QPointF) -> None:
        view = plot.getViewBox()
        text = describe(view.mapSceneToView(place)) if view.sceneBoundingRect().contains(place) else ""
        QToolTip.showText(plot.mapToGlobal(plot.mapFromScene(place)), text, plot)

    plot.scene().sigMouseMoved.connect(on_moved)


def calm_plot(view: pg.ViewBox | None = None) -> pg.PlotWidget:
    """Return a plot without buttons, menu, zooming and frame, with thin axes and a transparent background."""
    plot = pg.PlotWidget(background=None, viewBox=view or pg.ViewBox(enableMenu=False), enableMenu=False)
    plot.setFrameShape(QFrame.Shape.NoFrame)
    plot.hideButtons()
    plot.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # it has no keys
    plot.viewport().setFocusPolicy(Qt.FocusPolicy.NoFocus)
    plot.setMenuEnabled(False)
    plot.getViewBox().setMouseEnabled(x=False, y=False)
    plot.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    font = tabular(smaller(plot.font()))
    plot.getPlotItem().setContentsMargins(0, 0, 10, 0)  # half of the last text of the axis
    axes = [plot.getAxis("left"), plot.getAxis("bottom")]
    for axis in axes:
        axis.enableAutoSIPrefix(False)
        axis.setStyle(tickLength=4, tickTextOffset=3, hideOverlappingLabels=False, maxTickLevel=0)
        axis.setTickFont(font)
        axis.label.setFont(font)

    def paint() -> None:
        for axis in axes:
            axis.setPen(str(LINE))
            axis.setTickPen(str(LINE))
            axis.setTextPen(str(MUTED))
        plot.resetCachedContent()  # Qt caches the background

    on_theme_change(plot, paint)
    return plot


def log_ticks(low: int, high: float) -> list[tuple[float, str]]:
    """Return at most four powers of ten between two decimal logarithms, with their texts.

    >>> log_ticks(-1, 3.4)
    [(-1.0, '0.1'), (1.0, '10'), (3.0, '1,000')]
    """
    step = max(1, -(-(math.floor(high) - low) // 3))
    return [(float(k), f"{10.0**k:,g}") for k in range(low, math.floor(high) + 1, step)]
