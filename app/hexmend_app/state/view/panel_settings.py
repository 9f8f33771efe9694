"""Settings of panels that are no part of the appearance; a session file keeps them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any

from hexmend.quality import METRICS
from hexmend.smoothers import METHODS
from hexmend_app.picture.cut_planes import BoxClip, PlaneClip

#: The charts of runs, in the order in which they are offered.
CHARTS = (
    "objective", "quality", "inverted", "largest_move", "gradient_norm", "step_length", "solver_iterations",
    "backtracks", "step_seconds", "delta",
)  # fmt: skip

#: More of anything than any panel offers.
MOST = 1_000_000


@dataclass(frozen=True)
class ChartSettings:
    """Settings of the convergence charts.

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
        shown = tuple("backtracks" if name == "cuts" else name for name in self.shown)  # of version 0.1
        object.__setattr__(self, "shown", shown)
        _check("chart", shown, CHARTS)


@dataclass(frozen=True)
class WorstListSettings:
    """By which metric the worst hexes are listed, and whether the one that is gone to is isolated."""

    metric: str
    isolates: bool

    def __post_init__(self) -> None:
        _check("metric", (self.metric,), METRICS)


@dataclass(frozen=True)
class HistogramSettings:
    """Settings of the histogram: logarithmic counts, cumulative counts, number of bins."""

    log: bool
    cumulative: bool
    bins: int

    def __post_init__(self) -> None:
        _check_count("bins", self.bins)


@dataclass(frozen=True)
class ComparisonSettings:
    """Selected methods, and the column that sorts the table: "method", "view" or a figure's key."""

    ticked: frozenset[str]
    sorted_by: str
    descending: bool

    def __post_init__(self) -> None:
        from hexmend.report.comparison import LINES

        _check("method", self.ticked, METHODS)
        _check("column", (self.sorted_by,), ("method", "view", *(figure.key for figure in LINES)))


@dataclass(frozen=True)
class CutPanelSettings:
    """The planes and the box that are cut along, or would be, and which of the two it is."""

    planes: PlaneClip
    box: BoxClip
    boxed: bool


@dataclass(frozen=True)
class PanelSettingsData:
    """Data of the panels in a session file; None for panels that registered no settings.

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

    charts: ChartSettings | None = None
    worst: WorstListSettings | None = None
    histogram: HistogramSettings | None = None
    compare: ComparisonSettings | None = None
    cut: CutPanelSettings | None = None
    corners: bool | None = None
    patch: bool | None = None
    steps: int | None = None
    tag: str | None = None

    def __post_init__(self) -> None:
        if self.steps is not None:
            _check_count("steps", self.steps)


class PanelSettings:
    """Asks panels what they are set to, and sets them: whoever has a panel offers both."""

    def __init__(self) -> None:
        self._offers: dict[str, tuple[Callable[[], Any], Callable[[Any], object]]] = {}

    def register(self, name: str, give: Callable[[], Any], take: Callable[[Any], object]) -> None:
        """Name what gives and takes a field of `ChoicesData`; what is taken comes after the view, before it is shown.

        Raises
        ------
        ValueError
            Where there is no such field.
        """
        _check("choice", (name,), [one.name for one in fields(PanelSettingsData)])
        self._offers[name] = give, take

    def to_data(self) -> PanelSettingsData:
        """Return the data for a session file."""
        return PanelSettingsData(**{name: give() for name, (give, _) in self._offers.items()})

    def restore(self, data: PanelSettingsData) -> None:
        """Set panels as a session has kept them."""
        for name, (_, take) in self._offers.items():
            if getattr(data, name) is not None:
                take(getattr(data, name))


def _check_count(subject: str, count: int) -> None:
    if not 1 <= count <= MOST:
        raise ValueError(f"the number of {subject} is not from 1 to {MOST:,}")


def _check(topic: str, names: Any, known: Any) -> None:
    for name in names:
        if name not in known:
            raise ValueError(f"there is no {topic} {name!r}")
