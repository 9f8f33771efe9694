"""Records of a run: its iterations, its stages, and its result."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from hexmend.boundary import Departures, SurfaceChange
from hexmend.energy.norm import SQUARES, ObjectiveNorm, SurfaceObjective
from hexmend.hooks import hook
from hexmend.iteration.step import ActiveSet, Outcome
from hexmend.iteration.stopping import StoppingCriteria
from hexmend.layers import LayerReport
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, Summary, objective, regressions
from hexmend.quality.material_volumes import MaterialVolume
from hexmend.quantity import format_quality
from hexmend.terminal_text import count_phrase


@dataclass(frozen=True, eq=False, repr=False)
class Iteration:
    """Step as the run recorded it.

    Parameters
    ----------
    number : int
        0 is the mesh before the first step.
    points : (n, 3) float64
        Read-only.
    quality : ElementQuality
        Of every hex at these points.
    seconds : float
        Time in the smoother since its set-up ended.
    largest_move : float
        Longest move of a node in this step, in mean edge lengths of the initial mesh (Algorithm A.1).
    diagnostics : mapping
        Of the step, with "stage" (its number in the recipe, from 1) and "method" (its name).
    norm : ObjectiveNorm
        p and offset of the recorded objective: that of the step, or else of the smoother. Number 0 has that of the
        first smoother.
    target_quality : ElementQuality, optional
        Quality against the target of the mesh, by which iterations are compared; `quality` if it has none.
    surface : SurfaceObjective, optional
        Term of the objective over the quads of the boundary, if they count.
    """

    number: int
    points: np.ndarray
    quality: ElementQuality
    seconds: float
    largest_move: float
    diagnostics: Mapping[str, Any] = field(default_factory=dict)
    norm: ObjectiveNorm = SQUARES
    target_quality: ElementQuality | None = None
    surface: SurfaceObjective | None = None

    @property
    def judged_quality(self) -> ElementQuality:
        """The quality by which the iteration is compared with others: `target_quality`, or `quality`."""
        return self.target_quality or self.quality

    @property
    def objective(self) -> float | None:
        """The objective of `norm`, at delta = 0, against the target of the mesh; None while any hex is inverted.

        Where the quads of the boundary count, their term is in it, and it is None while one of them is flipped. It may
        rise where a step does not minimise it, such as while mend raises the minimum scaled Jacobian.
        """
        return self.objective_by(self.norm)

    def objective_by(self, norm: ObjectiveNorm) -> float | None:
        """Compute the objective of another norm; see `objective`."""
        hexes = objective(self.judged_quality, *norm)
        if self.surface is None or hexes is None:
            return hexes
        return None if self.surface.value is None else hexes + self.surface.value

    @property
    def inverted(self) -> int:
        """Number of inverted hexes."""
        return self.quality.n_inverted

    @property
    def invalid(self) -> int:
        """Number of hexes whose det J is not certified as positive everywhere, the inverted ones among them."""
        return self.quality.n_invalid

    @property
    def q_min(self) -> float:
        """Least q(H)."""
        return float(self.quality.q.min())

    @property
    def q_mean(self) -> float:
        """Mean q(H)."""
        return float(self.quality.q.mean())

    @property
    def scaled_jacobian_min(self) -> float:
        """Minimum scaled Jacobian."""
        return float(self.quality.scaled_jacobian.min())

    def __repr__(self) -> str:
        qualities = f"q min {format_quality(self.q_min)}, q mean {format_quality(self.q_mean)}"
        counts = f"{self.inverted:,} inverted, {self.invalid:,} invalid"
        return f"<Iteration {self.number}: {counts}; {qualities}; move {self.largest_move:.2g}>"

    def row(self) -> dict[str, float | int | str | None]:
        """Return the row of the history.

        Its keys: `iteration seconds objective q_min q_mean scaled_jacobian_min inverted invalid largest_move`.

        `objective_formula` names the objective: stages of a recipe, and steps of a method that raises p, differ in it.
        """
        return {
            "iteration": self.number,
            "seconds": self.seconds,
            "objective": self.objective,
            "objective_formula": self.norm.formula_with(0.0 if self.surface is None else self.surface.weight),
            "q_min": self.q_min,
            "q_mean": self.q_mean,
            "scaled_jacobian_min": self.scaled_jacobian_min,
            "inverted": self.inverted,
            "invalid": self.invalid,
            "largest_move": self.largest_move,
        }


@dataclass(frozen=True, eq=False)
class StageResult:
    """Record of one method in a run.

    Parameters
    ----------
    stage : int
        Number in the recipe, from 1; two in a row have the same where the method was changed within the stage.
    method : str
    parameters : mapping
    stop : StoppingCriteria
        The limits of the stage.
    outcome : Outcome
    first : int
        Number of the iteration with which it began.
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
        """Convert it to values that JSON can hold."""
        fields = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        return fields | {"parameters": dict(self.parameters), "stop": self.stop.values(), "outcome": self.outcome.key}


