"""Charts of the quantities of a run."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.iteration.figures import DIAGNOSTICS, HISTORY
from hexmend.quantity import Quantity, format_significant
from hexmend_app.codec.checks import check_known

#: Seconds per iteration: the plot computes them from the recorded times.
STEP_SECONDS = Quantity(
    "step_seconds", "seconds per iteration", "Time that the method took for each iteration.", format_significant, -1
)

_QUANTITIES = HISTORY | DIAGNOSTICS | {STEP_SECONDS.key: STEP_SECONDS}


@dataclass(frozen=True)
class Chart:
    """Chart of one or more quantities with a common axis.

    Parameters
    ----------
    key, title : str
    quantities : tuple of Quantity
        Of `HISTORY` or `DIAGNOSTICS`, or `STEP_SECONDS`.
    log : bool
        A logarithmic axis suits them.
    whole : bool
        Their values are integers.
    """

    key: str
    title: str
    quantities: tuple[Quantity, ...]
    log: bool = False
    whole: bool = False

    @property
    def help(self) -> str:
        """Help texts of the quantities."""
        return " ".join(one.help for one in self.quantities)


def _chart(key: str, *quantities: str, title: str = "", log: bool = False, whole: bool = False) -> Chart:
    """Return a chart of some quantities; by default of the one whose key it has."""
    shown = tuple(_QUANTITIES[one] for one in quantities or (key,))
    return Chart(key, title or shown[0].label, shown, log, whole)


#: Charts by key, in menu order.
CHARTS: dict[str, Chart] = {
    chart.key: chart
    for chart in (
        _chart("objective", log=True),
        _chart("quality", "q_min", "q_mean", "scaled_jacobian_min", title="quality"),
        _chart("inverted", "inverted", "invalid", title="invalid hexes", log=True, whole=True),
        _chart("largest_move", log=True),
        _chart("gradient_norm", log=True),
        _chart("step_length", log=True),
        _chart("solver_iterations", whole=True),
        _chart("backtracks", whole=True),
        _chart("step_seconds", log=True),
        _chart("delta", log=True),
    )
}

#: Charts shown by default.
DEFAULT_CHARTS = ("objective", "quality", "inverted")


@dataclass(frozen=True)
class ChartSettings:
    """Settings of the convergence charts.

    Parameters
    ----------
    shown : tuple of str
        Of `CHARTS`.
    logarithmic : bool
    from_zero : bool
        True if branches begin at 0.
    by_time : bool
        True if the axis shows seconds, not iterations.
    """

    shown: tuple[str, ...]
    logarithmic: bool
    from_zero: bool
    by_time: bool

    def __post_init__(self) -> None:
        check_known("chart", self.shown, CHARTS)
