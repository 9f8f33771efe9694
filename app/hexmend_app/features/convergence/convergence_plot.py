"""One small chart of a run's figures against its iterations, of several runs over one another."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, Qt, Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend_app.features.convergence.axis import UNIT, Scale, powers, simple
from hexmend_app.features.convergence.charts import Chart, Quantity
from hexmend_app.features.convergence.curves import Curve, colour_of, thinned
from hexmend_app.features.convergence.line import MOST, RunLine
from hexmend_app.features.convergence.point_texts import reason_if_blank, titled
from hexmend_app.state.mesh.history import RunRecord
from hexmend_app.theme.palette import TEXT
from hexmend_app.theme.style import note, on_theme_change, set_help, smaller
from hexmend_app.widgets.plots import calm_plot

_STYLES = (Qt.PenStyle.SolidLine, Qt.PenStyle.DashLine)
_DASHES = ("—", "- -")

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
    """Draws one chart; its owner sets the iterations and their positions.

    Attributes
    ----------
    here : pg.InfiniteLine
        Stands at the iteration shown.
    lines : dict
        The `RunLine`s, by a run's slot and the quantity.
    scale : Scale or None
        Of the figures: its ends and its ticks.

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
        set_help(self.title, chart.title, f"{chart.help} {_HELP}")
        self._blank = note()
        self._blank.setAccessibleName(f"Why the chart of {chart.title} is blank")
        self._blank.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._blank.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        QVBoxLayout(self.plot).addWidget(self._blank)
        self.here = pg.InfiniteLine(0, movable=False)
        self.here.setZValue(20)
        self.plot.addItem(self.here, ignoreBounds=True)
        self.plot.getAxis("bottom").setStyle(showValues=False)
        self.plot.getAxis("bottom").label.setFont(smaller(self.font()))
        self.lines: dict[tuple[int, str], RunLine] = {}
        self._curves: Sequence[Curve] = ()
        self._by_time = self._log = False
        self._dragged_record: RunRecord | None = None  # whose curve is dragged
        self.scale = Scale(0.0, 0.0, ())
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(self.title)
        layout.addWidget(self.plot, 1)
        self.view.picked.connect(self._on_picked)
        self.plot.scene().sigMouseMoved.connect(self._on_moved)
        on_theme_change(self, self._paint)

    def _paint(self) -> None:
        self.here.setPen(pg.mkPen(str(TEXT), width=1))
        self.draw(self._curves, self._by_time, self._log)

    # What is drawn

    def draw(self, curves: Sequence[Curve], by_time: bool, log: bool) -> None:
        """Draw runs against iterations or seconds, figures by powers of ten where that says more."""
        self._curves, self._by_time, self._log = [one for one in curves if one.shown], by_time, log
        self._fit()
        wanted = {(curve.slot, quantity.key) for curve in self._curves for quantity in self.chart.quantities}
        for key in self.lines.keys() - wanted:
            for item in self.lines.pop(key).items:
                self.plot.removeItem(item)
        for curve in self._curves:
            for style, quantity in zip(_STYLES, self.chart.quantities, strict=False):
                self._draw_curve(curve, quantity, style)
        self.title.setText(titled(self.chart, curves, _DASHES))
        self._blank.setText(reason_if_blank(self.chart, curves))

    def _draw_curve(self, curve: Curve, quantity: Quantity, style: Qt.PenStyle) -> None:
        line = self.lines.get((curve.slot, quantity.key))
        if line is None:
            line = self.lines[curve.slot, quantity.key] = RunLine()
            for item in line.items:
                self.plot.addItem(item, ignoreBounds=True)
        options = (str(colour_of(curve)), curve.current, style)
        subject = (curve.record, len(curve.columns), curve.begins, self._by_time, self.is_log, self.scale.floor)
        line.draw(options, subject, lambda: self._line(curve, quantity))

    def _line(self, curve: Curve, quantity: Quantity) -> tuple[np.ndarray, np.ndarray]:
        x, y = curve.drawn(quantity.key, self._by_time)
        return thinned(x, self.heights(y), MOST)

    def heights(self, values: np.ndarray) -> np.ndarray:
        """Return the positions of values on the axis."""
        if not self.is_log:
            return values
        with np.errstate(divide="ignore", invalid="ignore"):
            heights = np.log10(values)
        if self.scale.floor is not None:
            heights[values <= 0] = self.scale.floor
        return heights

    @property
    def is_log(self) -> bool:
        """Return True if the axis is logarithmic."""
        return self._log and self.chart.quantities[0].log

    def mark(self, x: float | None) -> None:
        """Draw the line of the iteration that is shown; None for none."""
        self.here.setVisible(x is not None)
        if x is not None:
            self.here.setValue(x)

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
        """Let the axis of figures reach as far as they do."""
        parts = [curve.columns.of(one.key) for curve in self._curves for one in self.chart.quantities]
        known = np.concatenate([*parts, np.empty(0)])
        known, whole = known[np.isfinite(known)], self.chart.quantities[0].whole
        scale = UNIT if self.chart.key == "quality" else (powers if self.is_log else simple)(known, whole)
        if scale != self.scale:
            self.scale = scale
            self.plot.getAxis("left").setTicks([list(scale.ticks)])
            self.plot.setYRange(scale.low, scale.high, padding=0.08)

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
            self._dragged_record = None if found is None else found[0].record
        dragged = next((one for one in self._curves if one.record is self._dragged_record), None)
        if dragged is not None:
            self.picked.emit(dragged.record, dragged.nearest(self.view.mapSceneToView(place).x(), self._by_time))

    def _on_moved(self, place: QPointF) -> None:
        self.hovered.emit(place if self.view.sceneBoundingRect().contains(place) else None)
