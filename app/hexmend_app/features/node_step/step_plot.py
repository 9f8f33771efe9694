"""The energy along a node's search direction, with the trial steps of the line search: Algorithm A.5 made visible."""

from __future__ import annotations

import math

import numpy as np
import pyqtgraph as pg
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend.node_step import NodeStep
from hexmend_app.theme.palette import AMBER, MUTED, PANEL, SEARCH, TAKEN, TEXT, TRIED
from hexmend_app.theme.style import on_theme_change, set_help, smaller
from hexmend_app.widgets.plots import calm_plot

_HELP = (
    "How the energy changes along the direction, α being the share of it that is gone. A trial step (numbered) is "
    "accepted as soon as it lies below the dashed line, which falls with a small share of the slope (Armijo). Trials "
    "above the plot, infinite ones too, are drawn at its upper edge."
)

#: How far the plot reaches above what falls, and below; how near two numbers stand to each other; in parts of a side.
_ABOVE, _BELOW, _SPECIAL = 1.2, 0.12, 0.045

#: Where a number stands beside its dot: right of it, lest the curve run through it; as anchors of pyqtgraph.
_NEIGHBOUR, _OVER_IT, _BELOW_IT = (-0.35, 0.4), (0.5, 1.1), (0.5, -0.15)

_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class NodePlot(QWidget):
    """Draws one step's energy.

    Attributes
    ----------
    numbers : list of pg.TextItem
        Beside the trials.
    """

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._plot = calm_plot()
        self._plot.getPlotItem().setContentsMargins(0, 4, 8, 0)
        for name, text in (("bottom", "α"), ("left", "Δ energy")):
            self._plot.getAxis(name).setLabel(text)
            self._plot.getAxis(name).label.setFont(smaller(self.font()))
        self._plot.getAxis("left").setWidth(self.fontMetrics().horizontalAdvance("−00.00") + 26)
        self._plot.getAxis("bottom").setHeight(2 * self.fontMetrics().height() + 4)
        self._curve, self._bound = self._plot.plot(), self._plot.plot()
        self._dots = pg.ScatterPlotItem()
        self._plot.addItem(self._dots)
        self.numbers: list[pg.TextItem] = []
        self._step: NodeStep | None = None
        set_help(self._plot, "Energy along the direction", _HELP)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self._plot)
        on_theme_change(self, lambda: self.show_step(self._step))

    def show_step(self, step: NodeStep | None) -> None:
        """Draw a step, or nothing."""
        self._step = step
        for number in self.numbers:
            self._plot.removeItem(number)
        self.numbers.clear()
        if not self.drawn:
            return
        alpha, change = step.curve[:, 0], step.curve[:, 1] - step.energy
        bottom, top = extent(step)
        self._plot.setXRange(0, alpha[-1], padding=0.02)
        self._plot.setYRange(bottom, top, padding=0)
        self._show_power(max(abs(bottom), top))
        self._curve.setData(alpha, np.minimum(change, 2 * top - bottom), pen=pg.mkPen(str(SEARCH), width=2))
        if step.trials:
            share = (step.trials[0].bound - step.energy) / step.trials[0].alpha
            ends = alpha[[0, -1]]
            self._bound.setData(
                ends, share * ends, pen=pg.mkPen(str(AMBER), width=1.2, style=pg.QtCore.Qt.PenStyle.DashLine)
            )
        else:
            self._bound.clear()
        self._draw_dots(step, bottom, top, float(alpha[-1]))

    @property
    def drawn(self) -> bool:
        """True if there is anything to draw."""
        return self._step is not None and len(self._step.curve) > 0 and math.isfinite(self._step.energy)

    def shown_trials(self) -> list[tuple[int, float, float]]:
        """Number, alpha and height of every trial that is drawn."""
        return [(spot.data(), spot.pos().x(), spot.pos().y()) for spot in self._dots.points() if spot.data()]

    def _show_power(self, size: float) -> None:
        """Leave a power of ten to the label where numbers would be long."""
        power = 0 if size == 0 or 1e-2 <= size < 1e3 else math.floor(math.log10(size))
        axis = self._plot.getAxis("left")
        axis.setScale(10.0**-power)
        axis.setLabel("Δ energy" + (f" [10{str(power).translate(_SUPERSCRIPT)}]" if power else ""))

    def _draw_dots(self, step: NodeStep, bottom: float, top: float, right: float) -> None:
        spots = [_spot(0.0, 0.0, TEXT, "o", 0)]
        last = math.inf
        for number, trial in enumerate(step.trials, start=1):
            if trial.alpha > right:
                continue
            change = trial.energy - step.energy
            beyond = not change < top
            height = top - 0.04 * (top - bottom) if beyond else change
            taken = trial.alpha == step.alpha
            spots.append(_spot(trial.alpha, height, TAKEN if taken else TRIED, "t1" if beyond else "o", number))
            if last - trial.alpha > _SPECIAL * right:
                self._number(
                    number,
                    trial.alpha,
                    height,
                    _BELOW_IT if beyond else _NEIGHBOUR if trial.alpha < 0.9 * right else _OVER_IT,
                )
                last = trial.alpha
        if not step.trials:
            spots.append(_spot(1.0, float(np.interp(1.0, *step.curve.T)) - step.energy, TRIED, "o", 0))
            if step.move > 0:
                spots.append(_spot(step.alpha, step.energy_after - step.energy, TAKEN, "o", 0))
        self._dots.setData(spots)

    def _number(self, number: int, x: float, y: float, anchor: tuple[float, float]) -> None:
        text = pg.TextItem(str(number), color=str(MUTED), anchor=anchor)
        text.setFont(smaller(self.font()))
        text.setPos(x, y)
        self._plot.addItem(text)
        self.numbers.append(text)


def extent(step: NodeStep) -> tuple[float, float]:
    """Least and greatest change of energy that is drawn: all that falls, and a part of what rises."""
    alpha, changes = step.curve[:, 0], step.curve[:, 1] - step.energy
    known = np.isfinite(changes)
    low = float(np.min(changes, where=known, initial=0.0))
    if not step.trials:
        near = known & (alpha <= 1)
    elif low < 0:
        near = known & (changes < -_ABOVE * low)
    else:
        near = known & (alpha <= alpha[-1] / 4)
    high = max(1.1 * float(np.max(changes, where=near, initial=0.0)), -0.25 * low) or 1.0
    return low - _BELOW * (high - low), high


def _spot(x: float, y: float, role: object, symbol: str, number: int) -> dict:
    pen = pg.mkPen(str(PANEL), width=1)
    return {"pos": (x, y), "brush": str(role), "pen": pen, "symbol": symbol, "size": 10, "data": number}
