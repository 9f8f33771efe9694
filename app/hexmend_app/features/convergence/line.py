"""Graphics of one run in a chart: a line, and markers if there are few points."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor

#: Largest number of points drawn in a curve; thick lines of a thousand points paint slowly.
MAX_POINTS = 400

#: Largest number of points that get markers, without which a run of one step is invisible.
_MAX_MARKERS = 40


class _Points(pg.ScatterPlotItem):
    """Markers that pass clicks on to the chart."""

    def mouseClickEvent(self, ev) -> None:
        """Ignore the event."""
        ev.ignore()


class RunLine:
    """Graphics of one quantity of one run, updated only if it changed.

    Attributes
    ----------
    curve : pg.PlotCurveItem
    items : tuple
        All graphics items: the curve and its markers.
    """

    def __init__(self) -> None:
        self.curve = pg.PlotCurveItem(connect="finite", skipFiniteCheck=False)
        self._points = _Points(pen=None)
        self.items = (self.curve, self._points)
        self._style: tuple = ()
        self._version: tuple = ()

    def draw(self, style: tuple[str, bool, Qt.PenStyle], version: tuple, points: Callable) -> None:
        """Draw the curve.

        Parameters
        ----------
        style : (colour, bold, pen style)
        version : tuple
            Identifies the points; an equal one skips the update.
        points : callable
            Returns x and y, (k,) float64; nan in y is a gap.
        """
        if style != self._style:
            name, bold, pen_style = style
            colour = QColor(name)
            colour.setAlphaF(1.0 if bold else 0.65)
            self.curve.setPen(pg.mkPen(colour, width=2.0 if bold else 1.0, style=pen_style))
            self._points.setBrush(colour)
            self._points.setSize(5 if bold else 4)
            for item in self.items:
                item.setZValue(10 if bold else 0)
        if version != self._version:
            x, y = points()
            finite = np.isfinite(y)
            self.curve.setData(x, y) if finite.any() else self.curve.clear()
            marked = len(x) <= _MAX_MARKERS
            self._points.setVisible(marked)
            if marked:
                self._points.setData(x[finite], y[finite])
        self._style, self._version = style, version
