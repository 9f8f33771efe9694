"""Settings of the convergence charts."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend_app.codec.checks import check_known

#: The charts of runs, in the order in which they are offered.
CHARTS = (
    "objective", "quality", "inverted", "largest_move", "gradient_norm", "step_length", "solver_iterations",
    "backtracks", "step_seconds", "delta",
)  # fmt: skip


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
        shown = tuple("backtracks" if name == "cuts" else name for name in self.shown)  # of version 0.1
        object.__setattr__(self, "shown", shown)
        check_known("chart", shown, CHARTS)
