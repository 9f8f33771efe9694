"""One method on one mesh: a row of the thesis's tables."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from hexmend.boundary import SurfaceChange
from hexmend.energy.norm import SQUARES, ObjectiveNorm
from hexmend.iteration import Outcome, Result, StageResult
from hexmend.mesh.mesh import Mesh
from hexmend.quality import Summary, measure, objective, summarise
from hexmend.run import Run, StoppingCriteria, iterate
from hexmend.run.recipe import Recipe
from hexmend.signal_guard import uninterrupted
from hexmend.smoothers import METHODS, Smoother

log = logging.getLogger(__name__)

#: Bins of a distribution of q(H), of equal width from 0 to 1.
BINS = 50

#: Called with the run after each of its iterations; False ends it, and what was to come after it.
Watch = Callable[[Run], Any]


@dataclass(frozen=True, eq=False)
class Row:
    """What one method made of a mesh.

    Parameters
    ----------
    method : str
        Its name; of a recipe the title.
    parameters : mapping
    outcome : str
        The key of an `Outcome`, or "failed".
    message : str
        The outcome with its figures, in sentences; where the method failed, why.
    mesh : Mesh or None
        The smoothed mesh; None where the method failed, as is what follows from it.
    after : Summary or None
    iterations : int
    seconds, setup_seconds : float
    stages : tuple of StageResult
        As in `Result`; of one method alone none.
    worse : tuple of str
        What is worse than before, as in `Result`.
    kept : int
        Number of the iteration that is the result.
    surface : SurfaceChange or None
        As in `Result`.
    """

    method: str
    parameters: Mapping[str, Any]
    outcome: str
    message: str
    mesh: Mesh | None = field(default=None, repr=False)
    after: Summary | None = None
    iterations: int = 0
    seconds: float = 0.0
    setup_seconds: float = 0.0
    stages: tuple[StageResult, ...] = ()
    worse: tuple[str, ...] = ()
    kept: int = 0
    surface: SurfaceChange | None = None

    @property
    def seconds_per_iteration(self) -> float | None:
        """Mean over all iterations; None where there was none."""
        return self.seconds / self.iterations if self.iterations else None

    @property
    def seconds_per_iteration_and_node(self) -> float | None:
        """The same over the number of free nodes."""
        per_iteration, nodes = self.seconds_per_iteration, self.after.free_nodes if self.after else 0
        return per_iteration / nodes if per_iteration is not None and nodes else None

    @property
    def power(self) -> ObjectiveNorm | None:
        """p and offset of the objective that the method minimises; None of a method that minimises nothing.

        Of a recipe those of its last stage that minimises something.
        """
        runs = [one for one in self.stages or (self,) if one.method in METHODS and METHODS[one.method].optimises]
        return METHODS[runs[-1].method](**runs[-1].parameters).power if runs else None

    def objective_by(self, power: ObjectiveNorm) -> float | None:
        """The objective of the smoothed mesh by some p and offset, at delta = 0; None while any hex is inverted."""
        return objective_of(self.mesh, self.after, power) if self.after else None

    def record(self, power: ObjectiveNorm = SQUARES) -> dict[str, Any]:
        """The row for other programs: the method, its run, and the figures of `Summary` at its end.

        Parameters
        ----------
        power : ObjectiveNorm
            p and offset of the objective, which rows of one table have in common: `common_power`.
        """
        figures = self.after.to_dict() if self.after else dict.fromkeys(Summary.__dataclass_fields__)
        figures |= {"objective": self.objective_by(power), "objective_formula": power.formula}
        return {
            "method": self.method,
            "parameters": dict(self.parameters),
            "outcome": self.outcome,
            "message": self.message,
            **figures,
            "worse": list(self.worse),
            "iterations": self.iterations,
            "kept": self.kept,
            "seconds": self.seconds,
            "setup_seconds": self.setup_seconds,
            "seconds_per_iteration": self.seconds_per_iteration,
            "seconds_per_iteration_and_node": self.seconds_per_iteration_and_node,
            "distribution": distribution(self.mesh) if self.mesh else None,
            **({"surface": self.surface.to_dict()} if self.surface else {}),
        } | ({"stages": [stage.to_dict() for stage in self.stages]} if self.stages else {})


def common_power(rows: Iterable[Row]) -> ObjectiveNorm:
    """p and offset of the one objective by which a table compares methods: those of the first that minimises one.

    The default ones where no method minimises anything.
    """
    return next((power for row in rows if (power := row.power) is not None), SQUARES)


def objective_of(mesh: Mesh, summary: Summary, power: ObjectiveNorm) -> float | None:
    """The objective of a mesh by some p and offset, at delta = 0; None while any hex is inverted.

    Parameters
    ----------
    mesh : Mesh
    summary : Summary
        Of this mesh.
    power : ObjectiveNorm
    """
    return summary.objective if power == SQUARES else objective(measure(mesh.points, mesh.hexes), *power)


def initial_record(mesh: Mesh, summary: Summary, power: ObjectiveNorm = SQUARES) -> dict[str, Any]:
    """The mesh that the methods of a table began with, as `Row.record` has what they made of it."""
    own = {"objective": objective_of(mesh, summary, power), "objective_formula": power.formula}
    return summary.to_dict() | own | {"distribution": distribution(mesh)}


def run_one(
    mesh: Mesh, smoother: Smoother | Recipe, stop: StoppingCriteria, watch: Watch | None = None
) -> tuple[Row, bool]:
    """Run one method to its end, or a recipe, under the limits of its own.

    Returns
    -------
    row : Row
    go_on : bool
        False where the user ended it.
    """
    run, go_on = None, True
    name, values = (smoother.title, {}) if isinstance(smoother, Recipe) else (smoother.name, smoother.values())
    try:
        run = iterate(mesh, smoother, None if isinstance(smoother, Recipe) else stop)
        for _ in run:
            if watch is not None and watch(run) is False:
                go_on = False
                run.close()
    except KeyboardInterrupt:
        go_on = False
        if run is None:  # while it was prepared
            words = "Stopped by the user before its first iteration."
            return Row(name, values, Outcome.STOPPED.key, words, mesh, summarise(mesh)), go_on
        run.close()
    except Exception as error:  # whatever it is, the other methods' rows are worth having
        log.info("%s failed", name, exc_info=True)
        return Row(name, values, "failed", f"Failed: {error or type(error).__name__}"), True
    rows: list[Row] = []

    @uninterrupted  # what the run has reached is not lost to a signal after its last iteration
    def finish() -> None:
        rows.append(_row(name, run.result()))

    try:
        finish()
    except KeyboardInterrupt:
        go_on = False
    return rows[0], go_on


def _row(name: str, result: Result) -> Row:
    return Row(
        method=name,
        parameters=result.parameters,
        outcome=result.outcome.key,
        message=result.message,
        mesh=result.mesh,
        after=result.after,
        worse=result.worse,
        iterations=result.iterations,
        kept=result.kept,
        surface=result.surface,
        seconds=result.seconds,
        setup_seconds=result.setup_seconds,
        stages=result.stages if result.method == Recipe.name else (),
    )


def distribution(mesh: Mesh) -> list[int]:
    """Numbers of hexes in `BINS` bins of q(H), from 0 to 1."""
    q = measure(mesh.points, mesh.hexes).q
    return np.histogram(q, BINS, (0.0, 1.0))[0].tolist()
