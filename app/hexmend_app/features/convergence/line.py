"""The curve of one run in a chart: its colour, its line, and its points where they are few."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor

#: Points of which a curve is drawn at most: a thick line of a thousand takes longer to paint than all else.
MOST = 400

#: Points up to which each is marked, so that a run of one step is seen.
_FEW = 40


class _Points(pg.ScatterPlotItem):
    """Points that leave clicks to what is behind them."""

    def mouseClickEvent(self, ev) -> None:
        """Leave it."""
        ev.ignore()


class RunLine:
    """What one quantity of one run is drawn with, anew only where it has changed.

    Attributes
    ----------
    curve : pg.PlotCurveItem
    items : tuple
        All that is drawn.
    """

    def __init__(self) -> None:
        self.curve = pg.PlotCurveItem(connect="finite", skipFiniteCheck=False)
        self._points = _Points(pen=None)
        self.items = (self.curve, self._points)
        self._how: tuple = ()
        self._what: tuple = ()

    def draw(self, how: tuple[str, bool, Qt.PenStyle], what: tuple, find: Callable) -> None:
        """Draw in a colour, strongly or not, in a style; `find` gives x and y of `what`."""
        if how != self._how:
            name, strong, style = how
            colour = QColor(name)
            colour.setAlphaF(1.0 if strong else 0.65)
            self.curve.setPen(pg.mkPen(colour, width=2.0 if strong else 1.0, style=style))
            self._points.setBrush(colour)
            self._points.setSize(5 if strong else 4)
            for item in self.items:
                item.setZValue(10 if strong else 0)
        if what != self._what:
            x, y = find()
            finite = np.isfinite(y)
            self.curve.setData(x, y) if finite.any() else self.curve.clear()
            few = len(x) <= _FEW
            self._points.setVisible(few)
            if few:
                self._points.setData(x[finite], y[finite])
        self._how, self._what = how, what
