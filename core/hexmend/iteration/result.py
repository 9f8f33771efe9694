"""What a smoother yields, what a run makes of it, and how a run ends."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Any

import numpy as np

from hexmend.aliases import exports, reads_old_names
from hexmend.boundary import SurfaceChange
from hexmend.energy.norm import SQUARES, ObjectiveNorm
from hexmend.html_repr import html_of
from hexmend.iteration.stopping import StoppingCriteria
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, Summary, objective, regressions


class Outcome(Enum):
    """Why a run ended, as a sentence."""

    CONVERGED = "Converged: no node moved more than the tolerance."
    MAX_ITERATIONS = "Stopped at the iteration limit before it converged."
    MAX_SECONDS = "Stopped at the time limit before it converged."
    STOPPED = "Stopped by the user."
    NOTHING_FREE = "Nothing to do: every node is fixed."
    FINISHED = "The method has no further step to make."
    NO_IMPROVEMENT = "Converged: neither the least nor the mean quality rises any more."
    SUFFICIENT = "Done: the quality that was asked for is reached."
    NO_DESCENT = "Stopped: along the search direction no step descends, however short."
    NOT_FINITE = "Stopped: a step gave coordinates that are no numbers; what was reached before it is kept."

    @property
    def key(self) -> str:
        """The name in reports: `converged`, `max-iterations`..."""
        return self.name.lower().replace("_", "-")


@dataclass(frozen=True, eq=False)
class ActiveSet:
    """What lets the least of a figure of corners rise no further.

    Parameters
    ----------
    hexes, nodes : (k,) int64
        Corners of which no displacement raises all, the heaviest first: alone, or holding each other, in one place or
        in several. Of each the hex, which may have several, and the node at its apex.
    locked : (l,) int64
        Hexes with a corner that is lower yet, all of whose nodes are fixed, the lowest first.
    """

    hexes: np.ndarray
    nodes: np.ndarray
    locked: np.ndarray


@reads_old_names
@dataclass(frozen=True, eq=False)
class Step:
    """One step of a smoother.

    Parameters
    ----------
    points : (n, 3) float64
        Never changed after it was yielded.
    diagnostics : mapping
        What the method wants to tell of the step: delta, moves taken back...
    decision : str
        A sentence, where the method has just decided how to go on; the run's message repeats it.
    intermediate : bool
        True while another stage is to come: however little this step moved, the run has not converged.
    quality : ElementQuality, optional
        `measure(points, hexes)`, where the method has needed it itself.
    infeasible : bool
        True where nodes are further than the method may leave them: such an iterate is no result.
    limits : ActiveSet, optional
        What lets the method go no further, where it has found that out.
    power : ObjectiveNorm, optional
        p and offset of the objective that this step was to lower, where it is another than the smoother's `power`.
    """

    points: np.ndarray
    diagnostics: Mapping[str, Any] = field(default_factory=dict)
    decision: str = ""
    intermediate: bool = False
    quality: ElementQuality | None = None
    infeasible: bool = False
    limits: ActiveSet | None = None
    power: ObjectiveNorm | None = None


@reads_old_names
@dataclass(frozen=True, eq=False)
class Iteration:
    """A step as the run recorded it.

    Parameters
    ----------
    number : int
        0 is the mesh before the first step.
    points : (n, 3) float64
        Read-only.
    quality : ElementQuality
        Of every hex at these points.
    seconds : float
        Spent in the smoother since its set-up ended.
    largest_move : float
        Of any node in this step, in mean edge lengths of the initial mesh: what Algorithm A.1 looks at.
    diagnostics : mapping
        From the step, and "stage" (the number of the recipe's, from 1) and "method" (the name of the one at work).
    power : ObjectiveNorm
        p and offset of the objective that is recorded: the one that the step was to lower, or, where the step names
        none, the smoother's `power`. Number 0 has that of the first smoother.
    """

    number: int
    points: np.ndarray
    quality: ElementQuality
    seconds: float
    largest_move: float
    diagnostics: Mapping[str, Any] = field(default_factory=dict)
    power: ObjectiveNorm = SQUARES

    @property
    def objective(self) -> float | None:
        """The objective of `power`, at delta = 0; None while any hex is inverted.

        It rises where a step was not made to lower it: while mend raises the least scaled Jacobian, for example.
        """
        return objective(self.quality, *self.power)

    def row(self) -> dict[str, float | int | str | None]:
        """The row of the history: `iteration seconds objective q_min q_mean inverted largest_move`.

        `objective_formula` says which objective it is: stages of a recipe, and steps of a method that raises p, have
        different ones.
        """
        return {
            "iteration": self.number,
            "seconds": self.seconds,
            "objective": self.objective,
            "objective_formula": self.power.formula,
            "q_min": float(self.quality.q.min()),
            "q_mean": float(self.quality.q.mean()),
            "inverted": self.quality.n_inverted,
            "largest_move": self.largest_move,
        }


@dataclass(frozen=True, eq=False)
class StageResult:
    """What one method did in a run of several.

    Parameters
    ----------
    stage : int
        Of the recipe, from 1; two in a row have the same where the method was changed within the stage.
    method : str
    parameters : mapping
    stop : StoppingCriteria
        The limits of the stage.
    outcome : Outcome
    first : int
        Number of the iteration that it began with.
    iterations : int
    seconds, setup_seconds : float
    """

    stage: int
    method: str
    parameters: Mapping[str, Any]
    stop: StoppingCriteria
    outcome: Outcome
    first: int
    iterations: int
    seconds: float
    setup_seconds: float

    def to_dict(self) -> dict[str, Any]:
        """Its fields as JSON holds them."""
        fields = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        return fields | {
            "parameters": dict(self.parameters),
            "stop": self.stop.values(),
            "outcome": self.outcome.key,
        }


@dataclass(frozen=True, eq=False)
class Result:
    """A run that ended.

    Parameters
    ----------
    mesh : Mesh
        The smoothed mesh; everything but the points is the initial one's.
    before, after : Summary
    method : str
        "recipe" for a recipe, and where the method was changed on the way.
    parameters : mapping
    outcome : Outcome
        Of the last stage.
    message : str
        The outcome with the figures it was reached with, in sentences.
    iterations : int
    kept : int
        Number of the iteration that is the result.
    seconds : float
        In the smoother, without its set-up, without reading and writing.
    setup_seconds : float
        Topology, colouring and whatever else the method prepares.
    history : tuple of dict
        A row an iteration, the initial mesh first: `Iteration.row`.
    stages : tuple of StageResult
        What each method did: of a run of one method one, else the stages of a recipe as they were run, or the methods
        of a run whose method was changed on the way.
    surface : SurfaceChange or None
        How far the boundary has left where it was; None where no method let it slide.
    limits : ActiveSet or None
        What let the last method go no further, where it has found that out.
    """

    mesh: Mesh
    before: Summary
    after: Summary
    method: str
    parameters: Mapping[str, Any]
    outcome: Outcome
    message: str
    iterations: int
    kept: int
    seconds: float
    setup_seconds: float
    history: tuple[dict[str, float | int | str | None], ...]
    stages: tuple[StageResult, ...]
    surface: SurfaceChange | None = None
    limits: ActiveSet | None = None

    @property
    def worse(self) -> tuple[str, ...]:
        """What is worse than before: names of `hexmend.quality.REGRESSION_KEYS`."""
        return regressions(self.before, self.after)

    def _repr_html_(self) -> str:
        """What a notebook shows of it."""
        return html_of(self)


__getattr__ = exports(__name__)
