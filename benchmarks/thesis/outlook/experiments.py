"""Experiments of section 5.2 of the thesis: methods with many values, and the speed of their convergence."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend.quality import Summary, summarise
from hexmend.run import Run, StoppingCriteria
from hexmend.smoothers import METHODS, Smoother
from hexmend.study.compare import Row, run_one

#: A run is near the optimum when its objective exceeds that of the optimum by less than this share.
NEAR = 1e-3


@dataclass(frozen=True)
class Outlook:
    """Experiment on one mesh; `thesis.toml` explains the fields."""

    section: str
    title: str
    mesh: str
    size: int
    quick: int
    methods: tuple[str, ...]
    vary: Mapping[str, tuple[Any, ...]]
    additional: tuple[str, ...] = ()

    def build(self, quick: bool) -> Mesh:
        """Build the mesh."""
        return make(self.mesh, size=self.quick if quick else self.size)

    def variants(self) -> list[tuple[Smoother, Mapping[str, Any]]]:
        """List the methods to be run, each with the values that are varied."""
        alone: list[tuple[Smoother, Mapping[str, Any]]] = [(METHODS[name](), {}) for name in self.additional]
        combined = [dict(zip(self.vary, values, strict=True)) for values in itertools.product(*self.vary.values())]
        return alone + [(METHODS[name](**values), values) for name in self.methods for values in combined]


@dataclass(frozen=True)
class Point:
    """State of a run after an iteration.

    Parameters
    ----------
    iteration : int
    seconds : float
    objective : float or None
        None while any hex is inverted.
    evaluations : float or None
        Mean number of evaluations of the energy or its derivatives of a hex; None if the method does not count them.
    """

    iteration: int
    seconds: float
    objective: float | None
    evaluations: float | None


@dataclass(frozen=True, eq=False)
class Variant:
    """Run of a method with some values.

    Parameters
    ----------
    values : mapping
        The varied parameters.
    row : Row
    history : tuple of Point
        One for each iteration.
    """

    values: Mapping[str, Any]
    row: Row
    history: tuple[Point, ...]

    def arrival(self, optimum: float) -> Point | None:
        """Return the first point `NEAR` the optimum; None if there is none."""
        limit = (1 + NEAR) * optimum
        near = (point for point in self.history if point.objective is not None and point.objective < limit)
        return next(near, None)

    def record(self, optimum: float | None) -> dict[str, Any]:
        """Return the run for JSON, with its arrival as `near_iterations`, `near_evaluations`, `near_seconds`."""
        point = self.arrival(optimum) if optimum is not None else None
        row, after = self.row, self.row.after
        return {
            "method": row.method,
            **self.values,
            "near_iterations": point and point.iteration,
            "near_evaluations": point and point.evaluations,
            "near_seconds": point and point.seconds,
            "iterations": row.iterations,
            "evaluations": self.history[-1].evaluations if self.history else None,
            "seconds": row.seconds,
            **{key: after and getattr(after, key) for key in ("objective", "inverted")},
            **{key: getattr(row, key) for key in ("outcome", "message")},
        }


@dataclass(frozen=True, eq=False)
class TrialResult:
    """Result of an outlook.

    Parameters
    ----------
    outlook : Outlook
    initial : Summary
        Summary of the mesh.
    variants : tuple of Variant
        In the order of `Outlook.variants`.
    """

    outlook: Outlook
    initial: Summary
    variants: tuple[Variant, ...]

    @property
    def optimum(self) -> float | None:
        """Lowest objective at the end of a run."""
        ends = [run.row.after.objective for run in self.variants if run.row.after is not None]
        return min((end for end in ends if end is not None), default=None)

    def find(self, method: str, **values: Any) -> Variant | None:
        """Return the run of a method with these values; None if there is none."""
        return next((run for run in self.variants if run.row.method == method and run.values == values), None)

    def record(self) -> dict[str, Any]:
        """Return the experiment for JSON."""
        optimum = self.optimum
        return {
            **{key: getattr(self.outlook, key) for key in ("section", "title", "mesh")},
            **{key: getattr(self.initial, key) for key in ("hexes", "free_nodes")},
            "optimum": optimum,
            "near": NEAR,
            "vary": list(self.outlook.vary),
            "runs": [variant.record(optimum) for variant in self.variants],
        }


def run_outlook(outlook: Outlook, stop: Callable[[str], StoppingCriteria], quick: bool) -> TrialResult:
    """Run all methods of an outlook.

    Parameters
    ----------
    outlook : Outlook
    stop : callable
        Returns the limits of a run, given the name of its method.
    quick : bool
        Use the small mesh.

    Returns
    -------
    TrialResult
    """
    mesh = outlook.build(quick)
    variants: list[Variant] = []
    for smoother, values in outlook.variants():
        points: list[Point] = []
        row, _ = run_one(mesh, smoother, stop(smoother.name), partial(_record, points, mesh.n_hexes))
        variants.append(Variant(values, row, tuple(points)))
    return TrialResult(outlook, summarise(mesh), tuple(variants))


def _record(points: list[Point], hexes: int, run: Run) -> None:
    """Append the last iteration of a run; its evaluations are added to those of the point before."""
    counts = [run.last.diagnostics.get(key) for key in ("energy_evaluations", "derivative_evaluations")]
    before = points[-1].evaluations if points else 0.0
    evaluations = None if None in counts else before + sum(counts) / hexes
    row: Mapping[str, Any] = run.history[-1]
    points.append(Point(row["iteration"], row["seconds"], row["objective"], evaluations))


def outlooks(entries: Sequence[Mapping[str, Any]]) -> tuple[Outlook, ...]:
    """Make outlooks of the tables of a TOML file."""
    found = []
    for entry in entries:
        vary = {name: tuple(values) for name, values in entry["vary"].items()}
        lists = {key: tuple(entry.get(key, ())) for key in ("methods", "additional")}
        found.append(Outlook(**{**entry, **lists, "vary": vary}))
    return tuple(found)
