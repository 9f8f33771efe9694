"""One distribution as it is drawn: an outline over the bins, and bars beside them that are broken where too tall."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF
from PySide6.QtGui import QPainterPath, QPolygonF
from PySide6.QtWidgets import QGraphicsPathItem

from hexmend_app.features.histogram.bins import Distribution
from hexmend_app.theme.palette import Role
from hexmend_app.theme.style import INVERTED

#: Of the height of the axis: where a broken bar ends, where its gap is, how wide that is, and how tall its teeth.
BROKEN, _GAP_AT, _GAP, _TOOTH = 1.08, 0.88, 0.05, 0.03
_TEETH = 4


@dataclass(frozen=True, eq=False)
class Series:
    """A distribution as it is drawn: filled under its outline or not, in a colour; `key` tells it from the others."""

    key: str
    name: str
    colour: Role
    part: Distribution
    filled: bool = False
    current: bool = False


@dataclass(frozen=True)
class Heights:
    """Return the positions of counts on the axis of counts, or of shares in percent.

    Parameters
    ----------
    floor, top : float
        Of the axis, as places.
    log, cumulative : bool
    """

    floor: float = 0.0
    top: float = 1.0
    log: bool = False
    cumulative: bool = False

    def of(self, part: Distribution, counts: np.ndarray | int) -> np.ndarray:
        """Places of counts of a distribution."""
        heights = np.asarray(counts, dtype=float)
        if self.cumulative:
            heights = heights * (100 / max(part.total, 1))
        if self.log:
            heights = np.log10(np.maximum(heights, 0.5 * self.least(part)))
        return heights

    def least(self, part: Distribution) -> float:
        """One element, as it is counted."""
        return 100 / max(part.total, 1) if self.cumulative else 1.0

    def share(self, share: float) -> float:
        """The place at a share of the axis."""
        return self.floor + share * (self.top - self.floor)

    def bar(self, part: Distribution, count: int) -> tuple[float, bool]:
        """Return the height of an end bar, and True if it is broken because its count exceeds the axis."""
        height = float(self.of(part, count))
        broken = height > self.top * (1 + 1e-9)
        return (self.share(BROKEN) if broken else height), broken


class Outline:
    """The items of one distribution."""

    def __init__(self) -> None:
        self.curve = pg.PlotCurveItem()
        self.bar, self.ends = QGraphicsPathItem(), QGraphicsPathItem()
        self.items = (self.curve, self.bar, self.ends)
        self._drawn: tuple | None = None

    def forget(self) -> None:
        """Draw anew next time, though nothing but the colours has changed."""
        self._drawn = None

    def draw(self, at: int, series: Series, heights: Heights) -> None:
        """Show a distribution as the `at`-th."""
        # During a run only the distribution now changes.
        if self._drawn is not None and self._drawn[0] is series.part and self._drawn[1:] == (at, heights):
            return
        self._drawn = (series.part, at, heights)
        colour = str(series.colour)
        part = series.part.cumulated() if heights.cumulative else series.part
        filled = series.filled and not heights.cumulative  # shares of all fill the whole plot and hide each other
        width = 1.0 if filled else 1.8
        pen = pg.mkPen(colour, width=width)
        brush = pg.mkBrush(colour + ("70" if series.current else "50")) if filled else None
        curve = heights.of(part, part.counts)
        self.curve.setData(
            np.linspace(0, 1, len(curve) + 1),
            curve,
            stepMode="center",
            pen=pen,
            fillLevel=heights.floor if filled else None,
            brush=brush,
        )
        own = INVERTED if series.current else colour
        bars = [(part.axis.inverted, part.inverted)]
        _show(self.bar, bars, part, heights, pg.mkPen(own, width=width), pg.mkBrush(own + "70") if filled else None)
        ends = [(part.axis.below, part.below), (part.axis.above, part.above)]
        _show(self.ends, ends, part, heights, pen, brush)
        for item in self.items:
            item.setZValue(at)


def _show(item: QGraphicsPathItem, bars: list, part: Distribution, heights: Heights, pen, brush) -> None:
    path = QPainterPath()
    for place, count in bars:
        if place is not None and count > 0:
            _add_bar(path, *place, *heights.bar(part, count), heights)
    item.setVisible(not path.isEmpty())
    item.setPath(path)
    item.setPen(pen)
    item.setBrush(brush or pg.mkBrush(None))


def _add_bar(path: QPainterPath, left: float, right: float, top: float, broken: bool, heights: Heights) -> None:
    """A rectangle, or two whose ends that face each other are teeth."""
    if not broken:
        path.addRect(left, heights.floor, right - left, top - heights.floor)
        return
    for side, end in ((-1, heights.floor), (1, top)):
        near = heights.share(_GAP_AT + side * _GAP / 2)
        far = heights.share(_GAP_AT + side * _GAP / 2 - _TOOTH)
        teeth = [
            QPointF(left + (right - left) * k / (2 * _TEETH), far if k % 2 else near) for k in range(2 * _TEETH + 1)
        ]
        path.addPolygon(QPolygonF([QPointF(left, end), *teeth, QPointF(right, end), QPointF(left, end)]))
