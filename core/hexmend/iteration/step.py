"""Steps that a smoother yields, and outcomes of runs."""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Any, TypeVar

import numpy as np

from hexmend.energy.norm import ObjectiveNorm, SurfaceObjective
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
