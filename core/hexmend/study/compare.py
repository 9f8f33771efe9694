"""Comparison of methods on one mesh: the tables of the thesis.

Row of the tables of the thesis: the result of one method on one mesh.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, fields
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

#: Number of bins of a distribution of q(H), of equal width from 0 to 1.
BINS = 50

#: Called with the run after each iteration; returning False ends it and all later runs.
Watch = Callable[[Run], Any]


@dataclass(frozen=True, eq=False)
class Row:
    """Result of one method on a mesh.

    Parameters
    ----------
    method : str
        Name of the method, or title of the recipe.
    parameters : mapping
    outcome : str
        The key of an `Outcome`, or "failed".
    message : str
        The outcome with its figures in sentences, or the reason of a failure.
    mesh : Mesh or None
        The smoothed mesh; None if the method failed.
    after : Summary or None
        Summary of the smoothed mesh.
    iterations : int
    seconds, setup_seconds : float
    stages : tuple of StageResult
        Stages of a recipe, see `Result`.
    worse : tuple of str
        Figures that became worse, see `Result`.
    kept : int
        Number of the iteration that is the result; 0 if that is the mesh as given.
    surface : SurfaceChange or None
        See `Result`.
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
        """Mean over all iterations; None if there was none."""
        return self.seconds / self.iterations if self.iterations else None

    @property
    def seconds_per_iteration_and_node(self) -> float | None:
        """Mean seconds of an iteration over the number of free nodes; None if one of them is zero."""
        per_iteration, nodes = self.seconds_per_iteration, self.after.free_nodes if self.after else 0
        return per_iteration / nodes if per_iteration is not None and nodes else None

    @property
    def norm(self) -> ObjectiveNorm | None:
        """Norm of the objective (3.3) of the method, or of the last optimising stage of a recipe; else None."""
        runs = [run for run in self.stages or (self,) if run.method in METHODS and METHODS[run.method].optimises]
        return METHODS[runs[-1].method](**runs[-1].parameters).norm if runs else None

    def objective_by(self, norm: ObjectiveNorm) -> float | None:
        """Return the objective of the smoothed mesh at delta = 0; None if a hex is inverted."""
        return objective_of(self.mesh, self.after, norm) if self.mesh is not None and self.after else None

    def record(self, norm: ObjectiveNorm = SQUARES) -> dict[str, Any]:
        """Return the row for JSON: the method, its run, and the figures of `Summary` after it.

        Parameters
        ----------
        norm : ObjectiveNorm
            Norm of the objective, common to the rows of a table: `common_norm`.

        Returns
        -------
        dict
        """
        figures = self.after.to_dict() if self.after else dict.fromkeys(Summary.__dataclass_fields__)
        times = "seconds", "setup_seconds", "seconds_per_iteration", "seconds_per_iteration_and_node"
        record: dict[str, Any] = {"method": self.method, "parameters": dict(self.parameters), "outcome": self.outcome}
        record |= {"message": self.message, **figures}
        record |= {"objective": self.objective_by(norm), "objective_formula": norm.formula, "worse": list(self.worse)}
        record |= {key: getattr(self, key) for key in ("iterations", "kept", *times)}
        record["distribution"] = distribution(self.mesh) if self.mesh else None
        if self.surface:
            record["surface"] = self.surface.to_dict()
        if self.stages:
            record["stages"] = [stage.to_dict() for stage in self.stages]
        return record


def common_norm(rows: Iterable[Row]) -> ObjectiveNorm:
    """Return the norm of the first method that minimises an objective, else the default: a table compares by it."""
    return next((norm for row in rows if (norm := row.norm) is not None), SQUARES)


def objective_of(mesh: Mesh, summary: Summary, norm: ObjectiveNorm) -> float | None:
    """Compute the objective (3.3) of a mesh at delta = 0; None if a hex is inverted.

    Parameters
    ----------
    mesh : Mesh
    summary : Summary
        Summary of this mesh.
    norm : ObjectiveNorm
        p and offset.

    Returns
    -------
    float or None
    """
    return summary.objective if norm == SQUARES else objective(measure(mesh.points, mesh.elements), *norm)


def initial_record(mesh: Mesh, summary: Summary, norm: ObjectiveNorm = SQUARES) -> dict[str, Any]:
    """Return the figures of the initial mesh of a table, with the keys of `Row.record`."""
    values = {"objective": objective_of(mesh, summary, norm), "objective_formula": norm.formula}
    return summary.to_dict() | values | {"distribution": distribution(mesh)}


