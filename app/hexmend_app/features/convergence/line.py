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
    """Graphics of one quantity of one run, redrawn only where it has changed.

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
        self._style: tuple = ()
        self._subject: tuple = ()

    def draw(self, options: tuple[str, bool, Qt.PenStyle], subject: tuple, find: Callable) -> None:
        """Draw in a colour, strongly or not, in a style; `find` gives x and y of `what`."""
        if options != self._style:
            name, strong, style = options
            colour = QColor(name)
            colour.setAlphaF(1.0 if strong else 0.65)
            self.curve.setPen(pg.mkPen(colour, width=2.0 if strong else 1.0, style=style))
            self._points.setBrush(colour)
            self._points.setSize(5 if strong else 4)
            for item in self.items:
                item.setZValue(10 if strong else 0)
        if subject != self._subject:
            x, y = find()
            finite = np.isfinite(y)
            self.curve.setData(x, y) if finite.any() else self.curve.clear()
            few = len(x) <= _FEW
            self._points.setVisible(few)
            if few:
                self._points.setData(x[finite], y[finite])
        self._style, self._subject = options, subject