@dataclass(frozen=True, eq=False, repr=False)
class Result:
    """Result of a run.

    Parameters
    ----------
    mesh : Mesh
        The smoothed mesh; everything but the points is the initial one's.
    before, after : Summary
    method : str
        "recipe" for a recipe, and for a run whose method was changed.
    parameters : mapping
    outcome : Outcome
        Of the last stage.
    message : str
        Outcome, iterations and quality in sentences.
    iterations : int
    kept : int
        Number of the iteration that is the result.
    seconds : float
        Time in the smoother, without its set-up, reading and writing.
    setup_seconds : float
        Time for topology, colouring and whatever else the method prepares.
    history : tuple of dict
        `Iteration.row` of each iteration, the initial mesh first.
    stages : tuple of StageResult
        One for each method that was run.
    surface : SurfaceChange or None
        Distance of the boundary from where it was; None where no method let it slide.
    departures : Departures or None
        Nodes that have left their corner, curve or patch; None where no method let the boundary slide.
    materials : mapping of str to MaterialVolume
        Volumes of the materials by name; empty for a mesh of one material.
    active : ActiveSet or None
        Corners that let the last method go no further, if it has found them.
    layers : tuple of LayerReport
        Boundary layers before and after, one for each wall.
    target_q : (float, float) or None
        Least q of target before and after; None without a target.
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
    departures: Departures | None = None
    materials: Mapping[str, MaterialVolume] = field(default_factory=dict)
    active: ActiveSet | None = None
    layers: tuple[LayerReport, ...] = ()
    target_q: tuple[float, float] | None = None

    @property
    def worse(self) -> tuple[str, ...]:
        """Names, of `hexmend.quality.REGRESSION_KEYS`, of what is worse than before; "layers" where these are lost.

        With a target "q_of_target" takes the place of "q_min".
        """
        return regressions(self.before, self.after, self.target_q) + ("layers",) * any(
            wall.lost for wall in self.layers
        )

    @property
    def surface_sentence(self) -> str:
        """Change of the boundary, and which nodes have left it, in sentences; "" where it was fixed."""
        of = self.surface, self.departures
        return " ".join(filter(None, ("" if one is None else one.sentence for one in of)))

    def __repr__(self) -> str:
        before, after = self.before, self.after
        q = f"q min {format_quality(before.q_min)} -> {format_quality(after.q_min)}"
        count = count_phrase(self.iterations, "iteration")
        inverted = (
            f"{before.inverted:,} -> {after.inverted:,} inverted, {before.invalid:,} -> {after.invalid:,} invalid"
        )
        return f"<Result of {self.method}: {inverted}, {q}; {count}, {self.outcome.key}>"

    def _repr_html_(self) -> str:
        """Return the HTML that a notebook shows."""
        return hook("html")(self)
