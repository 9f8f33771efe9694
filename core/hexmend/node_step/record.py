"""The record of one node's step."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from hexmend.energy import ObjectiveNorm


class StepStatus(Enum):
    """What became of the node, as a sentence."""

    MOVED = "Moved."
    SHORTENED = "Moved a part of the way: the whole of it would invert a hex."
    TAKEN_BACK = "Stays: its move would harm a hex, and is taken back."
    NO_DESCENT = "Stays: along the search direction no step descends enough, however short."
    FLAT = "Stays: its energy has no slope here."
    THERE = "Stays: it is where the method wants it."
    STAYS = "Stays: the method leaves it where it is in this iteration."
    INFINITE = "Stays: its energy is infinite, for a hex is inverted and δ is zero."
    FINISHED = "Stays: the method has no further step to make."


class Trial(NamedTuple):
    """A trial step of the line search, A.5.

    `energy` has to be less than `bound`, which is f + c1 alpha slope, for the step to be accepted.
    """

    alpha: float
    energy: float
    bound: float


class Pull(NamedTuple):
    """What draws the node to a place: a neighbour ("node") or a hex that it is a corner of ("hex").

    `place` (3,) is in the mesh's unit of length; `weight` is the share in the mean, None where there is no mean.
    """

    kind: str
    number: int
    place: np.ndarray
    weight: float | None


@dataclass(frozen=True, eq=False)
class NodeStep:
    """One node's step by a method.

    Places and vectors are in the mesh's own unit of length. Energies have none; their derivatives `gradient` and
    `hessian`, and so the eigenvalues, are those by the node's place in lengths of `unit`.

    Parameters
    ----------
    method : str
        Its name.
    node : int
    hexes : (k,) int32
        The node's patch: the hexes that it is a corner of.
    before, after : (3,) float64
        Where the node is, and where the method puts it.
    verdict : StepStatus
    unit : float
        The length that the energy takes for 1: the mean edge length of the patch, or, where the energy is that of the
        whole mesh, of the mesh.
    power : ObjectiveNorm
        p and offset of the energy, (3.3).
    delta : float
        Of the energy, in the cube of `unit`.
    energy : float
        Sum of eta(H)^p, with the node at `before`: over the patch, or over the whole mesh.
    gradient, hessian : (3,), (3, 3) float64
        Of that energy by the node alone; not finite where it is infinite.
    energy_after : float
        The same with the node at `after`; of the whole mesh, with all nodes stepped.
    whole : bool
        Whether `energy`, `trials` and `curve` are those of the whole mesh, all nodes of which step at once; the node's
        own energy is among them, and gradient and Hessian are the node's.
    direction : (3,) float64
        The search direction, or the way to where a method without one wants the node.
    slope : float
        Of the energy along the direction, by alpha.
    alpha : float
        Share of the direction that is taken: 0 where the node stays.
    fallback : bool
        Whether Newton's direction did not descend, and was replaced by steepest descent.
    shift : float
        What A.4 added to the eigenvalues, of the node's Hessian or of the whole mesh's.
    trials : tuple of Trial
        Of the line search, the first first; of a method that has none, empty.
    curve : (j, 2) float64
        alpha, ascending from 0, and the energy there.
    pulls : tuple of Pull
        Of a method that goes to a mean of places.
    notes : mapping
        What the method tells of the whole step that this one is a part of.
    """

    method: str
    node: int
    hexes: np.ndarray
    before: np.ndarray
    after: np.ndarray
    verdict: StepStatus
    unit: float
    power: ObjectiveNorm
    delta: float
    energy: float
    gradient: np.ndarray
    hessian: np.ndarray
    energy_after: float = np.nan
    whole: bool = False
    direction: np.ndarray = field(default_factory=lambda: np.zeros(3))
    slope: float = 0.0
    alpha: float = 0.0
    fallback: bool = False
    shift: float = 0.0
    trials: tuple[Trial, ...] = ()
    curve: np.ndarray = field(default_factory=lambda: np.empty((0, 2)))
    pulls: tuple[Pull, ...] = ()
    notes: Mapping[str, Any] = field(default_factory=dict)

    @cached_property
    def eigenvalues(self) -> np.ndarray:
        """Of the Hessian, ascending, (3,); not a number where the energy is infinite."""
        return np.linalg.eigvalsh(self.hessian) if np.isfinite(self.hessian).all() else np.full(3, np.nan)

    @property
    def cuts(self) -> int:
        """How often the line search cut the step."""
        return max(0, len(self.trials) - 1)

    @property
    def move(self) -> float:
        """How far the node goes, in lengths of `unit`."""
        return float(np.linalg.norm(self.after - self.before)) / self.unit
