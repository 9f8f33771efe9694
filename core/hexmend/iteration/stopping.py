"""Stopping criteria of a run.

Steps that a smoother yields, and outcomes of runs.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Any, Protocol, TypeVar

import numpy as np

from hexmend.energy.norm import ObjectiveNorm, SurfaceObjective
from hexmend.parameters import AUTO, Parametrised, parameter
from hexmend.quality import ElementQuality

T = TypeVar("T")


class Outcome(Enum):
    """Reason why a run ended, as a sentence."""

    CONVERGED = "Converged: no node moved more than the tolerance."
    MAX_ITERATIONS = "Stopped at the iteration limit before it converged."
    MAX_SECONDS = "Stopped at the time limit before it converged."
    STOPPED = "Stopped by the user."
    NOTHING_FREE = "Nothing to do: every node is fixed."
    FINISHED = "The method has no further step to make."
    NO_IMPROVEMENT = "Converged: the method no longer improves the mesh."
    SUFFICIENT = "Done: the requested quality was reached."
    NO_DESCENT = "Stopped: the line search found no descent step."
    NOT_FINITE = "Stopped: a step produced coordinates that are not finite; the previous result was kept."

    @property
    def key(self) -> str:
        """The name in reports, such as `converged` or `max-iterations`."""
        return self.name.lower().replace("_", "-")

    @property
    def is_cut_short(self) -> bool:
        """True where a limit or the user ended the run before the method did."""
        return self in (Outcome.MAX_ITERATIONS, Outcome.MAX_SECONDS, Outcome.STOPPED)


@dataclass(frozen=True, eq=False)
class ActiveSet:
    """Corners that let the minimum scaled Jacobian, or the smallest time step, rise no further.

    Parameters
    ----------
    hexes, nodes : (k,) int64
        Hex and apex node of each active corner, by their multipliers, the heaviest first: no displacement raises all
        of them.
    locked : (l,) int64
        Hexes with a lower corner all of whose nodes are fixed, the lowest first, each once.
    """

    hexes: np.ndarray
    nodes: np.ndarray
    locked: np.ndarray


@dataclass(frozen=True, eq=False)
class Step:
    """Step of a smoother.

    Parameters
    ----------
    points : (n, 3) float64
        Never changed after it was yielded.
    diagnostics : mapping
        Numbers that describe the step, by name: delta, rejected moves...
    decision : str
        Sentence about a decision that the method has just taken; the run's message repeats it.
    intermediate : bool
        True while another stage follows: however little this step moved, the run has not converged.
    quality : ElementQuality, optional
        `measure(points, hexes)`, if the method has measured it.
    infeasible : bool
        True where nodes are outside the admissible band: such an iterate is never the result.
    active : ActiveSet, optional
        Active corners, which prevent further progress, if the method reports them.
    norm : ObjectiveNorm, optional
        p and offset of the objective that this step lowers, if they differ from the smoother's `norm`.
    surface : SurfaceObjective, optional
        Term of the objective over the quads of the boundary, if they count, at these points.
    begins : bool
        True where the run is judged from this step on: no earlier one is its result, as their boundaries are not yet on
        the surface that was given.
    """

    points: np.ndarray
    diagnostics: Mapping[str, Any] = field(default_factory=dict)
    decision: str = ""
    intermediate: bool = False
    quality: ElementQuality | None = None
    infeasible: bool = False
    active: ActiveSet | None = None
    norm: ObjectiveNorm | None = None
    surface: SurfaceObjective | None = None
    begins: bool = False


def map_steps(steps: Generator[Step, None, T], change: Callable[[Step], Step | None]) -> Generator[Step, None, T]:
    """Yield the steps of a stage as `change` returns them, without those that it drops; return the stage's result."""
    while True:
        try:
            step = change(next(steps))
        except StopIteration as end:
            return end.value
        if step is not None:
            yield step


class Limited(Protocol):
    """Method with an iteration limit of its own."""

    @property
    def iteration_limit(self) -> int:
        """Iterations after which a run ends."""


@dataclass(frozen=True)
class StoppingCriteria(Parametrised):
    """Limits at which a run ends by itself, and the choice of the iterate that it keeps."""

    max_iterations: int = parameter(
        AUTO,
        low=0,
        high=1_000_000,
        help="Iteration limit of a run; auto: that of the method, 5,000 for mend and 300 for others.",
        automatic=AUTO,
    )
    tolerance: float = parameter(
        1e-4,
        low=0,
        high=1,
        unit="mean edge length",
        help="Converged when no node moves further in an iteration (A.1) and the objective of an optimiser falls by "
        "less than a thousandth.",
    )
    move: str = parameter(
        "length",
        choices=("length", "coordinate"),
        help="Measure of a node's move: its length, or the largest change of a coordinate as in A.1.",
        advanced=True,
    )
    moves_only: bool = parameter(
        False,
        help="Judge convergence by the moves of nodes alone, as A.1 does, even while the objective still falls.",
        advanced=True,
    )
    max_seconds: float = parameter(
        0.0,
        low=0,
        high=1e7,
        unit="s",
        zero="none",
        help="Time limit of the method with its set-up; 0 sets no limit. The current iteration is completed.",
    )
    keep_last: bool = parameter(
        False,
        help="Keep the last iterate, even if the method ranks an earlier one higher.",
        advanced=True,
    )

    def limit_of(self, method: Limited) -> int:
        """Return the iteration limit of a run of a method."""
        return method.iteration_limit if self.max_iterations == AUTO else self.max_iterations

    def reached(self, method: Limited, iterations: int, seconds: float) -> Outcome | None:
        """Return the limit that a run of a method is at after so many iterations and seconds; None if at neither."""
        if iterations >= self.limit_of(method):
            return Outcome.MAX_ITERATIONS
        return Outcome.MAX_SECONDS if 0 < self.max_seconds <= seconds else None
