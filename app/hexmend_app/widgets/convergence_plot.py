"""One small chart of a run's figures against its iterations, of several runs over one another."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend_app.state.convergence import Chart, Curve, Quantity, thinned
from hexmend_app.state.history import Record
from hexmend_app.state.theme import TEXT, Role
from hexmend_app.widgets.colour_bar import nice_ticks
from hexmend_app.widgets.histogram_legend import KEPT_COLOURS
from hexmend_app.widgets.plots import calm_plot
from hexmend_app.widgets.style import BLUE, dress, explain, note, smaller

#: Colours of runs, by slot; after the last, the first again.
RUN_COLOURS = (BLUE, *KEPT_COLOURS)

_STYLES = (Qt.PenStyle.SolidLine, Qt.PenStyle.DashLine)
_DASHES = ("—", "- -")

#: Points up to which each is marked, so that a run of one step is seen, and points of which a curve is drawn at most: a
#: thick line of a thousand takes longer to paint than all else.
_FEW, _MOST = 40, 400

#: Pixels from a curve within which a click means it rather than the run that is gone through.
_REACH = 12

_LEAST_HEIGHT = 46
_HELP = "Click or drag in the chart to go to an iteration."


class _PickView(pg.ViewBox):
    """Tells where it is clicked and where a drag goes."""

    picked = Signal(QPointF, bool)

    def __init__(self):
        super().__init__(enableMenu=False, defaultPadding=0)

    def mouseClickEvent(self, ev) -> None:
        """Tell where."""
        if ev.button() == Qt.MouseButton.LeftButton:
            ev.accept()
            self.picked.emit(ev.scenePos(), True)

    def mouseDragEvent(self, ev, axis=None) -> None:
        """Tell where it goes."""
        if ev.button() != Qt.MouseButton.LeftButton:
            ev.ignore()
            return
        ev.accept()
        self.picked.emit(ev.scenePos(), ev.isStart())

    def wheelEvent(self, ev, axis=None) -> None:
        """Leave the wheel to the panel, which scrolls."""
        ev.ignore()


class ConvergencePlot(QWidget):
    """Draws one chart; which iterations there are and where they lie it is told.

    Parameters
    ----------
    chart : Chart

    Signals
    -------
    picked(Record, number)
        The user clicked at an iteration, or dragged there.
    hovered(QPointF or None)
        The mouse is over a place of `plot`'s scene.
    """

    picked = Signal(object, int)
    hovered = Signal(object)

    def __init__(self, chart: Chart, parent: QWidget | None = None):
        super().__init__(parent)
        self.chart = chart
        self.view = _PickView()
        self.plot = calm_plot(self.view)
        self.plot.setMinimumHeight(_LEAST_HEIGHT)
        self.plot.setAccessibleName(f"Chart of {chart.title}")
        self.plot.setAccessibleDescription(f"{chart.help} {_HELP}")
        self.plot.setWhatsThis(f"{chart.help} {_HELP}")
        self.title = note()
        self.title.setWordWrap(False)
        explain(self.title, chart.title, f"{chart.help} {_HELP}")
        self._mark = pg.InfiniteLine(0, movable=False)
        self._mark.setZValue(20)
        self.plot.addItem(self._mark, ignoreBounds=True)
        self.plot.getAxis("bottom").setStyle(showValues=False)
        self.plot.getAxis("bottom").label.setFont(smaller(self.font()))
        self._lines: dict[tuple[int, str], _Line] = {}
        self._curves: Sequence[Curve] = ()
        self._by_time = self._log = False
        self._held: Record | None = None  # whose curve a drag has hold of
        self._floor: float | None = None  # where zero is drawn on an axis of powers of ten
        self._scale: tuple | None = None
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(self.title)
        layout.addWidget(self.plot, 1)
        self.view.picked.connect(self._on_picked)
        self.plot.scene().sigMouseMoved.connect(self._on_moved)
        dress(self, self._paint)

    def _paint(self) -> None:
        self._mark.setPen(pg.mkPen(str(TEXT), width=1))
        self.draw(self._curves, self._by_time, self._log)

    # What is drawn

    def draw(self, curves: Sequence[Curve], by_time: bool, log: bool) -> None:
        """Draw runs against iterations or seconds, figures by powers of ten where that says more."""
        self._curves, self._by_time, self._log = [one for one in curves if one.shown], by_time, log
        self._fit()
        wanted = {(curve.slot, quantity.key) for curve in self._curves for quantity in self.chart.quantities}
        for key in self._lines.keys() - wanted:
            for item in self._lines.pop(key).items:
                self.plot.removeItem(item)
        for curve in self._curves:
            for style, quantity in zip(_STYLES, self.chart.quantities, strict=False):
                self._draw_curve(curve, quantity, style)
        self.title.setText(self._words())

    def _draw_curve(self, curve: Curve, quantity: Quantity, style: Qt.PenStyle) -> None:
        line = self._lines.get((curve.slot, quantity.key))
        if line is None:
            line = self._lines[curve.slot, quantity.key] = _Line()
            for item in line.items:
                self.plot.addItem(item, ignoreBounds=True)
        how = (str(colour_of(curve)), curve.current, style)
        what = (curve.record, len(curve.columns), curve.begins, self._by_time, self.is_log, self._floor)
        line.draw(
            how, what, lambda: thinned(curve.x(self._by_time), self.heights(curve.columns.of(quantity.key)), _MOST)
        )

    def heights(self, values: np.ndarray) -> np.ndarray:
        """Where values lie on the axis."""
        if not self.is_log:
            return values
        with np.errstate(divide="ignore", invalid="ignore"):
            heights = np.log10(values)
        if self._floor is not None:
            heights[values <= 0] = self._floor
        return heights

    @property
    def is_log(self) -> bool:
        """Whether the axis goes by powers of ten."""
        return self._log and self.chart.quantities[0].log

    def mark(self, x: float | None) -> None:
        """Draw the line of the iteration that is shown; None for none."""
        self._mark.setVisible(x is not None)
        if x is not None:
            self._mark.setValue(x)

    def set_span(self, low: float, high: float) -> None:
        """Take the ends of the axis that all charts share."""
        self.plot.setXRange(low, high, padding=0)

    def set_foot(self, label: str | None, ticks: list[tuple[float, str]], left: int) -> None:
        """Take ticks below and what they count, None where another chart below says so, and the room at the left."""
        bottom = self.plot.getAxis("bottom")
        bottom.setTicks([ticks])
        bottom.setStyle(showValues=label is not None)
        bottom.showLabel(label is not None)
        line = self.fontMetrics().height()
        if label is not None:
            bottom.setLabel(label)
        bottom.setHeight(2 * line if label is not None else 5)
        self.plot.setMinimumHeight(_LEAST_HEIGHT + (2 * line if label is not None else 0))
        self.plot.getAxis("left").setWidth(left)
        bottom.resizeEvent()

    def _fit(self) -> None:
        """Let the axis of figures reach as far as they do, in steps, so that it seldom changes."""
        parts = [curve.columns.of(one.key) for curve in self._curves for one in self.chart.quantities]
        known = np.concatenate([*parts, np.empty(0)])
        known = known[np.isfinite(known)]
        scale = self._powers(known) if self.is_log else self._plain(known)
        if scale != self._scale:
            self._scale = scale
            (low, high), ticks = scale[:2]
            self.plot.getAxis("left").setTicks([list(ticks)])
            self.plot.setYRange(low, high, padding=0.08)

    def _plain(self, known: np.ndarray) -> tuple:
        self._floor = None
        if self.chart.key == "quality":
            return (0.0, 1.0), ((0.0, "0"), (0.5, "0.5"), (1.0, "1"))
        top = float(known.max()) if known.size else 1.0
        high = _round_up(top if top > 0 else 1.0)
        ticks = nice_ticks(0, high, 3)
        if self.chart.quantities[0].whole:
            ticks = [tick for tick in ticks if tick == round(tick)]
        return (0.0, high), tuple((tick, f"{tick:,.4g}") for tick in ticks)

    def _powers(self, known: np.ndarray) -> tuple:
        above = known[known > 0]
        low, high = (math.floor(math.log10(above.min())), math.log10(above.max())) if above.size else (0, 1)
        high = max(math.ceil(4 * high) / 4, low + 1)
        least = 0 if self.chart.quantities[0].whole else low
        self._floor = float(least - 1) if (known <= 0).any() else None
        step = max(1, -(-(math.floor(high) - low + (self._floor is not None)) // 2))
        ticks = [(float(k), _power(k)) for k in range(math.floor(high), low - 1, -step)]
        if self._floor is not None:
            ticks = [tick for tick in ticks if tick[0] - self._floor > 0.2 * (high - self._floor)]
            ticks.append((self._floor, "0"))
        return (float(low) if self._floor is None else self._floor, high), tuple(ticks)

    def _words(self) -> str:
        quantities = self.chart.quantities
        if len(quantities) > 1:
            text = ", ".join(f"{one.title} {dash}" for one, dash in zip(quantities, _DASHES, strict=False))
        else:
            text = self.chart.title
        silent = [one.record.name for one in self._curves if not any(one.columns.told(each.key) for each in quantities)]
        if silent:
            several = len(silent) > 1
            text += f": {' and '.join(silent)} {'do' if several else 'does'} not tell this"
        return text

    # Under the mouse

    def at(self, place: QPointF) -> tuple[Curve, int] | None:
        """The run and the iteration that a place of the scene means; None where nothing is drawn."""
        if not self._curves:
            return None
        here = self.view.mapSceneToView(place)
        wide, high = self.view.viewPixelSize()
        best, least = None, _REACH
        for curve in self._curves:
            number = curve.nearest(here.x(), self._by_time)
            for quantity in self.chart.quantities:
                y = self.heights(curve.columns.of(quantity.key)[number : number + 1])[0]
                x = curve.x(self._by_time)[number]
                away = math.hypot((x - here.x()) / wide, (y - here.y()) / high)
                if away < least:
                    best, least = (curve, number), away
        if best is None:
            curve = next((one for one in self._curves if one.current), self._curves[0])
            best = curve, curve.nearest(here.x(), self._by_time)
        return best

    def _on_picked(self, place: QPointF, begins: bool) -> None:
        found = self.at(place)
        if begins:
            self._held = None if found is None else found[0].record
        held = next((one for one in self._curves if one.record is self._held), None)
        if held is not None:
            self.picked.emit(held.record, held.nearest(self.view.mapSceneToView(place).x(), self._by_time))

    def _on_moved(self, place: QPointF) -> None:
        self.hovered.emit(place if self.view.sceneBoundingRect().contains(place) else None)


class _Points(pg.ScatterPlotItem):
    """Points that leave clicks to what is behind them."""

    def mouseClickEvent(self, ev) -> None:
        """Leave it."""
        ev.ignore()


class _Line:
    """What one quantity of one run is drawn with, anew only where it has changed."""

    def __init__(self) -> None:
        self._curve = pg.PlotCurveItem(connect="finite", skipFiniteCheck=False)
        self._points = _Points(pen=None)
        self.items = (self._curve, self._points)
        self._how: tuple = ()
        self._what: tuple = ()

    def draw(self, how: tuple[str, bool, Qt.PenStyle], what: tuple, find: Callable) -> None:
        """Draw in a colour, strongly or not, in a style; `find` gives x and y of `what`."""
        if how != self._how:
            name, strong, style = how
            colour = QColor(name)
            colour.setAlphaF(1.0 if strong else 0.65)
            self._curve.setPen(pg.mkPen(colour, width=2.0 if strong else 1.0, style=style))
            self._points.setBrush(colour)
            self._points.setSize(5 if strong else 4)
            for item in self.items:
                item.setZValue(10 if strong else 0)
        if what != self._what:
            x, y = find()
            finite = np.isfinite(y)
            self._curve.setData(x, y) if finite.any() else self._curve.clear()
            few = len(x) <= _FEW
            self._points.setVisible(few)
            if few:
                self._points.setData(x[finite], y[finite])
        self._how, self._what = how, what


def colour_of(curve: Curve) -> Role:
    """The colour of a run."""
    return RUN_COLOURS[curve.slot % len(RUN_COLOURS)]


def _round_up(value: float) -> float:
    """1, 1.5, 2, 3, 5 or 7 times a power of ten, at least `value`.

    >>> _round_up(0.8), _round_up(1.2), _round_up(640)
    (1.0, 1.5, 700.0)
    """
    power = 10.0 ** math.floor(math.log10(value))
    return next(m * power for m in (1, 1.5, 2, 3, 5, 7, 10) if m * power >= value * (1 - 1e-9))


def _power(exponent: int) -> str:
    """A power of ten as it is read most easily.

    >>> _power(3), _power(-1), _power(-7)
    ('1,000', '0.1', '1e−7')
    """
    return f"{10.0**exponent:,g}" if -3 <= exponent <= 4 else f"1e{exponent}".replace("-", "−")
