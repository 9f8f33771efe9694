"""Charts that can be plotted for a run."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.iteration.figures import DIAGNOSTICS, HISTORY
from hexmend.quantity import Quantity, format_significant

#: The time of one iteration, which the plot takes from the times of two.
STEP_SECONDS = Quantity(
    "step_seconds", "seconds per iteration", "Time that the method took for each iteration.", format_significant, -1
)
_FIGURES = HISTORY | DIAGNOSTICS | {STEP_SECONDS.key: STEP_SECONDS}


@dataclass(frozen=True)
class Quantity:
    """A figure of every iteration.

    Parameters
    ----------
    figure : Figure
        Of `HISTORY`, `NOTES`, or `STEP_SECONDS`.
    log : bool
        Whether its logarithm says more than itself.
    whole : bool
        Whether it is a count.
    """

    figure: Quantity
    log: bool = False
    whole: bool = False

    @property
    def key(self) -> str:
        """Its name in records."""
        return self.figure.key

    @property
    def title(self) -> str:
        """Its name in words."""
        return self.figure.label


@dataclass(frozen=True)
class Chart:
    """Quantities that are plotted over one another."""

    key: str
    title: str
    quantities: tuple[Quantity, ...]

    @property
    def help(self) -> str:
        """Return the help texts of the quantities."""
        return " ".join(one.figure.help for one in self.quantities)


def _alone(key: str, title: str = "", **style: bool) -> Chart:
    return Chart(key, title or _FIGURES[key].label, (Quantity(_FIGURES[key], **style),))


#: In the order in which it is offered.
CHARTS: dict[str, Chart] = {
    chart.key: chart
    for chart in (
        _alone("objective", "objective", log=True),
        Chart("quality", "quality", (Quantity(_FIGURES["q_min"]), Quantity(_FIGURES["q_mean"]))),
        _alone("inverted", "inverted hexes", log=True, whole=True),
        _alone("largest_move", log=True),
        _alone("gradient_norm", log=True),
        _alone("step_length", log=True),
        _alone("solver_iterations", whole=True),
        _alone("backtracks", whole=True),
        _alone("step_seconds", log=True),
        _alone("delta", log=True),
    )
}

#: What is plotted at first.
FIRST = ("objective", "quality", "inverted")
