"""Chart of one to three quantities of several runs against iterations or seconds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

import numpy as np
import pyqtgraph as pg
from pyqtgraph.GraphicsScene.mouseEvents import MouseClickEvent
from PySide6.QtCore import QPointF, Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend_app.features.convergence.curves import Chart, Curve, described
from hexmend_app.report.convergence import DASHES, Line, LineChart
from hexmend_app.state.mesh.run_record import RecordedIteration, RunRecord, balances
from hexmend_app.theme.palette import MUTED, TEXT
from hexmend_app.theme.spacing import apply_spacing, fill
from hexmend_app.theme.style import on_theme_change, set_help, small_label, smaller, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.plots import MouseView, calm_plot, log_ticks, show_tooltips
from hexmend_app.widgets.wording import counted, figure

_STYLES = dict(zip(DASHES, (Qt.PenStyle.SolidLine, Qt.PenStyle.DashLine, Qt.PenStyle.DotLine), strict=True))
_DASHES = ("—", "- -", "···")
#: Width of the strip along a curve in which a click selects it, in pixels; elsewhere the current run is selected.
_PICK_WIDTH = 8
_MIN_HEIGHT = 80
#: Largest number of points that get markers, without which a run of one step is invisible.
_MAX_MARKERS = 40
#: Smallest upper end of a linear axis of whole numbers, so that its ticks are whole.
_LEAST_WHOLE = 5.0
_HELP = "Click or drag in the chart to go to an iteration."


class ConvergencePlot(QWidget):
    """Widget that draws one chart; the panel sets its axis.

    Attributes
    ----------
    marker : pg.InfiniteLine
        At the iteration shown in the view.
    lines : list of pg.PlotDataItem
        Those of the runs that are drawn.
    zero : float or None
        Position of zero on a logarithmic axis; None if no value is zero.

    Parameters
    ----------
    chart : Chart

    Signals
    -------
    picked(RunRecord, number)
        The user clicked or dragged to an iteration.
    """

    picked = Signal(object, int)

    def __init__(self, chart: Chart, parent: QWidget | None = None):
        super().__init__(parent)
        self.chart = chart
        self.view = MouseView()
        self.plot = calm_plot(self.view)
        self.plot.setMinimumHeight(_MIN_HEIGHT)
        self.plot.getAxis("bottom").setHeight(2 * self.fontMetrics().height())
        self.plot.getAxis("left").setWidth(self.fontMetrics().horizontalAdvance("000,000"))
        help = f"{tr(chart.help)} {tr(_HELP)}"
        self.plot.setAccessibleName(tr("Chart of {title}", title=tr(chart.title)))
        self.plot.setAccessibleDescription(help)
        self.plot.setWhatsThis(help)
        title = tr(chart.title)
        if len(chart.quantities) > 1:
            title = ", ".join(f"{tr(one.label)} {dash}" for one, dash in zip(chart.quantities, _DASHES, strict=False))
        self.title = ElidingLabel(title)
        self.title.setFont(smaller(self.font()))
        tint(self.title, MUTED)
        set_help(self.title, tr(chart.title), help)
        self._blank = small_label()
        self._blank.setAccessibleName(tr("Why the chart of {title} is empty", title=tr(chart.title)))
        self._blank.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._blank.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        apply_spacing(QVBoxLayout(self.plot)).addWidget(self._blank)
        self.marker = pg.InfiniteLine(0, movable=False)
        self.marker.setZValue(20)
        self.plot.addItem(self.marker, ignoreBounds=True)
        self.lines: list[pg.PlotDataItem] = []
        self._names: list[str] = []  # of the runs of the lines
        self._curves: Sequence[Curve] = ()
        self._by_time = self._log = False
        self.zero: float | None = None
        fill(QVBoxLayout(self), self.title, (self.plot, 1), margins=(0, 0, 0, 0), spacing=0)
        self.view.clicked.connect(lambda place, _: self._on_elsewhere(place))
        self.view.dragged.connect(lambda _, place: self._on_elsewhere(place))
        show_tooltips(self.plot, lambda place: describe(self.chart, self._curves, place.x(), self._by_time))
        on_theme_change(self, self._paint)

    def _paint(self) -> None:
        self.marker.setPen(pg.mkPen(str(TEXT), width=1))
        self.draw(self._curves, self._by_time, self._log)

    # Drawing

    def draw(self, curves: Sequence[Curve], by_time: bool, log: bool) -> None:
        """Draw runs against iterations or seconds; `log` applies to quantities that suit it."""
        self._curves, self._by_time, self._log = [curve for curve in curves if curve.shown], by_time, log
        chart = described(self.chart, self._curves, by_time, log)
        self._fit(chart)
        while len(self.lines) < len(chart.lines):
            line = pg.PlotDataItem(connect="finite", autoDownsample=True, downsampleMethod="peak", symbolPen=None)
            line.scatter.setEnabled(False)  # clicks on markers go to the line
            line.setCurveClickable(True, width=_PICK_WIDTH)
            line.sigClicked.connect(partial(self._on_line_clicked, len(self.lines)))
            self.lines.append(line)
            self.plot.addItem(line, ignoreBounds=True)
        while len(self.lines) > len(chart.lines):
            self.plot.removeItem(self.lines.pop())
        for item, line in zip(self.lines, chart.lines, strict=True):
            self._draw_line(item, line)
        self._names = [line.label for line in chart.lines]
        self._blank.setText(reason_if_blank(self.chart, curves))

    def _draw_line(self, item: pg.PlotDataItem, line: Line) -> None:
        colour = QColor(line.colour)
        colour.setAlphaF(1.0 if line.strong else 0.65)
        item.setData(
            line.x,
            self.heights(line.y),
            pen=pg.mkPen(colour, width=2.0 if line.strong else 1.0, style=_STYLES[line.dash]),
            symbol="o" if len(line.x) <= _MAX_MARKERS else None,
            symbolBrush=colour,
            symbolSize=5 if line.strong else 4,
        )
        item.setZValue(10 if line.strong else 0)

    def heights(self, values: Sequence[float] | np.ndarray) -> np.ndarray:
        """Return the positions of values on the vertical axis, (k,) float64."""
        values = np.asarray(values)
        if not (self._log and self.chart.log):
            return values
        with np.errstate(divide="ignore", invalid="ignore"):
            heights = np.log10(values)
        if self.zero is not None:
            heights[values <= 0] = self.zero
        return heights

    def mark(self, x: float | None) -> None:
        """Move the marker of the iteration shown; None hides it."""
        self.marker.setVisible(x is not None)
        if x is not None:
            self.marker.setValue(x)

    def _fit(self, chart: LineChart) -> None:
        """Fit the vertical axis to the values."""
        values = chart.values
        least, most = float(values.min(initial=0.0)), float(values.max(initial=0.0))
        ticks, self.zero = None, None
        if self.chart.key == "quality":
            low, high = (-1.0 if least < 0 else 0.0), 1.0
        elif not chart.log:
            low, high = 0.0, max(most, _LEAST_WHOLE) if chart.whole else most or 1.0
        else:
            positive = values[values > 0]
            low = math.floor(math.log10(positive.min())) if positive.size else 0
            if (values <= 0).any():
                low = self.zero = (0 if chart.whole else low) - 1
            high = max(math.log10(most or 1.0), low + 1.0)
            powers = log_ticks(low, high)
            ticks = [powers if self.zero is None else [(low, "0"), *powers[1:]]]
        self.plot.getAxis("left").setTicks(ticks)
        self.plot.setYRange(low, high, padding=0.08)

    # Mouse

    def _on_line_clicked(self, at: int, item: pg.PlotCurveItem, event: MouseClickEvent) -> None:
        name = self._names[at]
        self._pick(next(curve for curve in self._curves if curve.record.name == name), event.pos())

    def _on_elsewhere(self, place: QPointF) -> None:
        """Go to an iteration of the current run, or of the oldest."""
        if self._curves:
            self._pick(next((curve for curve in self._curves if curve.current), self._curves[0]), place)

    def _pick(self, curve: Curve, place: QPointF) -> None:
        self.picked.emit(curve.record, curve.nearest(place.x(), self._by_time))


def describe(chart: Chart, curves: Sequence[Curve], x: float, by_time: bool) -> str:
    """Return the values of all plotted runs at a position of the axis, a line each; "" if no run extends to it."""
    return "\n".join(
        _line(chart, curve, curve.nearest(x, by_time), by_time)
        for curve in curves
        if curve.shown and _extends_to(curve, x, by_time)
    )


def reason_if_blank(chart: Chart, curves: Sequence[Curve]) -> str:
    """Return the reason why a chart is empty; "" if it shows a curve, or if a run may still report a value."""
    shown = [curve for curve in curves if curve.shown]
    if not shown:
        return tr("No run selected.")
    if any(np.isfinite(curve.of(quantity.key)).any() for curve in shown for quantity in chart.quantities):
        return ""
    inverted = int(shown[-1].of("inverted")[-1])
    if chart.key == "objective" and inverted:
        return tr("The objective is infinite: {hexes}.", hexes=counted(inverted, "inverted hex"))
    if any(len(curve.rows) < 2 for curve in shown):
        return ""
    return tr("No run reports its {title}.", title=tr(chart.title))


def _extends_to(curve: Curve, x: float, by_time: bool) -> bool:
    positions = curve.x(by_time)
    margin = 0.5 if not by_time else 0.02 * max(positions[-1] - positions[0], 1e-9)
    return positions[0] - margin <= x <= positions[-1] + margin


def _line(chart: Chart, curve: Curve, number: int, by_time: bool) -> str:
    values = []
    for quantity in chart.quantities:
        value = curve.of(quantity.key)[number]
        if np.isfinite(value):
            text = figure(int(value)) if chart.whole else _significant(float(value))
        else:
            text = tr("infinite") if quantity.key == "objective" else tr("not reported")
        row = curve.rows[number] if quantity.key == "objective" else {}
        formula = row.get("objective_formula")
        values.append(f"{tr(quantity.label)} {formula} {text}" if formula else f"{tr(quantity.label)} {text}")
        if balances(row):
            values.append(tr("may rise while the minima are raised"))
    seconds = tr(" at {seconds:.3g} s", seconds=curve.of("seconds")[number]) if by_time else ""
    pause = curve.record.pauses.get(number)
    paused = "\n    " + tr("paused: {reason}", reason=pause) if pause else ""
    return f"{_named(curve.record, number)}{seconds}: {', '.join(values)}{paused}"


def _named(record: RunRecord, number: int) -> str:
    return RecordedIteration(record, number).name if record.holds_times else f"{record.name} {number}"


def _significant(value: float) -> str:
    return figure(value) if value == 0 or 1e-3 <= abs(value) < 1e8 else f"{value:.3g}".replace("-", "−")