def run_one(
    mesh: Mesh, smoother: Smoother | Recipe, stop: StoppingCriteria, watch: Watch | None = None
) -> tuple[Row, bool]:
    """Run a method, or a recipe with its own limits, to its end.

    Parameters
    ----------
    mesh : Mesh
    smoother : Smoother or Recipe
    stop : StoppingCriteria
        Limits of a method.
    watch : callable, optional
        See `Watch`.

    Returns
    -------
    row : Row
    completed : bool
        False if the user ended it.
    """
    run, completed = None, True
    name, values = (smoother.title, {}) if isinstance(smoother, Recipe) else (smoother.name, smoother.values())
    try:
        run = iterate(mesh, smoother, None if isinstance(smoother, Recipe) else stop)
        for _ in run:
            if watch is not None and watch(run) is False:
                completed = False
                run.close()
    except KeyboardInterrupt:
        completed = False
        if run is None:  # during its preparation
            message = "Stopped by the user before its first iteration."
            return Row(name, values, Outcome.STOPPED.key, message, mesh, summarise(mesh)), completed
        run.close()
    except Exception as error:  # the rows of the other methods are still useful
        log.info("%s failed", name, exc_info=True)
        return Row(name, values, "failed", f"Failed: {error or type(error).__name__}"), True
    rows: list[Row] = []

    @uninterrupted  # a signal after the last iteration must not lose the result
    def finish() -> None:
        rows.append(_row(name, run.result(), mesh))

    try:
        finish()
    except KeyboardInterrupt:
        completed = False
    return rows[0], completed


def _row(name: str, result: Result, mesh: Mesh) -> Row:
    kept = 0 if np.array_equal(result.mesh.points, mesh.points) else result.kept
    stages = result.stages if result.method == Recipe.name else ()
    values = {one.name: getattr(result, one.name) for one in fields(Row)}
    return Row(**values | {"method": name, "outcome": result.outcome.key, "stages": stages, "kept": kept})


def distribution(mesh: Mesh) -> list[int]:
    """Count the hexes of a mesh in `BINS` bins of q(H), from 0 to 1."""
    q = measure(mesh.points, mesh.elements).q
    return np.histogram(q, BINS, (0.0, 1.0))[0].tolist()


@dataclass(frozen=True, eq=False)
class Comparison:
    """Results of methods on one mesh.

    Parameters
    ----------
    mesh : Mesh
        The mesh as given.
    initial : Summary
        Summary of that mesh.
    stop : StoppingCriteria
        Limits of the runs.
    rows : tuple of Row
        One for each method, in order; methods that were not run after an interruption have none.
    interrupted : bool
        The user ended it before the last method was done.
    """

    mesh: Mesh
    initial: Summary
    stop: StoppingCriteria
    rows: tuple[Row, ...]
    interrupted: bool = False

    def record(self) -> dict[str, Any]:
        """Return the comparison for JSON and for the tables of `hexmend.report`.

        All rows have the objective of the first method that minimises one.
        """
        norm = common_norm(self.rows)
        return {
            "mesh": self.mesh.name,
            "stop": self.stop.values(),
            "interrupted": self.interrupted,
            "initial": initial_record(self.mesh, self.initial, norm),
            "rows": [row.record(norm) for row in self.rows],
        }


def compare(
    mesh: Mesh,
    methods: Iterable[Smoother | Recipe | str] = METHODS,
    stop: StoppingCriteria | None = None,
    *,
    watch: Watch | None = None,
) -> Comparison:
    """Run methods on a mesh, each from the mesh as given.

    A method that fails has a row, and the others are run. KeyboardInterrupt, or `watch` returning False, stops the
    running method and skips the others.

    Parameters
    ----------
    mesh : Mesh
    methods : iterable of Smoother, Recipe or str
        A name stands for the method with default values; `hexmend.study.method_spec.parse_methods` reads settings from
        text. All registered methods by default.
    stop : StoppingCriteria, optional
        Limits of each run; a recipe has its own.
    watch : callable, optional
        See `hexmend.study.compare.Watch`.

    Returns
    -------
    Comparison

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> answer = compare(make("bridge-sharp", size=864), ["laplacian", "local-sd"], StoppingCriteria(keep_last=True))
    >>> [row.after.inverted > 0 for row in answer.rows]
    [True, False]
    >>> answer.rows[0].worse
    ('inverted', 'invalid', 'q_min', 'scaled_jacobian')
    """
    stop = stop or StoppingCriteria()
    smoothers = [METHODS[method]() if isinstance(method, str) else method for method in methods]
    rows: list[Row] = []
    interrupted = False
    try:
        for smoother in smoothers:
            row, completed = run_one(mesh, smoother, stop, watch)
            rows.append(row)
            if not completed:
                interrupted = True
                break
    except KeyboardInterrupt:  # between two runs
        interrupted = True
    return Comparison(mesh, summarise(mesh), stop, tuple(rows), interrupted)
