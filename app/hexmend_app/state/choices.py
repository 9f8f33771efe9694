"""What panels are set to, where that is no part of the look: a session keeps it too."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any

from hexmend.quality import METRICS
from hexmend.smoothers import METHODS
from hexmend_app.state.clip import BoxClip, PlaneClip

#: The charts of runs, in the order in which they are offered.
CHARTS = (
    "objective", "quality", "inverted", "largest_move", "gradient_norm", "step_length", "solver_iterations", "cuts",
    "step_seconds", "delta",
)  # fmt: skip

#: More of anything than any panel offers.
MOST = 1_000_000


@dataclass(frozen=True)
class ChartChoices:
    """How runs are plotted.

    Parameters
    ----------
    shown : tuple of str
        Of `CHARTS`.
    logarithmic : bool
    from_zero : bool
        Whether branches begin at 0.
    by_time : bool
        Whether the axis is of seconds, not of iterations.
    """

    shown: tuple[str, ...]
    logarithmic: bool
    from_zero: bool
    by_time: bool

    def __post_init__(self) -> None:
        _check("chart", self.shown, CHARTS)


@dataclass(frozen=True)
class WorstChoices:
    """By which metric the worst hexes are listed, and whether the one that is gone to is isolated."""

    metric: str
    isolates: bool

    def __post_init__(self) -> None:
        _check("metric", (self.metric,), METRICS)


@dataclass(frozen=True)
class HistogramChoices:
    """Whether the histogram's counts go by powers of ten, whether they are summed up, and how many bins there are."""

    log: bool
    cumulative: bool
    bins: int

    def __post_init__(self) -> None:
        _check_count("bins", self.bins)


@dataclass(frozen=True)
class CompareChoices:
    """Which methods are ticked, and the column that the table is sorted by: "method", "view" or a figure's key."""

    ticked: frozenset[str]
    sorted_by: str
    descending: bool

    def __post_init__(self) -> None:
        from hexmend.report.comparison import LINES

        _check("method", self.ticked, METHODS)
        _check("column", (self.sorted_by,), ("method", "view", *(figure.key for figure in LINES)))


@dataclass(frozen=True)
class CutChoices:
    """The planes and the box that are cut along, or would be, and which of the two it is."""

    planes: PlaneClip
    box: BoxClip
    boxed: bool


@dataclass(frozen=True)
class ChoicesData:
    """What a session keeps of the panels; None for what nobody has offered.

    Parameters
    ----------
    charts : ChartChoices
    worst : WorstChoices
    histogram : HistogramChoices
    compare : CompareChoices
    cut : CutChoices
    corners : bool
        Whether the qualities of the chosen hex's corners are written in the view.
    patch : bool
        Whether what is isolated is the patch of the node whose step is looked at, and goes with it.
    steps : int
        How many iterations a step makes.
    tag : str
        The name that hexes are tagged with.
    """

    charts: ChartChoices | None = None
    worst: WorstChoices | None = None
    histogram: HistogramChoices | None = None
    compare: CompareChoices | None = None
    cut: CutChoices | None = None
    corners: bool | None = None
    patch: bool | None = None
    steps: int | None = None
    tag: str | None = None

    def __post_init__(self) -> None:
        if self.steps is not None:
            _check_count("steps", self.steps)


class Choices:
    """Asks panels what they are set to, and sets them: whoever has a panel offers both."""

    def __init__(self) -> None:
        self._offers: dict[str, tuple[Callable[[], Any], Callable[[Any], object]]] = {}

    def offer(self, name: str, give: Callable[[], Any], take: Callable[[Any], object]) -> None:
        """Name what gives and takes a field of `ChoicesData`; what is taken comes after the view, before it is shown.

        Raises
        ------
        ValueError
            Where there is no such field.
        """
        _check("choice", (name,), [one.name for one in fields(ChoicesData)])
        self._offers[name] = give, take

    def given(self) -> ChoicesData:
        """What a session keeps."""
        return ChoicesData(**{name: give() for name, (give, _) in self._offers.items()})

    def take(self, data: ChoicesData) -> None:
        """Set panels as a session has kept them."""
        for name, (_, take) in self._offers.items():
            if getattr(data, name) is not None:
                take(getattr(data, name))


def _check_count(what: str, count: int) -> None:
    if not 1 <= count <= MOST:
        raise ValueError(f"the number of {what} is not from 1 to {MOST:,}")


def _check(what: str, names: Any, known: Any) -> None:
    for name in names:
        if name not in known:
            raise ValueError(f"there is no {what} {name!r}")
