"""What a smoother yields, what a run makes of it, and how a run ends."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Any

import numpy as np

from hexmend.mesh import Mesh
from hexmend.quality import ElementQuality, Summary, objective


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

    @property
    def key(self) -> str:
        """The name in reports: `converged`, `max-iterations`..."""
        return self.name.lower().replace("_", "-")


@dataclass(frozen=True, eq=False)
class Step:
    """One step of a smoother.

    Parameters
    ----------
    points : (n, 3) float64
        Never changed after it was yielded.
    notes : mapping
        What the method wants to tell of the step: delta, moves taken back...
    decision : str
        A sentence, where the method has just decided how to go on; the run's message repeats it.
    more : bool
        True while another stage is to come: however little this step moved, the run has not converged.
    figures : ElementQuality, optional
        `measure(points, hexes)`, where the method has needed it itself.
    """

    points: np.ndarray
    notes: Mapping[str, Any] = field(default_factory=dict)
    decision: str = ""
    more: bool = False
    figures: ElementQuality | None = None


@dataclass(frozen=True, eq=False)
class Iteration:
    """A step as the run recorded it.

    Parameters
    ----------
    number : int
        0 is the mesh before the first step.
    points : (n, 3) float64
        Read-only.
    figures : ElementQuality
        Of every hex at these points.
    seconds : float
        Spent in the smoother since its set-up ended.
    largest_move : float
        Of any node in this step, in mean edge lengths of the initial mesh: what Algorithm A.1 looks at.
    notes : mapping
        From the step.
    """

    number: int
    points: np.ndarray
    figures: ElementQuality
    seconds: float
    largest_move: float
    notes: Mapping[str, Any] = field(default_factory=dict)

    def row(self) -> dict[str, float | int | None]:
        """The row of the history: `iteration seconds objective q_min q_mean inverted largest_move`."""
        return {
            "iteration": self.number,
            "seconds": self.seconds,
            "objective": objective(self.figures),
            "q_min": float(self.figures.q.min()),
            "q_mean": float(self.figures.q.mean()),
            "inverted": self.figures.n_inverted,
            "largest_move": self.largest_move,
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
    parameters : mapping
    outcome : Outcome
    message : str
        The outcome with its figures, in sentences.
    iterations : int
    seconds : float
        In the smoother, without its set-up, without reading, writing and compiling.
    setup_seconds : float
        Topology, colouring and whatever else the method prepares.
    history : tuple of dict
        A row an iteration, the initial mesh first.
    """

    mesh: Mesh
    before: Summary
    after: Summary
    method: str
    parameters: Mapping[str, Any]
    outcome: Outcome
    message: str
    iterations: int
    seconds: float
    setup_seconds: float
    history: tuple[dict[str, float | int | None], ...]
