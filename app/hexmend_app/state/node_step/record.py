"""The record of the step of one node."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from hexmend.energy import ObjectiveNorm
from hexmend_app.state.node_step.descent import descent

#: Relative change of an energy that counts as rounding: energies of patches are computed with an error of about 2e-15.
_ROUNDING = 1e-13

#: Length of a move or a search direction that counts as rounding, in the unit of the step.
_NO_MOVE = 1e-9

#: Relative change of the energy from before to after a step that counts as rounding.
_NO_CHANGE = 1e-12


class StepStatus(Enum):
    """Outcome of the step of a node, as a sentence."""

    MOVED = "Moved."
    SHORTENED = "Moved part of the way: the full step would invert a hex."
    REJECTED = "Not moved: the step would make a hex worse and was rejected."
    NO_DESCENT = "Not moved: no step along the search direction lowers the energy enough."
    STATIONARY = "Not moved: the gradient of its energy is zero."
    AT_TARGET = "Not moved: it is at its target already."
    UNCHANGED = "Not moved: the method does not move it in this iteration."
    INFINITE = "Not moved: its energy is infinite, as a hex is inverted and δ is zero."
    FINISHED = "Not moved: the method has finished."


class Trial(NamedTuple):
    """A trial step of the line search, Algorithm A.5; it is accepted if `energy` < `bound` = f + c1 alpha slope."""

    alpha: float
    energy: float
    bound: float


class Pull(NamedTuple):
    """Contribution of an edge neighbour (`kind` "node") or of a hex ("hex") to the target of a node.

    `place` (3,) is a position in the mesh's unit of length; `weight` is its share in the mean, None without a mean.
    """

    kind: str
    number: int
    place: np.ndarray
    weight: float | None


@dataclass(frozen=True, eq=False)
class NodeStep:
    """The step of one node by a method.

    Positions and vectors are in the mesh's unit of length. Energies are dimensionless; `gradient`, `hessian` and
    `eigenvalues` are derivatives with respect to the node's position in `unit`.

    Parameters
    ----------
    method : str
        Name of the method.
    node : int
    hexes : (k,) int32
        The node's patch: hexes of which it is a corner.
    before, after : (3,) float64
        Position of the node before and after the step.
    status : StepStatus
    unit : float
        Unit of length of the energy: the mean edge length of the patch, or of the mesh if `is_global`.
    norm : ObjectiveNorm
        p and offset of the energy, (3.3).
    delta : float
        Regularisation of the energy, (3.2), in the cube of `unit`.
    energy : float
        Sum of eta(H)^p, with the node at `before`: over the patch, or over the whole mesh.
    gradient, hessian : (3,), (3, 3) float64
        Derivatives of that energy by the position of the node; not finite if it is infinite.
    energy_after : float
        The energy after the step; after the step of all nodes if `is_global`.
    is_global : bool
        True if `energy`, `trials` and `curve` are those of the whole mesh, all nodes of which move at once; gradient
        and Hessian remain those of the node.
    direction : (3,) float64
        The search direction; for a method without one, the vector to its target.
    slope : float
        Derivative of the energy along the direction by alpha.
    alpha : float
        Step length as a share of `direction`; 0 if the node does not move.
    fallback : bool
        True if Newton's direction did not descend and was replaced by steepest descent.
    shift : float
        Shift of the eigenvalues by Algorithm A.4, of the Hessian of the node or of the mesh.
    trials : tuple of Trial
        Trials of the line search in order; empty for a method without one.
    curve : (j, 2) float64
        alpha, ascending from 0, and the energy.
    pulls : tuple of Pull
        Contributions to the target, for methods that move to a mean of positions.
    notes : mapping
        Diagnostics of the iteration of which this step is a part.
    """

    method: str
    node: int
    hexes: np.ndarray
    before: np.ndarray
    after: np.ndarray
    status: StepStatus
    unit: float
    norm: ObjectiveNorm
    delta: float
    energy: float
    gradient: np.ndarray
    hessian: np.ndarray
    energy_after: float = np.nan
    is_global: bool = False
    direction: np.ndarray = field(default_factory=lambda: np.zeros(3))
    slope: float = 0.0
    alpha: float = 0.0
    fallback: bool = False
    shift: float = 0.0
    trials: tuple[Trial, ...] = ()
    curve: np.ndarray = field(default_factory=lambda: np.empty((0, 2)))
    pulls: tuple[Pull, ...] = ()
    diagnostics: Mapping[str, Any] = field(default_factory=dict)

    @cached_property
    def eigenvalues(self) -> np.ndarray:
        """Eigenvalues of the Hessian, ascending, (3,); NaN if the energy is infinite."""
        return np.linalg.eigvalsh(self.hessian) if np.isfinite(self.hessian).all() else np.full(3, np.nan)

    @cached_property
    def descent(self) -> np.ndarray:
        """Negative gradient, (3,); zero if it is within rounding, see `hexmend_app.state.node_step.descent.descent`."""
        return descent(self.gradient, self.hessian, self.before / self.unit if self.unit else self.before)

    @property
    def search_direction(self) -> np.ndarray:
        """`direction`, (3,); zero if it is within rounding, or follows from a gradient that is."""
        has_own_target = self.is_global or len(self.pulls) > 0
        negligible = np.linalg.norm(self.direction) <= _NO_MOVE * self.unit
        return np.zeros(3) if negligible or not (has_own_target or self.descent.any()) else self.direction

    @property
    def outcome(self) -> StepStatus:
        """`status`, but AT_TARGET for a node that moved within rounding only."""
        moved = self.status in (StepStatus.MOVED, StepStatus.SHORTENED)
        return StepStatus.AT_TARGET if moved and self.move < _NO_MOVE else self.status

    @property
    def raises_energy(self) -> bool:
        """True if the node moves and the energy rises by more than rounding."""
        return self.move > 0 and self.energy_after > self.energy * (1 + _NO_CHANGE)

    @property
    def curve_is_rounding(self) -> bool:
        """True if the energy changes along the curve by rounding alone, or there is no curve."""
        energies = self.curve[:, 1]
        return not len(energies) or bool(np.ptp(energies) <= _ROUNDING * abs(self.energy))

    @property
    def backtracks(self) -> int:
        """Number of times that the line search shortened the step."""
        return max(0, len(self.trials) - 1)

    @property
    def move(self) -> float:
        """Length of the node's move in `unit`."""
        return float(np.linalg.norm(self.after - self.before)) / self.unit
