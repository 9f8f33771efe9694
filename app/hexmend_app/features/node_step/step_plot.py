"""Plot of the energy along a node's search direction, with the trial steps of the line search (Algorithm A.5)."""

from __future__ import annotations

import math

import numpy as np
import pyqtgraph as pg
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend_app.state.node_step import NodeStep
from hexmend_app.theme.palette import AMBER, PANEL, SEARCH, TAKEN, TEXT, TRIED
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import on_theme_change, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.plots import calm_plot

_HELP = (
    "Change of the energy along the direction; α is the fraction of the direction. A trial step is accepted "
    "if it is below the dashed line, which falls with a small fraction of the slope (Armijo). Trials above the plot, "
    "including infinite ones, are drawn at its upper edge."
)

#: Margins of the plot above and below the curve, as fractions of the fall and of the height.
_MARGIN_ABOVE, _MARGIN_BELOW = 1.2, 0.12


class NodePlot(QWidget):
    """Plots the energy along the direction of one step."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._plot = calm_plot()
        self._plot.getPlotItem().setContentsMargins(0, 4, 8, 0)
        for name, text in (("bottom", "α"), ("left", tr("Δ energy"))):
            self._plot.getAxis(name).setLabel(text)
        self._plot.getAxis("left").enableAutoSIPrefix(True)  # writes the power of ten into the label
        self._plot.getAxis("left").setWidth(self.fontMetrics().horizontalAdvance("−00.00") + 26)
        self._plot.getAxis("bottom").setHeight(2 * self.fontMetrics().height() + 4)
        self._curve, self._bound = self._plot.plot(), self._plot.plot()
        self._dots = pg.ScatterPlotItem(hoverable=True, tip=_describe_dot)
        self._plot.addItem(self._dots)
        self._step: NodeStep | None = None
        set_help(self._plot, tr("Energy along the direction"), tr(_HELP))
        fill(QVBoxLayout(self), self._plot, margins=(0, 0, 0, 0))
        on_theme_change(self, lambda: self.show_step(self._step))

    def show_step(self, step: NodeStep | None) -> None:
        """Plot a step; None clears the plot."""
        self._step = step
        if not self.drawn:
            return
        alpha, change = step.curve[:, 0], step.curve[:, 1] - step.energy
        bottom, top = extent(step)
        self._plot.setXRange(0, alpha[-1], padding=0.02)
        self._plot.setYRange(bottom, top, padding=0)
        self._curve.setData(alpha, np.minimum(change, 2 * top - bottom), pen=pg.mkPen(str(SEARCH), width=2))
        if step.trials:
            slope = (step.trials[0].bound - step.energy) / step.trials[0].alpha
            ends = alpha[[0, -1]]
            dashed = pg.mkPen(str(AMBER), width=1.2, style=pg.QtCore.Qt.PenStyle.DashLine)
            self._bound.setData(ends, slope * ends, pen=dashed)
        else:
            self._bound.clear()
        self._draw_dots(step, bottom, top, float(alpha[-1]))

    @property
    def drawn(self) -> bool:
        """True if the step has a curve to plot that is more than rounding."""
        step = self._step
        return step is not None and math.isfinite(step.energy) and not step.curve_is_rounding

    def _draw_dots(self, step: NodeStep, bottom: float, top: float, right: float) -> None:
        spots = [_spot(0.0, 0.0, TEXT, "o", 0)]
        for number, trial in enumerate(step.trials, start=1):
            if trial.alpha > right:
                continue
            change = trial.energy - step.energy
            above_plot = not change < top
            height = top - 0.04 * (top - bottom) if above_plot else change
            colour = TAKEN if trial.alpha == step.alpha else TRIED
            spots.append(_spot(trial.alpha, height, colour, "t1" if above_plot else "o", number))
        if not step.trials:
            spots.append(_spot(1.0, float(np.interp(1.0, *step.curve.T)) - step.energy, TRIED, "o", 0))
            if step.move > 0:
                spots.append(_spot(step.alpha, step.energy_after - step.energy, TAKEN, "o", 0))
        self._dots.setData(spots)


def extent(step: NodeStep) -> tuple[float, float]:
    """Return the vertical range of the plot, as changes of energy: the whole descent and part of the ascent."""
    alpha, changes = step.curve[:, 0], step.curve[:, 1] - step.energy
    finite = np.isfinite(changes)
    low = float(np.min(changes, where=finite, initial=0.0))
    if not step.trials:
        visible = finite & (alpha <= 1)
    elif low < 0:
        visible = finite & (changes < -_MARGIN_ABOVE * low)
    else:
        visible = finite & (alpha <= alpha[-1] / 4)
    high = max(1.1 * float(np.max(changes, where=visible, initial=0.0)), -0.25 * low) or 1.0
    return low - _MARGIN_BELOW * (high - low), high


def _describe_dot(x: float, y: float, data: int) -> str:
    """Return the tooltip of a dot: the number of the trial from 1, or 0 for none, and its position."""
    name = tr("Trial {number}: ", number=data) if data else ""
    return f"{name}α = {x:.3g}, Δ {y:.3g}"


def _spot(x: float, y: float, colour: object, symbol: str, number: int) -> dict:
    pen = pg.mkPen(str(PANEL), width=1)
    return {"pos": (x, y), "brush": str(colour), "pen": pen, "symbol": symbol, "size": 10, "data": number}
