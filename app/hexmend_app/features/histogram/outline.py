"""Graphics items of one distribution: an outline over the bins, and separate bars, broken if they are too tall."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF
from PySide6.QtGui import QBrush, QLinearGradient, QPainterPath, QPolygonF
from PySide6.QtWidgets import QGraphicsPathItem

from hexmend_app.features.histogram.bins import Distribution
from hexmend_app.theme.palette import INVERTED, Role

#: Top of a broken bar, position and width of its gap, and height of the teeth, as fractions of the axis.
BROKEN_TOP, _GAP_AT, _GAP, _TOOTH = 1.08, 0.88, 0.05, 0.03
_TEETH = 4


#: Colours (#rrggbb) by their position on the axis of values, from 0 to 1.
Gradient = tuple[tuple[float, str], ...]


@dataclass(frozen=True, eq=False)
class Series:
    """A distribution with its name and style.

    Parameters
    ----------
    key : str
        Identifies it among the series of a plot.
    name : str
    colour : Role
    distribution : Distribution
    filled : bool
        True if the area below the outline is filled.
    current : bool
        True for the distribution of now.
    gradient : tuple of (float, str)
        Colours of the filled area by their position on the axis, from 0 to 1; by default `colour`.
    """

    key: str
    name: str
    colour: Role
    distribution: Distribution
    filled: bool = False
    current: bool = False
    gradient: Gradient = ()


@dataclass(frozen=True)
class Heights:
    """Axis of counts, or of shares in percent.

    Parameters
    ----------
    floor, top : float
        Heights of its ends on the plot; on a logarithmic axis, powers of ten.
    log, cumulative : bool
    """

    floor: float = 0.0
    top: float = 1.0
    log: bool = False
    cumulative: bool = False

    def of(self, distribution: Distribution, counts: np.ndarray | int) -> np.ndarray:
        """Return the heights of counts of a distribution."""
        heights = np.asarray(counts, dtype=float)
        if self.cumulative:
            heights = heights * self.one_hex(distribution)
        if self.log:
            heights = np.log10(np.maximum(heights, 0.5 * self.one_hex(distribution)))
        return heights

    def one_hex(self, distribution: Distribution) -> float:
        """Return the count of one hex, 1, or its share in percent."""
        return 100 / max(distribution.total, 1) if self.cumulative else 1.0

    def at_fraction(self, fraction: float) -> float:
        """Return the height at a fraction of the axis."""
        return self.floor + fraction * (self.top - self.floor)

    def bar(self, distribution: Distribution, count: int) -> tuple[float, bool]:
        """Return the height of a separate bar, and True if it is broken because its count exceeds the axis."""
        height = float(self.of(distribution, count))
        broken = height > self.top * (1 + 1e-9)
        return (self.at_fraction(BROKEN_TOP) if broken else height), broken


class Outline:
    """Graphics items of one distribution."""

    def __init__(self) -> None:
        self.curve = pg.PlotCurveItem()
        self.bar, self.ends = QGraphicsPathItem(), QGraphicsPathItem()
        self.items = (self.curve, self.bar, self.ends)
        self._drawn: tuple | None = None

    def forget(self) -> None:
        """Draw again at the next call of `draw`, even if only the colours have changed."""
        self._drawn = None

    def draw(self, layer: int, series: Series, heights: Heights) -> None:
        """Draw a distribution in a layer; higher layers are drawn over lower ones."""
        # During a run, only the distribution of now changes.
        style = (layer, heights, series.filled, series.gradient)
        if self._drawn is not None and self._drawn[0] is series.distribution and self._drawn[1:] == style:
            return
        self._drawn = (series.distribution, *style)
        colour = str(series.colour)
        shown = series.distribution.cumulated() if heights.cumulative else series.distribution
        filled = series.filled and not heights.cumulative  # filled cumulative shares would hide each other
        width = 1.0 if filled else 1.8
        pen = pg.mkPen(colour, width=width)
        brush = _brush(series) if filled else None
        curve = heights.of(shown, shown.counts)
        self.curve.setData(
            np.linspace(0, 1, len(curve) + 1),
            curve,
            stepMode="center",
            pen=pen,
            fillLevel=heights.floor if filled else None,
            brush=brush,
        )
        bar_colour = INVERTED if series.current else colour
        bar_brush = pg.mkBrush(bar_colour + "70") if filled else None
        bars = [(shown.axis.inverted, shown.inverted)]
        _draw_bars(self.bar, bars, shown, heights, pg.mkPen(bar_colour, width=width), bar_brush)
        bars = [(shown.axis.below, shown.below), (shown.axis.above, shown.above)]
        _draw_bars(self.ends, bars, shown, heights, pen, brush)
        for item in self.items:
            item.setZValue(layer)


def _brush(series: Series) -> QBrush:
    """Return the brush of the area below an outline."""
    if not series.gradient:
        return pg.mkBrush(str(series.colour) + ("70" if series.current else "50"))
    gradient = QLinearGradient(0.0, 0.0, 1.0, 0.0)
    for position, colour in series.gradient:
        gradient.setColorAt(position, colour)
    return QBrush(gradient)


def _draw_bars(item: QGraphicsPathItem, bars: list, distribution: Distribution, heights: Heights, pen, brush) -> None:
    """Draw bars, given as (span on the plot or None, count)."""
    path = QPainterPath()
    for span, count in bars:
        if span is not None and count > 0:
            _add_bar(path, span[0], span[1], *heights.bar(distribution, count), heights)
    item.setVisible(not path.isEmpty())
    item.setPath(path)
    item.setPen(pen)
    item.setBrush(brush or pg.mkBrush(None))


def _add_bar(path: QPainterPath, left: float, right: float, top: float, broken: bool, heights: Heights) -> None:
    """Add a rectangle to a path; a broken bar is two rectangles with teeth at the gap."""
    if not broken:
        path.addRect(left, heights.floor, right - left, top - heights.floor)
        return
    for side, end in ((-1, heights.floor), (1, top)):
        near = heights.at_fraction(_GAP_AT + side * _GAP / 2)
        far = heights.at_fraction(_GAP_AT + side * _GAP / 2 - _TOOTH)
        teeth = [
            QPointF(left + (right - left) * k / (2 * _TEETH), far if k % 2 else near) for k in range(2 * _TEETH + 1)
        ]
        path.addPolygon(QPolygonF([QPointF(left, end), *teeth, QPointF(right, end), QPointF(left, end)]))
